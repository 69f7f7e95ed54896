//! Captures of the same people with each person's girths at the level of the first one.

use super::lay::{lay, tapes};
use super::series::{Visit, visits};
use crate::repeat::{Capture, Tapes};

/// Tapes of all captures, those of a person at the levels of the person's first capture. What is refused there is left out.
///
/// # Errors
///
/// A capture without a surface of known scale.
pub fn repeated(captures: Vec<Capture>) -> Result<Vec<Tapes>, String> {
    let all = visits(captures)?;
    let mut found = Vec::new();
    for (i, visit) in all.iter().enumerate() {
        let (person, name) = (visit.capture.person.clone(), visit.capture.name.clone());
        let first = all[..i].iter().find(|v| v.capture.person == person);
        let tapes = match first {
            None => own(visit),
            Some(first) => carried(first, visit),
        };
        found.push((person, name, tapes));
    }
    Ok(found)
}

/// A girth's name, label, part and tape. \[mm\]
type Tape = (String, String, Option<String>, f64);

fn own(visit: &Visit) -> Vec<Tape> {
    let all = visit
        .capture
        .girths
        .girths
        .iter()
        .filter(|g| g.plane.is_some());
    let tape = |g: &crate::girth_file::ReadGirth| {
        (
            g.name.clone(),
            g.label.clone(),
            g.part.clone(),
            10.0 * g.tape,
        )
    };
    all.map(tape).collect()
}

fn carried(first: &Visit, visit: &Visit) -> Vec<Tape> {
    let there = tapes(first, &lay(first, visit), visit);
    let tape = |(name, label, part, _): Tape| {
        let mm = there.iter().find(|t| t.name == name)?.tape_mm.ok()?;
        Some((name, label, part, mm))
    };
    own(first).into_iter().filter_map(tape).collect()
}
