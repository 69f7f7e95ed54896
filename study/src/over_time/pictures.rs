//! The first body coloured by what grew and shrank, from the front and from behind.

use super::series::Visit;
use crate::compare::render::render;
use base64::prelude::{BASE64_STANDARD, Engine as _};
use nalgebra::Point3;
use shape::{Camera, Intrinsics, Mesh, Rgb, rgb_to_jpeg};

/// Size of a picture, and how far away the camera is, as a share of the stature.
const WIDE: u32 = 320;
const HIGH: u32 = 520;
const FAR: f64 = 3.2;
/// Distance at which a vertex is coloured fully. \[mm\]
pub(super) const FULL_MM: f64 = 10.0;

/// A camera before the body (1) or behind it (−1).
fn camera(visit: &Visit, sign: f64) -> Camera {
    let body = &visit.body;
    let middle = visit
        .mesh
        .bounds()
        .map_or(Point3::origin(), |(a, b)| nalgebra::center(&a, &b));
    let eye = middle + body.front * (sign * FAR * body.stature);
    let lens = Intrinsics::simple(WIDE, HIGH, 0.9 * f64::from(HIGH) * FAR);
    Camera::looking(lens, eye, middle)
}

/// Blue where it shrank, orange where it grew.
pub(super) fn color(mm: f64) -> [f32; 3] {
    let share = (mm / FULL_MM).clamp(-1.0, 1.0) as f32;
    let full = if share < 0.0 {
        [0.10, 0.35, 0.85]
    } else {
        [0.88, 0.35, 0.05]
    };
    [0, 1, 2].map(|i| 0.93 + (full[i] - 0.93) * share.abs())
}

/// Front and back side by side, as a data URI.
pub(super) fn picture(visit: &Visit, growth: &[f64]) -> String {
    let sides =
        [1.0, -1.0].map(|sign| render(&visit.mesh, &camera(visit, sign), &|v| color(growth[v])));
    let mut both = Rgb::filled(2 * WIDE as usize, HIGH as usize, [0; 3]);
    for (i, side) in sides.iter().enumerate() {
        for y in 0..side.height {
            for x in 0..side.width {
                *both.at_mut(x + i * WIDE as usize, y) = side.at(x, y);
            }
        }
    }
    format!(
        "data:image/jpeg;base64,{}",
        BASE64_STANDARD.encode(rgb_to_jpeg(&both, 82))
    )
}

/// The first surface with what grew and shrank as the colours of its vertices.
pub(super) fn colored(mesh: &Mesh, growth: &[f64]) -> Mesh {
    let level = |x: f32| (x * 255.0).round() as u8;
    Mesh {
        colors: growth.iter().map(|mm| color(*mm).map(level)).collect(),
        ..mesh.clone()
    }
}
