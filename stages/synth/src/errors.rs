//! How far cameras, silhouettes and surfaces are from the truth.

use crate::field::Field;
use crate::frame::turn_between;
use nalgebra::Rotation3;
use rayon::prelude::*;
use shape::{Cameras, Mask, Mesh, Solid};

/// How far cameras are off.
pub(crate) struct CameraErrors {
    /// How many of the true cameras were found.
    pub found: usize,
    /// Median distance of centres, after a turn about the axis. \[mm\]
    pub median_mm: f64,
    /// Greatest distance.
    pub worst_mm: f64,
    /// Relative error of the ring's radius.
    pub scale: f64,
    /// Relative error of the first focal length.
    pub focal: f64,
}

/// Cameras against the true ones, after a turn about the axis.
pub(crate) fn camera_errors(found: &Cameras, truth: &Cameras) -> CameraErrors {
    let turn = turn_between(found, truth);
    let (mut far, mut radii, mut focal) = (vec![], (0.0, 0.0), 0.0);
    for (_, a, b) in found.views.join(&truth.views) {
        let (at, want) = (turn * a.camera.centre(), b.camera.centre());
        far.push((at - want).norm());
        radii.0 += libm::hypot(at.x, at.y);
        radii.1 += libm::hypot(want.x, want.y);
        focal = a.camera.lens.focal[0] / b.camera.lens.focal[0] - 1.0;
    }
    far.sort_by(f64::total_cmp);
    CameraErrors {
        found: far.len(),
        median_mm: far.get(far.len() / 2).copied().unwrap_or(f64::MAX),
        worst_mm: far.last().copied().unwrap_or(f64::MAX),
        scale: radii.0 / radii.1 - 1.0,
        focal,
    }
}

/// Intersection over union of two silhouettes of one size; 0 of two sizes.
pub(crate) fn overlap(a: &Mask, b: &Mask) -> f64 {
    if (a.width, a.height) != (b.width, b.height) {
        return 0.0;
    }
    let (mut both, mut either) = (0u64, 0u64);
    for (p, q) in a.data.iter().zip(&b.data) {
        both += u64::from(*p > 127 && *q > 127);
        either += u64::from(*p > 127 || *q > 127);
    }
    both as f64 / either.max(1) as f64
}

/// How far a surface is off.
pub(crate) struct SurfaceErrors {
    /// Mean distance of its vertices from the solid's surface. \[mm\]
    pub mean_mm: f64,
    /// The same, outward positive, inward negative.
    pub outward_mm: f64,
    /// Nineteen of twenty vertices are nearer.
    pub p95_mm: f64,
}

/// A mesh's vertices, turned into the solid's frame, against its surface; distances are the
/// formula's value over its slope, good near the surface.
pub(crate) fn surface_errors(mesh: &Mesh, solid: &Solid, turn: &Rotation3<f64>) -> SurfaceErrors {
    let field = Field::new(solid);
    let count = mesh.positions.len() as u32;
    let off = |v: u32| {
        let p = turn * mesh.point(v);
        field.value(&p) / field.gradient(&p).norm().max(0.2)
    };
    let off: Vec<f64> = (0..count).into_par_iter().map(off).collect();
    let share = 1.0 / f64::from(count.max(1));
    let mut far: Vec<f64> = off.iter().map(|d| d.abs()).collect();
    far.sort_by(f64::total_cmp);
    SurfaceErrors {
        mean_mm: far.iter().sum::<f64>() * share,
        outward_mm: off.iter().sum::<f64>() * share,
        p95_mm: far.get(far.len() * 19 / 20).copied().unwrap_or(f64::MAX),
    }
}
