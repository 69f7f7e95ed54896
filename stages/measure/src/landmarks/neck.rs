//! The neck, cut across its axis: how its tape runs from the shoulders to the jaw.

use crate::body::Body;
use crate::slices::{Ring, rings};
use nalgebra::{Point3, Vector3};
use rayon::prelude::*;
use shape::{Mesh, Plane};

/// What cuts across the neck's axis tell. Offsets along the axis from the middle of the level
/// section at the neck's narrowest. \[mm\]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Throat {
    /// That middle.
    pub origin: Point3<f64>,
    /// The axis, unit, upward and leaning forward.
    pub axis: Vector3<f64>,
    /// Offset of the least tape.
    pub least: f64,
    /// Offset above it at which the tape is an eighth longer: the jaw begins.
    pub jaw: f64,
    /// Offset below it at which the tape is a fifth longer: the shoulders begin.
    pub base: f64,
}

/// How much longer than the least the tape is where the jaw begins.
const JAW: f64 = 1.125;
/// How much longer than the least the tape is where the shoulders begin.
const BASE: f64 = 1.2;

impl Throat {
    /// The plane at an offset.
    pub fn plane(&self, offset: f64) -> Plane {
        Plane {
            point_mm: (self.origin + self.axis * offset).into(),
            normal: self.axis.into(),
        }
    }
}

/// Cuts the neck across an axis that leans forward by an angle. \[rad\] `None` without a neck.
pub fn throat(mesh: &Mesh, body: &Body, lean: f64) -> Option<Throat> {
    let axis = Vector3::z() * lean.cos() + body.front * lean.sin();
    let origin = body.trunk(body.neck?)?.centre;
    let mut throat = Throat {
        origin,
        axis,
        least: 0.0,
        jaw: 0.0,
        base: 0.0,
    };
    let step = body.stature / 400.0;
    let tapes: Vec<Option<f64>> = (-28..=40)
        .into_par_iter()
        .map(|k| {
            let plane = throat.plane(f64::from(k) * step);
            neck_ring(mesh, body, &plane).map(|r| r.tape)
        })
        .collect();
    // Only what goes on unbroken from the origin is neck.
    let offset = |i: usize| (i as f64 - 28.0) * step;
    let first = (0..28)
        .rev()
        .find(|i| tapes[*i].is_none())
        .map_or(0, |i| i + 1);
    let last = (28..tapes.len())
        .find(|i| tapes[*i].is_none())
        .unwrap_or(tapes.len());
    let run: Vec<(f64, f64)> = (first..last)
        .filter_map(|i| Some((offset(i), tapes[i]?)))
        .collect();
    let inner = |t: f64| t >= -20.0 * step && t <= 28.0 * step;
    let at = (0..run.len())
        .filter(|i| inner(run[*i].0))
        .min_by(|a, b| run[*a].1.total_cmp(&run[*b].1))?;
    throat.least = run[at].0;
    let crossing = |from: (f64, f64), to: (f64, f64), share: f64| {
        let want = share * run[at].1;
        from.0 + (to.0 - from.0) * ((want - from.1) / (to.1 - from.1)).clamp(0.0, 1.0)
    };
    let wider = |i: usize, share: f64| run[i].1 > share * run[at].1;
    throat.jaw = (at..run.len())
        .find(|i| wider(*i, JAW))
        .map_or(run.last()?.0, |i| crossing(run[i - 1], run[i], JAW));
    throat.base = (0..=at)
        .rev()
        .find(|i| wider(*i, BASE))
        .map_or(run.first()?.0, |i| crossing(run[i + 1], run[i], BASE));
    Some(throat)
}

/// The ring of the neck in a plane through its middle: the largest that is not far from there.
pub fn neck_ring(mesh: &Mesh, body: &Body, plane: &Plane) -> Option<Ring> {
    let middle = Point3::from(plane.point_mm);
    rings(mesh, plane)
        .into_iter()
        .find(|r| (r.centre - middle).norm() < 0.06 * body.stature)
}
