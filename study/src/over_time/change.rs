//! What changed from the first capture on, each with its interval and with what repetition alone gives.

use super::lay::{Laid, lay, tapes};
use super::series::{Series, Visit};
use super::who::{Doubt, doubts};
use crate::compare::TechnicalErrors;
use crate::repeat::LEAST_CHANGE;
use follow::{PARTS, Target, growth, labels_like, volumes};
use shape::{NINE_IN_TEN, Refusal};

/// One girth on one day against the first. \[mm\]
#[derive(Debug, Clone, PartialEq)]
pub struct Change {
    /// Its tape at the first capture's level, or why there is none.
    pub tape_mm: Result<f64, Refusal>,
    /// The tape that the capture has on its own, at the level that was found there.
    pub own_mm: Option<f64>,
    /// Tape less the first one's.
    pub change_mm: Option<f64>,
    /// Holds the true change nine times in ten: both surfaces, both scales, the level as it was carried. `None` where a part is
    /// unknown.
    pub interval_mm: Option<[f64; 2]>,
    /// Least significant change: what measuring the same body twice exceeds one time in twenty.
    pub least_change_mm: Option<f64>,
    /// Whether the change exceeds it.
    pub changed: Option<bool>,
}

/// One girth over all days.
#[derive(Debug, Clone, PartialEq)]
pub struct Line {
    /// Short name.
    pub name: String,
    /// What people call it.
    pub label: String,
    /// One entry a capture, the first against itself.
    pub at: Vec<Change>,
}

/// A capture as it is reported.
#[derive(Debug, Clone, PartialEq)]
pub struct Day {
    /// What the capture is called.
    pub name: String,
    /// Its day, where known.
    pub day: Option<String>,
    /// Crown above the ground. \[mm\]
    pub stature_mm: Option<f64>,
    /// Volume of each part, as [`PARTS`] has them. \[l\]
    pub volumes_l: Vec<f64>,
    /// How far the trunk was turned about the vertical against the first. \[°\]
    pub turned_deg: f64,
    /// Middle of how far the surface is outside of the first one in its pose. \[mm\]
    pub growth_mm: f64,
    /// Why it may be somebody else.
    pub doubts: Vec<Doubt>,
}

/// All that is reported of a person.
pub struct Followed {
    /// What the person is called.
    pub person: String,
    /// The captures.
    pub days: Vec<Day>,
    /// The girths.
    pub lines: Vec<Line>,
    /// For each capture but the first: how far it is outside of the first at each vertex of the first. \[mm\]
    pub growth: Vec<Vec<f64>>,
    /// Whether what repetition gives is made of what captures report of themselves, for nobody measured it.
    pub by_captures: bool,
    /// What is odd, in sentences.
    pub warnings: Vec<String>,
}

/// Parts of a tape's standard deviation in its own capture, without the level: surface and split, and the scale. \[mm\]
fn sigma(visit: &Visit, name: &str) -> Option<f64> {
    let girth = visit.capture.girths.get(name)?;
    Some(10.0 * libm::hypot(girth.surface?, girth.scale.unwrap_or(0.0)))
}

fn change(
    first: &Visit,
    other: &Visit,
    name: &str,
    tape: &super::lay::Tape,
    known: &TechnicalErrors,
) -> Change {
    let own = |v: &Visit| v.capture.girths.get(name).map(|g| 10.0 * g.tape);
    let change = tape.tape_mm.ok().zip(own(first)).map(|(b, a)| b - a);
    let both = sigma(first, name)
        .zip(sigma(other, name))
        .map(|(a, b)| libm::hypot(libm::hypot(a, b), tape.level_mm));
    let least = known
        .get(name)
        .map(|tem| LEAST_CHANGE * tem)
        .or(both.map(|s| 1.96 * s));
    Change {
        own_mm: own(other),
        interval_mm: change
            .zip(both)
            .map(|(c, s)| [c - NINE_IN_TEN * s, c + NINE_IN_TEN * s]),
        changed: change.zip(least).map(|(c, l)| c.abs() > l),
        tape_mm: tape.tape_mm,
        change_mm: change,
        least_change_mm: least,
    }
}

fn day(visit: &Visit, volumes_l: Vec<f64>) -> Day {
    Day {
        name: visit.capture.name.clone(),
        day: visit.day.clone(),
        stature_mm: visit.capture.girths.stature.map(|cm| 10.0 * cm),
        volumes_l,
        turned_deg: 0.0,
        growth_mm: 0.0,
        doubts: vec![],
    }
}

/// What the first capture's own lines are.
fn starts(first: &Visit) -> Vec<Line> {
    let all = first
        .capture
        .girths
        .girths
        .iter()
        .filter(|g| g.plane.is_some());
    let line = |g: &crate::girth_file::ReadGirth| Line {
        name: g.name.clone(),
        label: g.label.clone(),
        at: vec![Change {
            tape_mm: Ok(10.0 * g.tape),
            own_mm: Some(10.0 * g.tape),
            change_mm: Some(0.0),
            interval_mm: None,
            least_change_mm: None,
            changed: None,
        }],
    };
    all.map(line).collect()
}

/// Follows a person. Technical errors that `repeat` found take the place of what captures report of themselves.
pub fn follow(person: &str, series: &Series, known: &TechnicalErrors) -> Followed {
    let (first, later) = series.visits.split_first().expect("bug: nobody to follow");
    let mut followed = Followed {
        person: person.into(),
        days: vec![],
        lines: starts(first),
        growth: vec![],
        by_captures: known.is_empty(),
        warnings: series.warnings.clone(),
    };
    for other in later {
        let laid: Laid = lay(first, other);
        let parts = laid.segments.parts();
        if followed.days.is_empty() {
            followed
                .days
                .push(day(first, litres(&volumes(&first.mesh, &parts, &PARTS))));
        }
        let posed = &laid.posed.mesh;
        let growth = growth(posed, &Target::new(&other.mesh));
        let labels = labels_like(&other.mesh, posed, &parts);
        let mut now = day(other, litres(&volumes(&other.mesh, &labels, &PARTS)));
        now.turned_deg = laid.posed.trunk.rotation.euler_angles().2.to_degrees();
        now.growth_mm = shape::upper_median(&growth).unwrap_or(0.0);
        now.doubts = doubts(first, other, &growth);
        for doubt in &now.doubts {
            followed.warnings.push(format!(
                "{} may be somebody else's capture: {doubt}",
                now.name
            ));
        }
        let taken = tapes(first, &laid, other);
        followed
            .lines
            .retain(|line| taken.iter().any(|t| t.name == line.name));
        for line in &mut followed.lines {
            let tape = taken
                .iter()
                .find(|t| t.name == line.name)
                .expect("bug: a line without a tape");
            line.at.push(change(first, other, &line.name, tape, known));
        }
        followed.days.push(now);
        followed.growth.push(growth);
    }
    followed
}

fn litres(mm3: &[f64]) -> Vec<f64> {
    mm3.iter().map(|v| v * 1e-6).collect()
}
