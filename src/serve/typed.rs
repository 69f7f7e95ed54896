//! What was typed into the form of facts, read as the reader writes numbers.

use super::facts::{Facts, Numbers, Plate, Sex, fields};
use super::pages::facts::Slips;
use crate::catalog::{Known, Quantity};
use crate::words::language::Words;
use std::collections::{BTreeMap, HashMap};

/// Facts, or what is wrong with them by field.
///
/// # Errors
///
/// Fields that are no numbers, or numbers that cannot be.
pub(super) fn facts(words: Words, sent: &HashMap<String, String>) -> Result<Facts, Slips> {
    let mut slips: BTreeMap<&'static str, String> = BTreeMap::new();
    let mut read = |name: &'static str, length: bool| {
        let text = sent.get(name).map(String::as_str).unwrap_or_default();
        let number = if length {
            words.typed_length(text)
        } else {
            words.typed(text)
        };
        number.unwrap_or_else(|_| {
            slips.insert(name, words.text("slip-number"));
            None
        })
    };
    let number = |(name, known): (_, &Known)| Some((name, read(name, in_cm(known))?));
    let mut facts = Facts {
        numbers: Numbers(fields().filter_map(number).collect()),
        ..Facts::default()
    };
    let steps = read("steps", false);
    facts.steps = steps.map(|steps| steps as i64);
    let plate = |text: &String| text.parse().map_or(Plate::Nothing, Plate::Photo);
    facts.plate = sent.get("plate").map_or(Plate::ByName, plate);
    let sex = sent.get("sex").map(String::as_str);
    facts.sex = Sex::ALL.into_iter().find(|s| Some(s.word()) == sex);
    facts.walk = sent.contains_key("walk");
    facts.quick = sent.contains_key("quick");
    if steps.is_some_and(|steps| steps.fract() != 0.0) {
        slips.insert("steps", words.text("slip-whole"));
    }
    if let Err(why) = facts.check()
        && !slips.contains_key(why.field)
    {
        let length = fields().any(|(name, known)| name == why.field && in_cm(known));
        let shown = |n: f64| {
            if length {
                words.length(n)
            } else {
                words.field(n)
            }
        };
        let limits = [
            ("least", shown(why.least).into()),
            ("most", shown(why.most).into()),
        ];
        slips.insert(why.field, words.with("slip-range", &limits));
    }
    match slips.is_empty() {
        true => Ok(facts),
        false => Err(Slips {
            why: slips,
            typed: sent.clone(),
            stale: false,
        }),
    }
}

/// Whether readers write it in their unit of length.
fn in_cm(known: &Known) -> bool {
    known.of == Quantity::Length("cm")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::words::language::Language;

    #[test]
    fn fields_are_read_in_the_readers_units_and_slips_are_refused() {
        let words = Words {
            language: Language::De,
            inches: false,
        };
        let sent = |pairs: &[(&str, &str)]| {
            pairs
                .iter()
                .map(|(k, v)| ((*k).into(), (*v).into()))
                .collect()
        };
        let parsed = facts(
            words,
            &sent(&[
                ("stature_cm", "171,5"),
                ("steps", "-18"),
                ("walk", "yes"),
                ("plate", "3"),
                ("sex", "male"),
                ("age_years", "9,5"),
            ]),
        );
        let expected = Facts {
            numbers: Numbers([("stature_cm", 171.5), ("age_years", 9.5)].into()),
            steps: Some(-18),
            walk: true,
            plate: Plate::Photo(3),
            sex: Some(Sex::Male),
            ..Facts::default()
        };
        assert_eq!(parsed, Ok(expected));
        let slips = facts(
            words,
            &sent(&[
                ("stature_cm", "1,71"),
                ("weight_kg", "viel"),
                ("steps", "4,5"),
            ]),
        )
        .unwrap_err();
        assert!(slips.why["stature_cm"].contains("10,0 cm"), "{slips:?}");
        assert!(slips.typed["weight_kg"] == "viel" && slips.why.contains_key("steps"));
    }
}
