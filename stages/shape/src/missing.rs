//! What could not be measured, and why.

use crate::{GirthId, Refusal, Side};
use serde::{Deserialize, Serialize};
use stage::{Field, Message};

stage::messages! {
    HIP = "girth-name-HC": "hip";
    HIP_MAX = "girth-name-HC-max": "greatest hip";
    WAIST = "girth-name-WC": "waist";
    WAIST_NATURAL = "girth-name-WC-natural": "natural waist";
    WAIST_NARROWEST = "girth-name-WC-narrowest": "narrowest waist";
    WAIST_NAVEL = "girth-name-WC-navel": "waist at the navel";
    WAIST_HIP_BONE = "girth-name-WC-hip-bone": "waist at the hip bone";
    CHEST = "girth-name-CC": "chest";
    NECK = "girth-name-NC": "neck";
    PICKED = "girth-name-picked": "through picked points";
    UPPER_ARM = "girth-name-AC-mean": "upper arm";
    UPPER_ARMS = "girth-name-AC": "upper arms";
    LEFT_UPPER_ARM = "girth-name-AC-L": "left upper arm";
    RIGHT_UPPER_ARM = "girth-name-AC-R": "right upper arm";
    THIGHS = "girth-name-TC": "thighs";
    LEFT_THIGH = "girth-name-TC-L": "left thigh";
    RIGHT_THIGH = "girth-name-TC-R": "right thigh";
    CALVES = "girth-name-CFC": "calves";
    LEFT_CALF = "girth-name-CFC-L": "left calf";
    RIGHT_CALF = "girth-name-CFC-R": "right calf";
    STATURE = "girth-name-stature": "stature";
}

/// A girth, or a height, that could not be measured.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Missing {
    /// Which girth; `None` for what is none: the stature.
    pub id: Option<GirthId>,
    /// Short name.
    pub name: String,
    /// The reason, for programs.
    pub reason: Refusal,
    /// Why on this body, and what would help: a sentence.
    pub why: Message,
}

impl Missing {
    /// A girth of the table, with the sentence that goes with the reason.
    pub fn new(id: GirthId, reason: Refusal) -> Self {
        Missing::because(id, reason, reason.message())
    }

    /// With a sentence of its own.
    pub fn because(id: GirthId, reason: Refusal, why: impl Into<Message>) -> Self {
        Missing {
            id: Some(id),
            name: id.name(),
            reason,
            why: why.into(),
        }
    }

    /// A number that is no girth, by the sentence that goes with it.
    pub fn number(name: &str, reason: Refusal, why: impl Into<Message>) -> Self {
        Missing {
            id: None,
            name: name.into(),
            reason,
            why: why.into(),
        }
    }
}

/// A girth of the table, and its short name.
pub type NamedGirth<'a> = (Option<GirthId>, &'a str);

/// Reasons in the order in which they come up, each with all that it is the reason of.
pub fn by_reason(all: &[Missing]) -> Vec<(&Message, Vec<NamedGirth<'_>>)> {
    let mut reasons: Vec<(&Message, Vec<NamedGirth<'_>>)> = Vec::new();
    for missing in all {
        let one = (missing.id, missing.name.as_str());
        match reasons.iter_mut().find(|(why, _)| **why == missing.why) {
            Some((_, names)) => names.push(one),
            None => reasons.push((&missing.why, vec![one])),
        }
    }
    reasons
}

/// Girths in a message, each with a code of its own where people have a word for it.
pub fn girth_names(all: &[NamedGirth<'_>]) -> Field {
    let field = |word: String| match MESSAGES.iter().find(|kind| kind.english == word) {
        Some(kind) => Field::from(Message::new(kind, [])),
        None => Field::from(word),
    };
    Field::List(words(all).into_iter().map(field).collect())
}

/// Girths in a sentence, by what people call them: `hip, narrowest waist, upper arms, left calf`. A pair of limbs is one.
pub fn listed(all: &[NamedGirth<'_>]) -> String {
    words(all).join(", ")
}

/// What people call them.
fn words(all: &[NamedGirth<'_>]) -> Vec<String> {
    let other = |id: GirthId, side: Side| {
        let twin =
            |t: &GirthId| t.side().is_some_and(|s| s != side) && t.sideless() == id.sideless();
        all.iter().filter_map(|(id, _)| *id).find(twin)
    };
    let mut words: Vec<String> = Vec::new();
    for (id, name) in all {
        let Some(id) = id.filter(|id| *id != GirthId::Own) else {
            words.push((*name).to_owned());
            continue;
        };
        let label = id.definition().label;
        words.push(match (id.side(), label.split_once(", ")) {
            (Some(side), _) => match (other(id, side), side) {
                (Some(_), Side::Left) => label
                    .strip_suffix('f')
                    .map_or(format!("{label}s"), |l| format!("{l}ves")),
                (Some(_), Side::Right) => continue,
                (None, side) => format!("{} {label}", side.word()),
            },
            (None, Some((part, which))) => format!("{which} {part}"),
            (None, None) => label.to_owned(),
        });
    }
    words
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::TABLE;

    #[test]
    fn every_girth_of_the_table_has_a_word_with_a_code() {
        let named = TABLE
            .iter()
            .map(|row| row.id)
            .filter(|id| *id != GirthId::Own);
        let one = |id: GirthId| girth_names(&[(Some(id), "")]);
        let pairs = [GirthId::UpperArm, GirthId::Thigh, GirthId::Calf].into_iter();
        let each = pairs.clone().flat_map(|of| Side::BOTH.map(of)).map(one);
        let both = pairs.map(|of| girth_names(&Side::BOTH.map(|side| (Some(of(side)), ""))));
        let all: Vec<Field> = named.map(one).chain(each).chain(both).collect();
        assert_eq!(all.len(), 14 + 6 + 3);
        for name in all {
            let Field::List(words) = &name else {
                panic!("{name}")
            };
            assert!(matches!(words[0], Field::Message(_)), "{name} has no code");
        }
    }

    #[test]
    fn girths_are_listed_as_people_call_them_and_pairs_once() {
        let all = [
            (Some(GirthId::Hip), "HC"),
            (Some(GirthId::WaistNarrowest), "WC_narrowest"),
            (Some(GirthId::UpperArm(Side::Left)), "AC_L"),
            (Some(GirthId::UpperArm(Side::Right)), "AC_R"),
            (Some(GirthId::Calf(Side::Right)), "CFC_R"),
            (Some(GirthId::Own), "mid_thigh_L"),
            (None, "stature"),
        ];
        assert_eq!(
            listed(&all),
            "hip, narrowest waist, upper arms, right calf, mid_thigh_L, stature"
        );
        let calves = Side::BOTH.map(|side| (Some(GirthId::Calf(side)), ""));
        assert_eq!(listed(&calves), "calves");
    }
}
