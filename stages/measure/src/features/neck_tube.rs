//! The neck as a tube: its tightest planes of all levels and leans, its axis, how far it reaches.
//!
//! A tape that is free to slide and to tilt comes to rest where it is shortest. That place is on the tube
//! whichever way the head leans: jaw, skull and shoulders are all wider. The axis is the line of the
//! middles of the sections about it.

use crate::geometry::crop::near;
use crate::geometry::section::{area, flat};
use crate::geometry::slices::{Ring, rings};
use nalgebra::{Point3, Vector3};
use rayon::prelude::*;
use shape::{Mesh, Plane};
use std::f64::consts::{FRAC_PI_2, PI};

/// A neck between head and shoulders.
#[derive(Debug, Clone)]
pub(crate) struct Tube {
    /// The surface around it. \[mm\]
    pub(crate) part: Mesh,
    /// The way the body faces: horizontal, unit.
    pub(crate) front: Vector3<f64>,
    /// The middle of the tightest section. \[mm\]
    pub(crate) origin: Point3<f64>,
    /// How far forward the neck's axis leans. \[rad\]
    pub(crate) lean: f64,
    /// The tightest tape across the axis. \[mm\]
    pub(crate) girth: f64,
    /// Offsets along the axis, up and down, at which the tape is a tenth longer. \[mm\]
    pub(crate) ends: (f64, f64),
}

/// Leans that are tried: from, to, step (structural: the grid of a search). \[degrees\]
const LEANS: (i32, i32, usize) = (-20, 60, 10);
/// Steps up and down that are tried; a step as a share of the diameter (structural: the grid of a search).
const STEPS: i32 = 8;
/// A step up or down (structural: the grid of a search).
const STEP: f64 = 0.1;
/// Planes whose tape is longer than the least by less than this share are the neck's tightest: their middle is taken,
/// for the least itself jumps along a neck of even width. By hand: looked at three scans, at 0.7 and 1.4 of it: tapes
/// move by at most 2.17 and 0.54 %, intervals change by at most 39 and 13 %, 0 and 2 of 66 girths are refused.
const TIGHT_SHARE: f64 = 0.04;
/// How much longer the tape is at the tube's ends: as the base of a neck is longer than the neck, 1.104 ± 0.032 of it
/// (ANSUR II).
const LONGER_SHARE: f64 = 0.1;
/// How much wider, at least, the surface is below a neck and above it: shoulders and head. The top of a head is as
/// tight as a neck, but nothing above it is wider. Heads are 1.14 times as wide at least, chests 2.2 times (ANSUR II).
const WIDER_FACTORS: (f64, f64) = (1.1, 1.03);
/// How far about the neck the surface is looked at, in diameters. By hand: looked at three scans, at 0.7 and 1.4 of it:
/// no tape changes.
const AROUND_DIAMETERS: f64 = 2.2;

/// Upward, leaning forward by an angle; unit.
pub(crate) fn leaning(front: &Vector3<f64>, lean: f64) -> Vector3<f64> {
    Vector3::z() * libm::cos(lean) + front * libm::sin(lean)
}

impl Tube {
    /// The neck's mean diameter at its tightest. \[mm\]
    pub(crate) fn diameter(&self) -> f64 {
        self.girth / PI
    }

    /// The neck's axis: unit, upward.
    pub(crate) fn axis(&self) -> Vector3<f64> {
        leaning(&self.front, self.lean)
    }

    /// The neck's own forward, square to the axis.
    pub(crate) fn ahead(&self) -> Vector3<f64> {
        leaning(&self.front, self.lean + FRAC_PI_2)
    }

    /// The ring across the axis at an offset. \[mm\]
    pub(crate) fn ring(&self, offset: f64) -> Option<Ring> {
        let axis = self.axis();
        around(&self.part, &(self.origin + axis * offset), &axis)
    }
}

/// The largest ring around a point in the plane through it with a normal.
pub(crate) fn around(part: &Mesh, point: &Point3<f64>, normal: &Vector3<f64>) -> Option<Ring> {
    let plane = Plane {
        point_mm: (*point).into(),
        normal: (*normal).into(),
    };
    let holds = |r: &Ring| winds(&flat(&r.curve, &plane));
    rings(part, &plane).into_iter().find(holds)
}

/// Whether a closed polygon goes around the origin.
fn winds(points: &[[f64; 2]]) -> bool {
    let n = points.len();
    let crosses = |i: usize| {
        let (a, b) = (points[i], points[(i + 1) % n]);
        (a[1] > 0.0) != (b[1] > 0.0) && a[0] + (b[0] - a[0]) * a[1] / (a[1] - b[1]) > 0.0
    };
    area(points).abs() > 0.0 && (0..n).filter(|i| crosses(*i)).count() % 2 == 1
}

/// Finds the neck about the level section at its narrowest; `front` is the way the body faces, `crown` the
/// height of the highest point. \[mm\] `None` where no plane is tighter than those above and below.
pub(crate) fn tube(mesh: &Mesh, narrowest: &Ring, front: Vector3<f64>, crown: f64) -> Option<Tube> {
    let wide = narrowest.tape / PI;
    let middle = narrowest.centre;
    let reach = AROUND_DIAMETERS * wide;
    let part = near(mesh, &middle, reach, (middle.z - reach, crown));
    let leans: Vec<f64> = (LEANS.0..=LEANS.1)
        .step_by(LEANS.2)
        .map(|d| f64::from(d).to_radians())
        .collect();
    let offsets: Vec<f64> = (-STEPS..=STEPS)
        .map(|k| f64::from(k) * STEP * wide)
        .collect();
    let at = |lean: f64, offset: f64| {
        let normal = leaning(&front, lean);
        around(&part, &(middle + normal * offset), &normal)
    };
    let tapes: Vec<f64> = (0..leans.len() * offsets.len())
        .into_par_iter()
        .map(|i| at(leans[i / offsets.len()], offsets[i % offsets.len()]))
        .map(|ring| ring.map_or(f64::INFINITY, |r| r.tape))
        .collect();
    let [row, column] = tightest(&tapes, offsets.len())?;
    let lean = leans[0] + row * (leans[1] - leans[0]);
    let ring = at(lean, offsets[0] + column * (offsets[1] - offsets[0]))?;
    let mut tube = Tube {
        origin: ring.centre,
        girth: ring.tape,
        ends: (0.0, 0.0),
        part,
        front,
        lean,
    };
    // The line of the middles, and the tube along it.
    tube.ends = ends(&tube)?;
    tube.lean = line(&tube)?;
    let ring = tube.ring(0.0)?;
    (tube.origin, tube.girth) = (ring.centre, ring.tape);
    tube.ends = ends(&tube)?;
    Some(tube)
}

/// The middle of the tightest planes that hang together, in steps of a grid with rows so wide; a row goes
/// up from shoulders to head. `None` where none has both wider below and wider above.
fn tightest(tapes: &[f64], wide: usize) -> Option<[f64; 2]> {
    let central: Vec<bool> = (0..tapes.len())
        .map(|i| {
            let (row, k) = tapes[i - i % wide..][..wide].split_at(i % wide);
            let closed: Vec<f64> = k[1..].iter().copied().filter(|t| t.is_finite()).collect();
            let (own, head) = (k[0], longest(&closed));
            own.is_finite()
                && longest(row) >= WIDER_FACTORS.0 * own
                && head >= WIDER_FACTORS.1 * own
        })
        .collect();
    let own = (0..tapes.len()).filter(|i| central[*i]);
    let least = own.min_by(|a, b| tapes[*a].total_cmp(&tapes[*b]))?;
    let weight = |i: usize| match central[i] {
        true => 1.0 - (tapes[i] / tapes[least] - 1.0) / TIGHT_SHARE,
        false => 0.0,
    };
    let mut seen = vec![false; tapes.len()];
    let (mut open, mut sum, mut total) = (vec![least], [0.0; 2], 0.0);
    seen[least] = true;
    while let Some(i) = open.pop() {
        let (row, column) = (i / wide, i % wide);
        let w = weight(i);
        sum[0] += w * row as f64;
        sum[1] += w * column as f64;
        total += w;
        let sides = [
            (column > 0).then(|| i - 1),
            (column + 1 < wide).then_some(i + 1),
            i.checked_sub(wide),
            (i + wide < tapes.len()).then_some(i + wide),
        ];
        for next in sides.into_iter().flatten() {
            if !seen[next] && weight(next) > 0.0 {
                seen[next] = true;
                open.push(next);
            }
        }
    }
    Some(sum.map(|s| s / total))
}

/// The longest of tapes; 0 of none. Planes that are not closed on the shoulders are the longest.
fn longest(tapes: &[f64]) -> f64 {
    tapes.iter().copied().fold(0.0, f64::max)
}

/// Offsets up and down the axis at which the tape is [`LONGER_SHARE`]. \[mm\]
fn ends(tube: &Tube) -> Option<(f64, f64)> {
    let step = STEP / 4.0 * tube.diameter();
    let limit = (1.0 + LONGER_SHARE) * tube.girth;
    let end = |way: f64| {
        let (mut before, mut at) = (tube.girth, 0.0);
        for k in 1..=60 {
            let offset = way * step * f64::from(k);
            let tape = tube.ring(offset).map_or(2.0 * limit, |r| r.tape);
            if tape >= limit {
                let share = ((limit - before) / (tape - before)).clamp(0.0, 1.0);
                return Some(at + way * step * share);
            }
            (before, at) = (tape, offset);
        }
        None
    };
    Some((end(1.0)?, end(-1.0)?))
}

/// Where between the ends the middles are looked at: from, step, how many; shares (structural: the grid of a search).
const MIDDLES: (f64, f64, u32) = (0.1, 0.08, 11);

/// How far the line of the sections' middles leans, between the tube's ends. \[rad\]
fn line(tube: &Tube) -> Option<f64> {
    let (up, low) = tube.ends;
    let at = |k: u32| {
        let share = MIDDLES.0 + MIDDLES.1 * f64::from(k);
        let way = tube.ring(low + (up - low) * share)?.centre - tube.origin;
        Some((way.dot(&tube.axis()), way.dot(&tube.ahead())))
    };
    let points: Vec<(f64, f64)> = (0..MIDDLES.2).filter_map(at).collect();
    let n = points.len() as f64;
    let mean = points
        .iter()
        .fold((0.0, 0.0), |s, p| (s.0 + p.0 / n, s.1 + p.1 / n));
    let (along, across) = points.iter().fold((0.0, 0.0), |s, p| {
        let d = (p.0 - mean.0, p.1 - mean.1);
        (s.0 + d.0 * d.0, s.1 + d.0 * d.1)
    });
    (along > 0.0).then(|| tube.lean + libm::atan(across / along))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tightest_are_those_that_hang_together_and_none_at_the_end_of_a_row() {
        let row = |x: [f64; 5]| x.map(|t| 100.0 * t);
        let grid = [
            row([1.3, 1.02, 1.0, 1.02, 1.2]),
            row([1.3, 1.2, 1.02, 1.2, 1.001]),
        ]
        .concat();
        let [at, along] = tightest(&grid, 5).unwrap();
        proof::near(along, 2.0, 1e-9);
        proof::near(at, 0.5 / 2.5, 1e-9);
        assert_eq!(tightest(&row([0.9, 1.0, 1.1, 1.2, 1.3]), 5), None);
        assert_eq!(tightest(&[f64::INFINITY; 5], 5), None);
    }
}
