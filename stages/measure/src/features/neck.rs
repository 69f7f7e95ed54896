//! The neck, between head and shoulders: what tells how high it is and how far it leans.
//!
//! A girth of the neck is taken amid the joints of its base and of the head, across the line from one
//! to the other. Neither joint shows. What does: the level of the ears, which make a head seen from the
//! front widest (the joint of the head lies between them), the shoulders, where a cut across the
//! neck grows far beyond the head, how far the head is carried before the shoulders, and the whole
//! outline around (`neck_level.rs`).
//!
//! An ear is widest over a long flat stretch whose highest point moves by half an ear when a coarse
//! surface rounds it. Where it begins and where it ends does not: both edges at half height.

use crate::features::body::Body;
use crate::features::marks::{breadth, extent};
use crate::features::neck_level::level;
use crate::geometry::slices::{Ring, Slice, rings, slices};
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
    /// Offset of the ears' middle, as if they were above the origin.
    pub ears: f64,
    /// Offset of the cut that is a fifth longer than the head is around: shoulders.
    pub shoulders: f64,
    /// Offset of the plane amid the neck's two joints, as the outline tells it.
    pub level: f64,
    /// How high the head is, from the origin to the crown. \[mm\]
    pub head: f64,
    /// How far the shoulders' middle lies before the origin. \[mm\]
    pub back: f64,
    /// How far the skull's middle, half way from ears to crown, lies before that of the shoulders. \[mm\]
    pub ahead: f64,
}

/// How far necks usually lean forward. \[rad\]
const USUAL: f64 = 20.0 * std::f64::consts::PI / 180.0;
/// How much longer than the head is around a cut across the neck is at the shoulders.
const SHOULDERS: f64 = 1.2;
/// How much wider than the neck's narrowest the outline from the front is at the shoulders.
const WIDE: f64 = 2.5;
/// How far behind the middle of a neck's section lies what planes of other leans turn about, as a share
/// of its radius. About the joints, at 0.26, two degrees change a tape by 1.1 % in the middle of bodies,
/// for below the chin necks widen faster than at the nape; about the middle, by 0.6 %. But the level
/// is told best at the joints: this lies between.
const BEHIND: f64 = 0.1;

impl Throat {
    /// The plane across the usual axis at an offset.
    pub fn plane(&self, offset: f64) -> Plane {
        Plane {
            point_mm: (self.origin + self.axis * offset).into(),
            normal: self.axis.into(),
        }
    }

    /// The plane at an offset whose normal leans forward by an angle, turned near the neck's middle. \[rad\] `None` where there is no neck.
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
        raw.windows(3).map(three).collect::<Vec<_>>()
    };
    let across = |r: &Ring| extent(r, &body.left).map(|e| e.1 - e.0);
    let ears = ears(&profile(&across), crown)?;
    let around = top(&profile(&|r| Some(r.tape)))?;
    let skull = head.iter().find(|s| s.z >= (ears + crown) / 2.0)?;
    let full = |s: &Slice| breadth(s, &body.left);
    let below = slices(mesh, narrowest - 0.15 * body.stature, narrowest, fine);
    let narrow = below.iter().chain(&head).take_while(|s| s.z < ears);
    let narrow = narrow
        .filter_map(|s| across(s.rings.first()?))
        .reduce(f64::min)?;
    let shoulders = below
        .iter()
        .rev()
        .find(|s| full(s).is_some_and(|wide| wide >= WIDE * narrow))?;
    let middle = shoulders.rings.first()?.centre.coords.dot(&body.front);
    let mut throat = Throat {
        origin,
        axis: axis(body, USUAL),
        ears: (ears - origin.z) * USUAL.cos(),
        shoulders: 0.0,
        level: 0.0,
        head: crown - origin.z,
        back: middle - origin.coords.dot(&body.front),
        ahead: skull.rings.first()?.centre.coords.dot(&body.front) - middle,
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
    let all: Vec<&Slice> = below.iter().chain(&head).collect();
    throat.level = level(body, &throat, ears, &all);
    Some(throat)
}

/// How far from the widest level the head has its own width again, above and below, as a share of the
/// way to the crown.
const EAR: (f64, f64) = (0.25, 0.45);

/// The middle of the ears: amid the two levels where they stand out half as far as at their widest.
/// From widths seen from the front over height. `None` where the head is no narrower above or below.
fn ears(width: &[(f64, f64)], crown: f64) -> Option<f64> {
    let i = (0..width.len()).max_by(|a, b| width[*a].1.total_cmp(&width[*b].1))?;
    let (widest, most) = width[i];
    let edge = |away: &mut dyn Iterator<Item = &(f64, f64)>, reach: f64| {
        let reach = reach * (crown - widest);
        let way: Vec<(f64, f64)> = away
            .take_while(|w| (w.0 - widest).abs() <= reach)
            .copied()
            .collect();
        let half = (most + way.last()?.1) / 2.0;
        let k = way.iter().position(|w| w.1 < half).filter(|k| *k > 0)?;
        let (near, far) = (way[k - 1], way[k]);
        Some(near.0 + (near.1 - half) / (near.1 - far.1) * (far.0 - near.0))
    };
    let above = edge(&mut width[i..].iter(), EAR.0)?;
    let below = edge(&mut width[..=i].iter().rev(), EAR.1)?;
    Some((above + below) / 2.0)
}

/// How great a profile is where it is greatest.
fn top(profile: &[(f64, f64)]) -> Option<f64> {
    profile.iter().map(|p| p.1).max_by(f64::total_cmp)
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

    /// A head 150 wide with ears from 100 to 145, farthest out near their upper end.
    fn head(rounding: i32) -> Vec<(f64, f64)> {
        let sharp = |z: f64| match z {
            z if z < 100.0 => 120.0,
            z if z < 145.0 => 160.0 + 20.0 * (z - 100.0) / 45.0,
            _ => 150.0,
        };
        let near = |z: f64| (-rounding..=rounding).map(move |k| sharp(z + f64::from(k)));
        let mean = |z: f64| near(z).sum::<f64>() / f64::from(2 * rounding + 1);
        (60..250)
            .map(|k| (f64::from(k), mean(f64::from(k))))
            .collect()
    }

    #[test]
    fn a_surface_that_rounds_the_ears_moves_their_widest_level_but_not_their_middle() {
        let widest = |w: &[(f64, f64)]| {
            let most = w.iter().max_by(|a, b| a.1.total_cmp(&b.1));
            most.unwrap().0
        };
        let (sharp, round) = (head(0), head(8));
        assert!(widest(&sharp) - widest(&round) > 7.0);
        proof::near(ears(&sharp, 250.0).unwrap(), 122.0, 1.0);
        proof::near(
            ears(&round, 250.0).unwrap(),
            ears(&sharp, 250.0).unwrap(),
            2.0,
        );
    }

    #[test]
    fn a_head_without_ears_has_no_middle_of_them() {
        let cone: Vec<(f64, f64)> = (0..100)
            .map(|k| (f64::from(k), 200.0 - f64::from(k)))
            .collect();
        assert_eq!(ears(&cone, 100.0), None);
        assert_eq!(ears(&[], 100.0), None);
    }
}
