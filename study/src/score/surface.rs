//! How far a surface is from the true one: both ways, in all and on the trunk.

use crate::score::align::{Motion, align};
use crate::score::truth::True;
use follow::Closest;
use nalgebra::{Point3, Vector3};
use rayon::prelude::*;
use serde::Serialize;
use shape::{GirthId, Mesh};
use std::collections::BTreeMap;

/// Distances of one part. \[mm, shares of 1\]
#[derive(Debug, Clone, Serialize)]
pub struct Part {
    /// Mean distance from the surface to the true one.
    pub accuracy_mean_mm: f64,
    /// Nine tenths of the surface are at most so far from the true one.
    pub accuracy_90_mm: f64,
    /// Mean signed distance of all within 20 mm: positive is too fat.
    pub bias_mm: f64,
    /// Share of the true surface that has some of ours within 2 mm.
    pub complete_2mm: f64,
    /// Share of the true surface that has some of ours within 5 mm.
    pub complete_5mm: f64,
}

/// The figures of a surface.
#[derive(Debug, Clone, Serialize)]
pub struct Surface {
    /// How many faces it has.
    pub faces: usize,
    /// Whether it is closed, manifold and consistently oriented.
    pub closed: bool,
    /// Everywhere.
    pub all: Part,
    /// Between hip and chest, arms left out.
    pub trunk: Option<Part>,
}

const SAMPLES: usize = 60_000;
/// Points by which surfaces are aligned.
const ALIGNED: usize = 20_000;
/// The soles touch the disk: nobody sees them. \[mm\]
const SOLES_MM: f64 = 20.0;

/// The motion that carries a surface onto the true one: after the one that aligned the cameras, a
/// trimmed rigid alignment of the surfaces (no scale).
pub(crate) fn carried(found: &Mesh, truth: &Mesh, start: Motion) -> Option<Motion> {
    let tree = Closest::new(truth);
    let points = samples(found, ALIGNED);
    let mut carry = start;
    for _ in 0..60 {
        let mut pairs: Vec<_> = points
            .par_iter()
            .map(|p| carry.apply(p))
            .filter_map(|p| tree.to(&p).map(|hit| (hit.distance, p, hit.point)))
            .collect();
        pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
        pairs.truncate(pairs.len() * 8 / 10);
        let pairs: Vec<_> = pairs.into_iter().map(|(_, p, q)| (p, q)).collect();
        let step = align(&pairs, false)?;
        carry = carry.then(&step);
        if step.translation.norm() < 1e-3 && step.rotation.angle() < 1e-6 {
            break;
        }
    }
    Some(carry)
}

/// Holds a surface against the true one after the motion that carries it there.
pub(crate) fn surface(
    found: &Mesh,
    truth: &Mesh,
    carry: &Motion,
    girths: &BTreeMap<String, True>,
) -> Option<Surface> {
    let ours = moved(found, carry);
    let tree = Closest::new(truth);
    let soles = truth.bounds()?.0.z + SOLES_MM;
    let above = |points: Vec<Point3<f64>>| -> Vec<_> {
        points.into_iter().filter(|p| p.z > soles).collect()
    };
    let (p, q) = (
        above(samples(&ours, SAMPLES)),
        above(samples(truth, SAMPLES)),
    );
    let back = Closest::new(&ours);
    let to_truth: Vec<f64> = p.par_iter().filter_map(|p| tree.signed(p)).collect();
    let to_ours: Vec<f64> = q
        .par_iter()
        .filter_map(|q| back.to(q).map(|h| h.distance))
        .collect();
    let inside = trunk(girths);
    let part = |inside: &dyn Fn(&Point3<f64>) -> bool| {
        let pick = |points: &[Point3<f64>], d: &[f64]| -> Vec<f64> {
            points
                .iter()
                .zip(d)
                .filter(|(p, _)| inside(p))
                .map(|(_, d)| *d)
                .collect()
        };
        distances(&pick(&p, &to_truth), &pick(&q, &to_ours))
    };
    Some(Surface {
        faces: found.faces.len(),
        closed: found.validate_closed().is_ok(),
        all: part(&|_| true)?,
        trunk: inside.and_then(|inside| part(&inside)),
    })
}

fn distances(signed: &[f64], back: &[f64]) -> Option<Part> {
    if signed.is_empty() || back.is_empty() {
        return None;
    }
    let mut far: Vec<f64> = signed.iter().map(|d| d.abs()).collect();
    far.sort_by(f64::total_cmp);
    let near: Vec<f64> = signed.iter().copied().filter(|d| d.abs() < 20.0).collect();
    let share = |most: f64| back.iter().filter(|d| **d < most).count() as f64 / back.len() as f64;
    Some(Part {
        accuracy_mean_mm: far.iter().sum::<f64>() / far.len() as f64,
        accuracy_90_mm: far[far.len() * 9 / 10],
        bias_mm: near.iter().sum::<f64>() / near.len().max(1) as f64,
        complete_2mm: share(2.0),
        complete_5mm: share(5.0),
    })
}

/// The trunk: between the planes of hip and chest, near the axis through the waist.
fn trunk(girths: &BTreeMap<String, True>) -> Option<impl Fn(&Point3<f64>) -> bool + use<>> {
    let known = |id: GirthId| girths.get(&id.name());
    let plane = |id: GirthId| known(id).and_then(|g| g.plane);
    let (hip, chest) = (plane(GirthId::Hip)?.0.z, plane(GirthId::Chest)?.0.z);
    let widest = [GirthId::Waist, GirthId::Hip, GirthId::Chest]
        .into_iter()
        .filter_map(|id| Some(known(id)?.contour_mm));
    let radius = widest.fold(0.0, f64::max) / std::f64::consts::TAU * 1.35;
    let axis = plane(GirthId::Waist)?.0;
    Some(move |p: &Point3<f64>| {
        p.z > hip.min(chest)
            && p.z < hip.max(chest)
            && libm::hypot(p.x - axis.x, p.y - axis.y) < radius
    })
}

/// The mesh, carried.
fn moved(mesh: &Mesh, motion: &Motion) -> Mesh {
    let carry = |v: u32| motion.apply(&mesh.point(v)).coords.map(|x| x as f32).into();
    Mesh {
        positions: (0..mesh.positions.len() as u32).map(carry).collect(),
        ..mesh.clone()
    }
}

/// Points spread evenly over the surface: one a share of the area, at the face's
/// low-discrepancy place (R2 sequence, Roberts 2018).
fn samples(mesh: &Mesh, count: usize) -> Vec<Point3<f64>> {
    let areas: Vec<f64> = (0..mesh.faces.len())
        .map(|f| mesh.area_vector(f).norm())
        .collect();
    let stride = areas.iter().sum::<f64>() / count as f64;
    let (mut points, mut filled) = (Vec::with_capacity(count), stride / 2.0);
    let golden = Vector3::new(0.754_877_666_246_693, 0.569_840_290_998_053, 0.0);
    for (f, area) in areas.iter().enumerate() {
        filled += area;
        while filled >= stride && stride > 0.0 {
            filled -= stride;
            let at = golden * points.len() as f64;
            let (mut u, mut v) = (at.x.fract(), at.y.fract());
            if u + v > 1.0 {
                (u, v) = (1.0 - u, 1.0 - v);
            }
            let [a, b, c] = mesh.triangle(f);
            points.push(a + (b - a) * u + (c - a) * v);
        }
    }
    points
}
