//! How brightness pulls a point of the surface about in each photo that shows it: each photo compared
//! with the mean of the other photos.

use crate::evidence::look::{Look, dot};
use crate::evidence::patch::{Frame, MOST_POINTS, VisibleView, Window};
use crate::evidence::scene::Scene;
use crate::evidence::visibility::Visibility;
use crate::geometry::curvature::tangents;
use nalgebra::{Point3, Vector3};

/// A point that a photo shows elsewhere than where it is.
#[derive(Debug, Clone, Copy)]
pub struct PointShift {
    /// The photo's picture.
    pub picture: u16,
    /// The point. \[mm\]
    pub x: Point3<f64>,
    /// Across the line of sight, of unit length.
    pub direction: Vector3<f64>,
    /// How far along the direction the photo shows it. \[mm\]
    pub gap: f64,
    /// How sure that is. \[1/mm²\]
    pub stiffness: f64,
}

/// What photos show of one vertex.
#[derive(Debug, Clone, Default)]
pub struct VertexShifts {
    /// Two a photo at most, in order.
    pub shifts: Vec<PointShift>,
    /// The pictures whose mean each of these is compared with, without itself, and their weights.
    pub seen: Vec<(u16, f64)>,
}

/// The equations at each vertex of a surface.
pub fn point_shifts(scene: &Scene<'_>, footprint: f64) -> Vec<VertexShifts> {
    let (_, shifts) = Visibility::with(
        scene,
        |_| None,
        |_, view| across(view),
        #[inline(always)]
        |frame, seen, looks| normal_equations_at(frame, seen, looks, scene.window, footprint),
    );
    shifts
}

/// Two directions across a line of sight.
fn across(view: &VisibleView) -> [Vector3<f64>; 2] {
    tangents(&Vector3::from(view.toward.map(f64::from)))
}

/// All equations at a vertex, from a look of each picture that sees it with slopes [`across`] its line of sight.
#[inline(always)]
fn normal_equations_at(
    frame: &Frame,
    seen: &[VisibleView],
    looks: &[Look<2>],
    window: &Window,
    footprint: f64,
) -> VertexShifts {
    let count = window.len();
    let mut equations = VertexShifts::default();
    if seen.len() < 2 {
        return equations;
    }
    let weights = seen.iter().map(|v| (v.picture, f64::from(v.weight)));
    equations.seen.extend(weights);
    for (i, view) in seen.iter().enumerate() {
        let mut rest_mean = [0.0f32; MOST_POINTS];
        let mut weight = 0.0;
        for (j, other) in seen.iter().enumerate().filter(|(j, _)| *j != i) {
            let w = other.weight;
            (0..count).for_each(|k| rest_mean[k] += w * looks[j].z[k]);
            weight += w;
        }
        let norm = dot(&rest_mean[..count], &rest_mean[..count]).sqrt();
        if norm <= 0.0 || weight <= 0.0 {
            continue;
        }
        rest_mean[..count].iter_mut().for_each(|o| *o /= norm);
        let (look, [u, v]) = (&looks[i], across(view));
        let agree = dot(&rest_mean[..count], &look.z[..count]);
        if agree < 0.3 {
            continue;
        }
        let slope = |k: usize| &look.slopes[k][..count];
        let mut wanted = rest_mean;
        (0..count).for_each(|k| wanted[k] -= agree * look.z[k]);
        let wanted = &wanted[..count];
        // Two directions across the line of sight, made independent of each other.
        let (a, b, ab) = (
            dot(slope(0), slope(0)),
            dot(slope(1), slope(1)),
            dot(slope(0), slope(1)),
        );
        let (ra, rb) = (dot(slope(0), wanted), dot(slope(1), wanted));
        let (values, vectors) = eigen(f64::from(a), f64::from(ab), f64::from(b));
        for k in 0..2 {
            if values[k] < 1e-9 {
                continue;
            }
            let pull = vectors[k][0] * f64::from(ra) + vectors[k][1] * f64::from(rb);
            // Agreement at a shift d of the photo is agree + pull d − agree values d² / 2.
            let gap = pull / (values[k] * f64::from(agree));
            // A shift of many pixels is more than this look can show.
            let sure = (2.0 * footprint / gap.abs().max(1e-9)).min(1.0);
            equations.shifts.push(PointShift {
                picture: view.picture,
                x: frame.x,
                direction: u * vectors[k][0] + v * vectors[k][1],
                gap,
                stiffness: values[k] * f64::from(view.weight * weight * agree * agree) * sure,
            });
        }
    }
    equations
}

/// Eigenvalues and unit eigenvectors of a symmetric 2 × 2 matrix.
fn eigen(a: f64, b: f64, c: f64) -> ([f64; 2], [[f64; 2]; 2]) {
    let (mean, half) = ((a + c) / 2.0, (a - c) / 2.0);
    let far = libm::hypot(half, b);
    let angle = 0.5 * libm::atan2(b, half);
    let (sin, cos) = libm::sincos(angle);
    ([mean + far, mean - far], [[cos, sin], [-sin, cos]])
}
