//! Sections down an upper arm from a plane of it: the arm's own, and the clearest, by which hidden parts are completed.

use crate::features::body::Body;
use crate::features::limb::away;
use crate::geometry::crop::slab;
use crate::geometry::section::{axes, flat, hull};
use crate::geometry::slices::{Ring, nearest_ring};
use crate::sections::one::{FUSED, Why};
use nalgebra::{Point3, Vector3};
use shape::{Mesh, Plane};
use std::f64::consts::PI;

/// How round an arm's own section is at least: its area against a circle's of the same tape. By hand: looked at three
/// scans, at 0.7 and 1.4 of it: tapes move by at most 0.28 and 0 %, intervals change by at most 12 and 0 %, 0 and 10 of
/// 66 girths are refused.
pub(super) const LEAST_ROUND: f64 = 0.93;
/// As round as this, nothing hangs on it. By hand: looked at three scans, at 0.7 and 1.4 of it: tapes move by at most
/// 0.34 and 0.31 %, intervals change by at most 20 and 18 %.
pub(super) const CLEAN_ROUND: f64 = 0.96;
/// How far down the arm a clear section is looked for, as a share of stature: above the elbow, which is a tenth of it
/// from the middle of the upper arm (half of 0.169 to 0.214 from acromion to radiale, ANSUR II).
const DOWN_SHARE: f64 = 0.078;
/// From one section to the next, as a share of stature; structural, the spacing of samples.
const STEP: f64 = 0.004;

/// How far up from a plane an arm's sections are looked at, in edges of the mesh (structural: an error of one is smaller by nearly
/// all chance), and by how many steps (structural: samples).
const UP: f64 = 4.0;
/// Places up to there that are asked (structural: samples).
const STEPS_UP: u8 = 8;

/// A ring's area against a circle's of the same tape.
pub(super) fn round(ring: &Ring) -> f64 {
    4.0 * PI * ring.area / (ring.tape * ring.tape)
}

/// How far a ring is from all the rest of its plane; endless where it is alone. \[mm\]
pub(super) fn gap(ring: &Ring, all: &[Ring]) -> f64 {
    let rest = all
        .iter()
        .filter(|o| (o.centre - ring.centre).norm() > 1e-6);
    let pieces = rest.flat_map(|o| o.curve.iter().zip(o.curve.iter().cycle().skip(1)));
    let far = |(a, b): (&Point3<f64>, &Point3<f64>)| {
        let along = b - a;
        let nearest = |p: &Point3<f64>| {
            let t = (p - a).dot(&along) / along.norm_squared().max(1e-12);
            (p - (a + along * t.clamp(0.0, 1.0))).norm()
        };
        ring.curve.iter().map(nearest).fold(f64::MAX, f64::min)
    };
    pieces.map(far).fold(f64::MAX, f64::min)
}

/// An arm from a plane of it down.
pub(super) struct DownArm<'a> {
    plane: &'a Plane,
    down: Vector3<f64>,
    step: f64,
    stature: f64,
    /// The trunk's area; sections of the arm are far smaller.
    trunk: f64,
    /// The last step down.
    pub(super) last: i32,
    /// The surface about these steps.
    pub(super) part: Mesh,
}

/// A clear section, and how what is above it is seen from there.
pub(super) struct Clear {
    /// The first step at which the arm is alone, and that of the clear section.
    pub(super) steps: [i32; 2],
    /// The middle of the arm in the plane.
    pub(super) origin: Point3<f64>,
    /// The clear section about its middle, in the axes of the plane. \[mm\]
    pub(super) reference: Vec<[f64; 2]>,
    /// The way that points away from the trunk, in these.
    pub(super) outward: [f64; 2],
}

impl<'a> DownArm<'a> {
    /// Of a plane whose normal points down the arm.
    pub(super) fn of(mesh: &Mesh, body: &Body, plane: &'a Plane) -> DownArm<'a> {
        let step = STEP * body.stature;
        let last = (DOWN_SHARE / STEP) as i32;
        let level = body.crotch.unwrap_or(body.ground + 0.5 * body.stature) + 0.08 * body.stature;
        DownArm {
            plane,
            down: Vector3::from(plane.normal).normalize(),
            step,
            stature: body.stature,
            trunk: body.trunk(level).map_or(f64::MAX, |r| r.area),
            last,
            part: slab(
                mesh,
                plane,
                -step.max(UP * mesh.mean_edge()),
                f64::from(last + 1) * step,
            ),
        }
    }

    /// The section so many steps down, if it is small and about the arm's axis.
    pub(super) fn small(&self, k: i32) -> Option<(i32, Ring)> {
        let mm = f64::from(k) * self.step;
        (k <= self.last).then(|| Some((k, self.at(mm)?)))?
    }

    /// The same, so far down. \[mm\]
    fn at(&self, mm: f64) -> Option<Ring> {
        let point = Point3::from(self.plane.point_mm) + self.down * mm;
        let there = Plane {
            point_mm: point.into(),
            ..*self.plane
        };
        let ring = nearest_ring(&self.part, &there)?;
        let near = (ring.centre - point).norm() < 0.02 * self.stature;
        (ring.area < 0.25 * self.trunk && near).then_some(ring)
    }

    /// How far up from the plane its sections are small, as far as [`UP`] edges. \[mm\]
    pub(super) fn clear_up(&self, edge: f64) -> f64 {
        let most = UP * edge;
        let way = |i: f64| most * i / f64::from(STEPS_UP);
        let Some(ends) = (1..=STEPS_UP)
            .map(f64::from)
            .find(|i| self.at(-way(*i)).is_none())
        else {
            return most;
        };
        let halved = (0..4).fold((way(ends - 1.0), way(ends)), |(clear, not), _| {
            let middle = (clear + not) / 2.0;
            match self.at(-middle) {
                Some(_) => (middle, not),
                None => (clear, middle),
            }
        });
        (halved.0 + halved.1) / 2.0
    }

    /// The same, if it is round, too: the arm's alone.
    pub(super) fn alone(&self, k: i32) -> Option<(i32, Ring)> {
        self.small(k).filter(|(_, ring)| round(ring) > LEAST_ROUND)
    }

    /// The roundest of the first that are the arm's alone; `own` is the section in the plane.
    pub(super) fn clear(&self, own: Option<&Ring>, body: &Body, side: f64) -> Result<Clear, Why> {
        let alone = |k| self.alone(k);
        let first = (1..=self.last).find_map(alone).ok_or(FUSED)?.0;
        let (steps, clear) = (first..first + 10)
            .filter_map(alone)
            .max_by(|a, b| round(&a.1).total_cmp(&round(&b.1)))
            .ok_or(FUSED)?;
        let (u, v) = axes(self.plane);
        let out = away(self.down, body.left, side).ok_or(FUSED)?;
        Ok(Clear {
            steps: [first, steps],
            origin: match own {
                Some(ring) => ring.centre,
                None => clear.centre - self.down * (f64::from(steps) * self.step),
            },
            reference: hull(&flat_about(&clear, clear.centre, self.plane)),
            outward: [u.dot(&out), v.dot(&out)],
        })
    }
}

impl Clear {
    /// A ring about the middle of the arm, in the axes of the plane. \[mm\]
    pub(super) fn flat(&self, ring: &Ring, plane: &Plane) -> Vec<[f64; 2]> {
        flat_about(ring, self.origin, plane)
    }
}

fn flat_about(ring: &Ring, origin: Point3<f64>, plane: &Plane) -> Vec<[f64; 2]> {
    let about = Plane {
        point_mm: origin.into(),
        ..*plane
    };
    flat(&ring.curve, &about)
}
