//! Families of made bodies left out of a fit in turn.

use super::samples::{Made, Person};

/// A family, and all that has nothing of it.
pub(crate) struct LeftOut<'a> {
    /// Its name.
    pub family: &'a str,
    /// Its bodies.
    pub out: Vec<&'a Made>,
    /// People of the survey, but for those to whom the family's bodies were driven.
    pub people: Vec<&'a Person>,
    /// Bodies of the other families.
    pub made: Vec<&'a Made>,
}

/// Each family in turn; what repeats a body is none of its own.
pub(crate) fn left_out<'a>(people: &[&'a Person], made: &[&'a Made]) -> Vec<LeftOut<'a>> {
    let first = made.iter().filter(|m| m.repeats.is_none());
    let mut families: Vec<&str> = first.map(|m| m.family.as_str()).collect();
    families.sort_unstable();
    families.dedup();
    let one = |family| {
        let (out, made): (Vec<&Made>, Vec<_>) = made.iter().partition(|m| m.family == family);
        let driven = |p: &&&Person| out.iter().any(|m| m.person == Some(p.row));
        LeftOut {
            family,
            people: people.iter().filter(|p| !driven(p)).copied().collect(),
            out,
            made,
        }
    };
    families.into_iter().map(one).collect()
}
