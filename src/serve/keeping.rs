//! What is known of a capture, changed: as a whole, in part, or by a form, while other windows may change it, too.

use super::answer::Wrong;
use super::app::App;
use super::facts::{Facts, Plate};
use super::home::Place;
use super::pages::facts::{Slips, shown};
use super::record::Record;
use super::typed;
use crate::words::language::Words;
use axum::http::StatusCode;
use std::collections::HashMap;

/// Keeps what `how` makes of what is known; what was seen with other facts is no more.
///
/// # Errors
///
/// What `how` refuses, a fact that cannot be, or a capture that is being measured.
pub(super) fn keep<E: From<Wrong>>(
    app: &App,
    place: &Place,
    how: impl FnOnce(&Record) -> Result<Facts, E>,
) -> Result<(), E> {
    if app.jobs.progress(place).goes_on() {
        return Err(Wrong::new(StatusCode::CONFLICT, "wrong-busy").into());
    }
    let changed = app.home.change(place, |record| {
        let facts = how(record)?;
        facts.check().map_err(Wrong::unfit)?;
        if facts.plate != record.facts.plate {
            plate(record, facts.plate)?;
        }
        let before = std::mem::replace(&mut record.facts, facts);
        record.version += u64::from(before != record.facts);
        Ok::<bool, E>(seen_by(&before) != seen_by(&record.facts))
    });
    if changed.map_err(Wrong::from)?? {
        let _ = std::fs::remove_file(place.folder.join("look.json"));
    }
    Ok(())
}

/// What of the facts changes what is seen of the photos.
fn seen_by(facts: &Facts) -> Facts {
    Facts {
        walk: false,
        quick: false,
        inches: false,
        ..facts.clone()
    }
}

/// Whether the photo of the empty scene can be that one.
fn plate(record: &Record, plate: Plate) -> Result<(), Wrong> {
    let Plate::Photo(number) = plate else {
        return Ok(());
    };
    let photo = record.files.get(&number).filter(|kept| !kept.video);
    let wrong = || {
        let wrong = Wrong::new(StatusCode::UNPROCESSABLE_ENTITY, "wrong-plate");
        wrong.put("number", number).put("files", record.files.len())
    };
    photo.map(|_| ()).ok_or_else(wrong)
}

/// Some facts over those that are known: what is `null` is known no longer, but for the photo of the empty scene,
/// of which there is none then.
///
/// # Errors
///
/// What is no fact.
pub(super) fn merged(known: &Facts, given: &serde_json::Value) -> Result<Facts, Wrong> {
    let mut all = serde_json::to_value(known).map_err(Wrong::broken)?;
    for (key, value) in given.as_object().into_iter().flatten() {
        match value.is_null() && key != "plate" {
            true => all[key.as_str()] = serde_json::Value::Null,
            false => all[key.as_str()] = value.clone(),
        }
    }
    let keep = |(key, value): &(String, serde_json::Value)| !value.is_null() || key == "plate";
    let all: serde_json::Map<_, _> = match all {
        serde_json::Value::Object(all) => all.into_iter().filter(keep).collect(),
        _ => serde_json::Map::new(),
    };
    serde_json::from_value(all.into()).map_err(Wrong::unfit)
}

/// Why a form came to nothing.
pub(super) enum Unkept {
    /// As any call.
    Wrong(Wrong),
    /// What was typed is wrong, or was changed elsewhere: by field.
    Slips(Slips),
}

impl From<Wrong> for Unkept {
    fn from(wrong: Wrong) -> Unkept {
        Unkept::Wrong(wrong)
    }
}

/// What a form asks for: the fields that somebody changed in it, over what is known by now. A field has in `was_…`
/// what it showed before.
///
/// # Errors
///
/// Fields that cannot be, or that were changed elsewhere meanwhile.
pub(super) fn asked(
    words: Words,
    record: &Record,
    sent: &HashMap<String, String>,
) -> Result<Facts, Unkept> {
    let now = shown(words, record);
    let typed = |name: &str| sent.get(name).map_or("", |text| text.trim());
    let alike = |a: &str, b: &str| a.replace(',', ".") == b.replace(',', ".");
    let (mut all, mut stale) = (HashMap::new(), vec![]);
    for (name, now) in &now {
        let was = sent.get(&format!("was_{name}")).unwrap_or(now);
        let here = typed(name);
        let changed = !alike(here, was);
        if changed && !alike(now, was) && !alike(now, here) {
            stale.push((*name, now.clone()));
        }
        all.insert(
            (*name).to_owned(),
            if changed { here } else { now.as_str() }.to_owned(),
        );
    }
    all.retain(|name, text| !(["walk", "quick"].contains(&name.as_str()) && text.is_empty()));
    if !stale.is_empty() {
        let why =
            |(name, now): &(&'static str, String)| (*name, meanwhile(words, record, name, now));
        return Err(Unkept::Slips(Slips {
            why: stale.iter().map(why).collect(),
            typed: all,
            stale: true,
        }));
    }
    let plate = alike(&all["plate"], &now["plate"]).then_some(record.facts.plate);
    let mut facts = typed::facts(words, &all).map_err(Unkept::Slips)?;
    facts.plate = plate.unwrap_or(facts.plate);
    facts.inches = record.facts.inches;
    Ok(facts)
}

/// What another window made of a field, for people.
fn meanwhile(words: Words, record: &Record, name: &str, now: &str) -> String {
    let file = || {
        let number = now.parse().ok()?;
        Some(format!("{now}: {}", record.files.get(&number)?.name))
    };
    let text = match (name, now) {
        ("sex", "") => words.text("fact-sex-none"),
        ("sex", sex) => words.text(&format!("fact-sex-{sex}")),
        ("plate", "") => words.text("fact-plate-none"),
        ("plate", _) => file().unwrap_or_default(),
        ("walk" | "quick", text) => words.text(if text.is_empty() {
            "fact-off"
        } else {
            "fact-on"
        }),
        (_, "") => words.text("fact-empty"),
        (_, text) => text.to_owned(),
    };
    words.with("slip-stale", &[("now", text.into())])
}

#[cfg(test)]
mod tests {
    use super::super::facts::Numbers;
    use super::*;
    use serde_json::json;

    #[test]
    fn some_facts_go_over_those_that_are_known() {
        let known = Facts {
            numbers: Numbers([("stature_cm", 171.5), ("weight_kg", 64.0)].into()),
            walk: true,
            ..Facts::default()
        };
        let given = json!({ "weight_kg": 65.0, "stature_cm": null, "plate": null });
        let facts = merged(&known, &given).unwrap();
        let expected = Facts {
            numbers: Numbers([("weight_kg", 65.0)].into()),
            walk: true,
            plate: Plate::Nothing,
            ..Facts::default()
        };
        assert_eq!(facts, expected);
        let by_name = merged(&known, &json!({})).unwrap();
        assert_eq!(by_name, known);
        assert!(merged(&known, &json!({ "set": 1 })).is_err());
    }
}
