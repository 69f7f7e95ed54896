//! The neck, between head and shoulders: what tells how high it is and how far it leans.
//!
//! A girth of the neck is taken amid the joints of its base and of the head, across the line from one
//! to the other. Neither joint shows. What does: the level of the ears, where a head seen from the
//! front is widest (the joint of the head lies between them), the shoulders, where a cut across the
//! neck grows far beyond the head, and how far the head is carried before the shoulders. How thin the
//! neck itself is tells little: it differs most from body to body.

use crate::body::Body;
use crate::marks::extent;
use crate::slices::{Ring, Slice, rings, slices};
use nalgebra::{Point3, Vector3};
use rayon::prelude::*;
use shape::{Mesh, Plane};
use std::f64::consts::TAU;

/// What head and shoulders tell. Offsets along the axis from the middle of the level section at the
/// neck's narrowest. \[mm\]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Throat {
    /// That middle.
    pub origin: Point3<f64>,
    /// A usual axis, unit, upward and leaning forward.
    pub axis: Vector3<f64>,
    /// Offset of the ears, as if they were above the origin.
    pub ears: f64,
    /// Offset of the cut that is a fifth longer than the head is around: shoulders.
    pub shoulders: f64,
    /// How far the shoulders' middle lies before the origin. \[mm\]
    pub back: f64,
    /// How far the head's middle lies before that of the shoulders. \[mm\]
    pub ahead: f64,
}

/// How far necks usually lean forward. \[rad\]
const USUAL: f64 = 20.0 * std::f64::consts::PI / 180.0;
/// How much longer than the head is around a cut across the neck is at the shoulders.
const SHOULDERS: f64 = 1.2;
/// How much wider than the neck's narrowest the outline from the front is at the shoulders.
const WIDE: f64 = 2.5;
/// How far behind the middle of a neck's section its axis runs, as a share of its radius: vertebrae
/// lie behind the middle. The median of the bodies that levels were fitted on.
const BEHIND: f64 = 0.26;

impl Throat {
    /// The plane across the usual axis at an offset.
    pub fn plane(&self, offset: f64) -> Plane {
        Plane {
            point_mm: (self.origin + self.axis * offset).into(),
            normal: self.axis.into(),
        }
    }

    /// The plane at an offset whose normal leans forward by an angle, turned about the neck's own
    /// axis. \[rad\] `None` where there is no neck.
    pub fn leaning(&self, mesh: &Mesh, body: &Body, offset: f64, lean: f64) -> Option<Plane> {
        let ring = neck_ring(mesh, body, &self.plane(offset))?;
        let backward = Vector3::z() * USUAL.sin() - body.front * USUAL.cos();
        let pivot = ring.centre + backward * (BEHIND * ring.tape / TAU);
        let normal = axis(body, lean);
        // The same plane, named by a point near the middle of its ring.
        let middle = ring.centre - normal * (ring.centre - pivot).dot(&normal);
        let plane = Plane {
            point_mm: middle.into(),
            normal: normal.into(),
        };
        let ring = neck_ring(mesh, body, &plane)?;
        Some(Plane {
            point_mm: ring.centre.into(),
            ..plane
        })
    }
}

fn axis(body: &Body, lean: f64) -> Vector3<f64> {
    Vector3::z() * lean.cos() + body.front * lean.sin()
}

/// Reads head and shoulders. `None` without a neck between them.
pub fn throat(mesh: &Mesh, body: &Body) -> Option<Throat> {
    let narrowest = body.neck?;
    let origin = body.trunk(narrowest)?.centre;
    let crown = body.ground + body.stature;
    let fine = body.stature / 800.0;
    let head = slices(mesh, narrowest, crown, fine);
    let profile = |value: &dyn Fn(&Ring) -> Option<f64>| {
        let raw: Vec<(f64, f64)> = head
            .iter()
            .filter_map(|s| Some((s.z, value(s.rings.first()?)?)))
            .collect();
        // Each the mean of three: a hull's facets jump.
        let three = |w: &[(f64, f64)]| (w[1].0, (w[0].1 + w[1].1 + w[2].1) / 3.0);
        top(&raw.windows(3).map(three).collect::<Vec<_>>())
    };
    let across = |r: &Ring| extent(r, &body.left).map(|e| e.1 - e.0);
    let ears = profile(&across)?.0;
    let around = profile(&|r| Some(r.tape))?.1;
    let forward = profile(&|r| extent(r, &body.front).map(|e| e.1))?.1;
    let backward = profile(&|r| extent(r, &body.front).map(|e| -e.0))?.1;
    let full = |s: &Slice| {
        let all = s.rings.iter().filter_map(|r| extent(r, &body.left));
        all.reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)))
    };
    let below = slices(mesh, narrowest - 0.15 * body.stature, narrowest, fine);
    let narrow = below.iter().chain(&head).take_while(|s| s.z < ears);
    let narrow = narrow
        .filter_map(|s| across(s.rings.first()?))
        .reduce(f64::min)?;
    let shoulders = below
        .iter()
        .rev()
        .find(|s| full(s).is_some_and(|(lo, hi)| hi - lo >= WIDE * narrow))?;
    let middle = shoulders.rings.first()?.centre.coords.dot(&body.front);
    let mut throat = Throat {
        origin,
        axis: axis(body, USUAL),
        ears: (ears - origin.z) * USUAL.cos(),
        shoulders: 0.0,
        back: middle - origin.coords.dot(&body.front),
        ahead: (forward - backward) / 2.0 - middle,
    };
    // Downward, unbroken, until a cut is as long as shoulders are.
    let step = body.stature / 400.0;
    let tapes: Vec<Option<f64>> = (0..=36)
        .into_par_iter()
        .map(|k| {
            let plane = throat.plane(-f64::from(k) * step);
            neck_ring(mesh, body, &plane).map(|r| r.tape)
        })
        .collect();
    let run: Vec<f64> = tapes.into_iter().map_while(|t| t).collect();
    let want = SHOULDERS * around;
    let at = (1..run.len()).find(|i| run[*i] >= want)?;
    let share = ((want - run[at - 1]) / (run[at] - run[at - 1])).clamp(0.0, 1.0);
    throat.shoulders = -step * (at as f64 - 1.0 + share);
    Some(throat)
}

/// Where a profile is greatest, between its samples, and how great.
fn top(profile: &[(f64, f64)]) -> Option<(f64, f64)> {
    let i = (0..profile.len()).max_by(|a, b| profile[*a].1.total_cmp(&profile[*b].1))?;
    let (z, most) = profile[i];
    let (Some(below), Some(above)) = (i.checked_sub(1).map(|j| profile[j]), profile.get(i + 1))
    else {
        return Some((z, most));
    };
    let bend = below.1 - 2.0 * most + above.1;
    let by = match bend < 0.0 {
        true => 0.5 * (below.1 - above.1) / bend,
        false => 0.0,
    };
    Some((z + by.clamp(-0.5, 0.5) * (above.0 - z), most))
}

/// The ring of the neck in a plane through its middle: the largest that is not far from there.
pub fn neck_ring(mesh: &Mesh, body: &Body, plane: &Plane) -> Option<Ring> {
    let middle = Point3::from(plane.point_mm);
    rings(mesh, plane)
        .into_iter()
        .find(|r| (r.centre - middle).norm() < 0.06 * body.stature)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_top_of_a_parabola_is_found_between_its_samples() {
        let at = |z: f64| (z, 5.0 - (z - 1.3).powi(2));
        let (z, _) = top(&[at(0.0), at(1.0), at(2.0), at(3.0)]).unwrap();
        proof::near(z, 1.3, 1e-12);
        assert_eq!(top(&[(0.0, 2.0), (1.0, 1.0)]), Some((0.0, 2.0)));
        assert_eq!(top(&[]), None);
    }
}
