//! Whether what is worn ends on the legs with a hem that hangs away from them: below it the outline of both legs together is
//! smaller all around, by a step that no bare leg has.

use crate::features::body::Body;
use crate::geometry::slices::{Ring, Slice};
use nalgebra::Vector3;
use shape::{GirthId, Landmark, Unit, upper_median};
use stage::{Field, Message, message};
use std::f64::consts::TAU;
use std::ops::Range;

stage::messages! {
    HIDES = "warn-worn-hides": "what is worn hangs away from the legs by {off} at its hem, {height} above the ground, so the body under it is not known: wear tight shorts";
}

/// Directions to which legs reach, structural.
const WAYS: usize = 24;
/// Slices to either side that a straight line is laid through, and slices to either side that are passed over before it, where
/// a hem is looked for, structural.
const SHARP: (usize, usize) = (8, 0);
/// The same where it is measured, structural: a hem hangs 2 cm lower here than there.
const WIDE: (usize, usize) = (12, 4);
/// Where a hem is looked for, as shares of stature, structural: between ankles and crotch.
const LEGS: (f64, f64) = (0.12, 0.44);
/// How sharply bare legs step at most, as a share of stature. Fitted: mean and three standard deviations of the first forty
/// bodies of `models/made/strangers.py` (`models/tables/hems.csv`); of six scans the most is 0.0005.
const BARE: f64 = 0.0009;
/// What is seen of a hem is beyond so many standard deviations (three-sigma rule: Pukelsheim 1994).
const SURE: f64 = 3.0;

/// A hem that hangs away from the legs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Hem {
    /// How far it is away, the middle of all directions. \[mm\]
    pub(crate) off_mm: f64,
    /// Its height above the ground. \[mm\]
    pub(crate) above_mm: f64,
    /// The same in the surface's frame. \[mm\]
    z_mm: f64,
}

impl Hem {
    /// How much longer a tape may be by what is worn: of hip and thighs above it. \[mm\]
    pub(crate) fn around_mm(&self, landmark: &Landmark) -> f64 {
        let below = matches!(
            landmark.id,
            GirthId::Hip | GirthId::HipGreatest | GirthId::Thigh(_)
        );
        match below && landmark.plane.point_mm[2] > self.z_mm {
            true => TAU * self.off_mm,
            false => 0.0,
        }
    }

    /// Why a girth under it is not given.
    pub(crate) fn hides(&self, unit: Unit) -> Message {
        let length = |mm: f64| match unit {
            Unit::Metric => Field::number(mm / 10.0, 1, "cm"),
            unit => unit.field(mm),
        };
        message!(
            HIDES,
            off = length(self.off_mm),
            height = length(self.above_mm)
        )
    }
}

/// Legs in slices: how far they reach, where a hem is looked for, and how sharply they step there. \[mm\]
struct Legs<'a> {
    slices: Vec<&'a Slice>,
    reaches: Vec<[f64; WAYS]>,
    inside: Range<usize>,
    steps: Vec<f64>,
}

fn legs(body: &Body) -> Option<Legs<'_>> {
    let far = (WIDE.0 + WIDE.1) as f64 * (body.slices.get(1)?.z - body.slices[0].z);
    let [low, high] = [LEGS.0, LEGS.1].map(|share| body.ground + share * body.stature);
    let slices: Vec<&Slice> = body.between(low - far, high + far).collect();
    let slices = both_legs(&slices);
    let reaches: Vec<[f64; WAYS]> = slices.iter().map(|s| reach(s)).collect::<Option<_>>()?;
    let inside = WIDE.0 + WIDE.1..slices.len().saturating_sub(WIDE.0 + WIDE.1);
    let steps = inside.clone().map(|i| step(&reaches, i, SHARP)).collect();
    Some(Legs {
        slices: slices.to_vec(),
        reaches,
        inside,
        steps,
    })
}

/// Slices above the highest in which a leg is missing that is there above it: it was carved away where it moved, and ends
/// without a hem. Where legs become one, nothing of their area is missing.
fn both_legs<'a, 'b>(slices: &'b [&'a Slice]) -> &'b [&'a Slice] {
    let ends = |w: &[&Slice]| {
        let area = w[0].rings.first().map_or(0.0, |r| r.area);
        let two = other(w[1]).map(|r| w[1].rings[0].area + r.area / 2.0);
        other(w[0]).is_none() && two.is_some_and(|two| area < two)
    };
    let ends = slices.windows(2).rposition(ends);
    &slices[ends.map_or(0, |at| at + 1)..]
}

/// The other leg, where it is not one with the first.
fn other(slice: &Slice) -> Option<&Ring> {
    let first = slice.rings.first()?;
    slice.rings.get(1).filter(|r| r.area > 0.4 * first.area)
}

/// How sharply the legs of a body step at most, as a share of stature: bare ones less than `BARE`.
pub fn leg_step(body: &Body) -> Option<f64> {
    let most = legs(body)?.steps.into_iter().reduce(f64::max)?;
    Some(most / body.stature)
}

/// The hem that hangs away most sharply, if any does.
pub(crate) fn hem(body: &Body) -> Option<Hem> {
    let Legs {
        slices,
        reaches,
        inside,
        steps: all,
    } = legs(body)?;
    let usual = upper_median(&all).unwrap_or(0.0);
    let spread = 1.4826 * upper_median(all.iter().map(|s| (s - usual).abs())).unwrap_or(0.0);
    let most = inside.clone().zip(all);
    let (at, most) = most.max_by(|a, b| a.1.total_cmp(&b.1))?;
    let wide = (at - WIDE.1..=at + WIDE.1).filter(|i| inside.contains(i));
    let off_mm = wide.map(|i| step(&reaches, i, WIDE)).fold(most, f64::max);
    let bare = libm::hypot(SURE * spread, BARE * body.stature);
    (most > bare).then_some(Hem {
        off_mm,
        above_mm: slices[at].z - body.ground,
        z_mm: slices[at].z,
    })
}

/// How much farther legs reach above a slice than below it, the middle of all directions. \[mm\]
fn step(reaches: &[[f64; WAYS]], at: usize, (beside, passed): (usize, usize)) -> f64 {
    // What a value counts for where a straight line through all meets the slice's lower end.
    let n = beside as f64;
    let mean = passed as f64 + n / 2.0;
    let place = |k: usize| (passed + k) as f64 + 0.5 - mean;
    let square: f64 = (0..beside).map(|k| place(k) * place(k)).sum();
    let more = |way: usize| -> f64 {
        let both = (0..beside).map(|k| {
            let above = reaches[at + passed + k][way];
            let below = reaches[at - 1 - passed - k][way];
            (1.0 / n - mean * place(k) / square) * (above - below)
        });
        both.sum()
    };
    upper_median((0..WAYS).map(more)).unwrap_or(0.0)
}

/// How far both legs reach together, by direction; `None` where there are none. \[mm\]
fn reach(slice: &Slice) -> Option<[f64; WAYS]> {
    let first = slice.rings.first()?;
    let other = other(slice);
    let points = || {
        first
            .curve
            .iter()
            .chain(other.iter().flat_map(|r| &r.curve))
    };
    Some(std::array::from_fn(|way| {
        let (s, c) = libm::sincos(TAU * way as f64 / WAYS as f64);
        let n = Vector3::new(c, s, 0.0);
        points().map(|p| n.dot(&p.coords)).fold(f64::MIN, f64::max)
    }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::table::Table;

    /// Legs of such radii from below, a slice each. \[mm\]
    fn slices(radii: &[&[f64]]) -> Vec<Slice> {
        let ring = |r: &f64| Ring {
            curve: vec![],
            area: TAU / 2.0 * r * r,
            tape: TAU * r,
            centre: nalgebra::Point3::origin(),
        };
        let slice = |(i, radii): (usize, &&[f64])| Slice {
            z: i as f64,
            rings: radii.iter().map(ring).collect(),
        };
        radii.iter().enumerate().map(slice).collect()
    }

    #[test]
    fn a_leg_that_is_missing_below_is_no_hem_and_legs_that_touch_are_not_missing() {
        let lowest = |radii: &[&[f64]]| {
            let all = slices(radii);
            let all: Vec<&Slice> = all.iter().collect();
            both_legs(&all)[0].z
        };
        let (two, one): (&[f64], &[f64]) = (&[50.0, 48.0], &[52.0]);
        assert_eq!(lowest(&[one, one, two, two, &[90.0]]), 2.0);
        assert_eq!(lowest(&[&[], &[52.0, 20.0], two, two]), 2.0);
        assert_eq!(lowest(&[two, &[75.0], two, two, &[90.0]]), 0.0);
    }

    #[test]
    fn bare_legs_step_as_sharply_as_those_of_made_bodies() {
        let table = Table::checked_in("hems.csv");
        let most = table.numbers("most").unwrap();
        let n = most.len() as f64;
        let mean = most.iter().sum::<f64>() / n;
        let square = most.iter().map(|m| (m - mean).powi(2)).sum::<f64>() / n;
        assert_eq!(most.len(), 40);
        proof::near(mean + SURE * square.sqrt(), BARE, 5e-5);
    }
}
