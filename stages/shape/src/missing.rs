//! What could not be measured, and why.

use crate::{GirthId, Refusal, Side};
use serde::{Deserialize, Serialize};

/// A girth, or a height, that could not be measured.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Missing {
    /// Which girth; `None` for what is none: the stature.
    pub id: Option<GirthId>,
    /// Short name.
    pub name: String,
    /// The reason, for programs.
    pub reason: Refusal,
    /// Why on this body, and what would help: a sentence.
    pub why: String,
}

impl Missing {
    /// A girth of the table, with the sentence that goes with the reason.
    pub fn new(id: GirthId, reason: Refusal) -> Self {
        Missing::because(id, reason, reason.why())
    }

    /// With a sentence of its own.
    pub fn because(id: GirthId, reason: Refusal, why: &str) -> Self {
        Missing {
            id: Some(id),
            name: id.name(),
            reason,
            why: why.into(),
        }
    }

    /// A number that is no girth, by the sentence that goes with it.
    pub fn number(name: &str, reason: Refusal, why: &str) -> Self {
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
pub fn by_reason(all: &[Missing]) -> Vec<(&str, Vec<NamedGirth<'_>>)> {
    let mut reasons: Vec<(&str, Vec<NamedGirth<'_>>)> = Vec::new();
    for missing in all {
        let one = (missing.id, missing.name.as_str());
        match reasons.iter_mut().find(|(why, _)| *why == missing.why) {
            Some((_, names)) => names.push(one),
            None => reasons.push((&missing.why, vec![one])),
        }
    }
    reasons
}

/// Girths in a sentence, by what people call them: `hip, narrowest waist, upper arms, left calf`. A pair of limbs is one.
pub fn listed(all: &[NamedGirth<'_>]) -> String {
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
    words.join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

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
