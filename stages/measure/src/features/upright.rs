//! Whether a surface is a body that is upright on two legs of its own: lying, sitting, upside down
//! and under a coat, levels mean nothing.

use crate::features::body::{Body, body};
use crate::features::flat::flat_share;
use crate::geometry::slices::Slice;
use nalgebra::{Matrix3, Vector3};
use shape::{Mesh, Refusal};

/// An upright body is higher than so many times its greatest reach across: of 6 068 people with arms spread wide the
/// least is 0.869 times the span (ANSUR II).
const LEAST_TALLNESS: f64 = 0.8;
/// How far the long axis of an upright body leans at most. \[rad\] Of six scans, fifty made bodies and twelve stances 0.075 at
/// most (2026), of one who sits 0.56.
const LEAN: f64 = 0.17;
/// How many times as large a trunk is just above the crotch as both thighs just below; at a hem a coat or skirt is
/// more. Of 6 068 people circles by hip and thigh come to 1.35, to more than this of 4 (ANSUR II).
const HEM_FACTOR: f64 = 1.7;

/// A share of the surface in one plane from which on it is cut through: of six scans at most 0.026, of halves of two of them, cut
/// lengthwise and covered, at least 0.16 (2026).
const CUT: f64 = 0.08;

/// Why a body is not upright: a reason. `None` for one that is.
pub(crate) fn unfit(mesh: &Mesh, body: &Body) -> Option<Refusal> {
    let upside_down = || (body.crotch.is_none() || body.neck.is_none()) && is_upside_down(mesh);
    let leans = || body.crotch.is_some() && lean(mesh) > LEAN;
    if many_legs(body) {
        return Some(Refusal::ManyLegs);
    }
    if flat_share(mesh) > CUT {
        return Some(Refusal::CutThrough);
    }
    if is_lying(mesh, body.stature) || leans() || upside_down() {
        return Some(Refusal::NotUpright);
    }
    hem(body).then_some(Refusal::NoLegs)
}

/// Heights of shins, as shares of stature (structural: above ankles, below what hands reach).
const SHINS: (f64, f64) = (0.12, 0.3);

/// Whether more than two rings of like size are there where a body has its shins.
fn many_legs(body: &Body) -> bool {
    let many = |s: &&Slice| s.rings.len() > 2 && s.rings[2].area > 0.4 * s.rings[0].area;
    let (shins, all) = (body.shares(SHINS), body.shares(SHINS).count());
    2 * shins.filter(many).count() > all
}

/// Whether a surface reaches farther across than up.
fn is_lying(mesh: &Mesh, stature: f64) -> bool {
    let across = |k: u32| {
        let (s, c) = libm::sincos(f64::from(k) * std::f64::consts::PI / 12.0);
        let reach = mesh
            .positions
            .iter()
            .map(|p| c * f64::from(p[0]) + s * f64::from(p[1]));
        let (low, high) = reach.fold((f64::MAX, f64::MIN), |e, x| (e.0.min(x), e.1.max(x)));
        high - low
    };
    stature < LEAST_TALLNESS * (0..12).map(across).fold(0.0, f64::max)
}

/// Whether a body shows legs and a neck the other way up.
fn is_upside_down(mesh: &Mesh) -> bool {
    let turned = Mesh {
        positions: mesh
            .positions
            .iter()
            .map(|p| [p[0], -p[1], -p[2]])
            .collect(),
        ..mesh.clone()
    };
    let lowest = turned.bounds().map(|b| b.0.z);
    let other = lowest.and_then(|low| body(&turned, low));
    other.is_some_and(|b| b.crotch.is_some() && b.neck.is_some())
}

/// How far the long axis of what a surface encloses is from the vertical: it leans, sits or bends far over. \[rad\]
fn lean(mesh: &Mesh) -> f64 {
    let Some((low, high)) = mesh.bounds() else {
        return 0.0;
    };
    let (mut volume, mut first, mut second) = (0.0, Vector3::zeros(), Matrix3::zeros());
    for f in 0..mesh.faces.len() {
        let [a, b, c] = mesh.triangle(f).map(|p| p - (low + (high - low) / 2.0));
        let (six, sum) = (a.dot(&b.cross(&c)), a + b + c);
        volume += six;
        first += sum * (six / 4.0);
        let corners = a * a.transpose() + b * b.transpose() + c * c.transpose();
        second += (corners + sum * sum.transpose()) * (six / 20.0);
    }
    let middle = first / volume;
    let spread = second / volume - middle * middle.transpose();
    let eigen = spread.symmetric_eigen();
    let long = eigen.eigenvectors.column(eigen.eigenvalues.imax());
    libm::acos(long.z.abs().min(1.0))
}

/// Whether what joins the legs is a hem: the section jumps to a coat's or a skirt's.
fn hem(body: &Body) -> bool {
    let Some(crotch) = body.crotch else {
        return false;
    };
    let near = 0.015 * body.stature;
    let area = |s: &Slice, rings: usize| s.rings.iter().take(rings).map(|r| r.area).sum::<f64>();
    let legs = body.between(crotch - near, crotch).map(|s| area(s, 2));
    let above = body.between(crotch + 1e-3, crotch + near);
    let trunk = above.map(|s| area(s, 1)).fold(0.0, f64::max);
    let legs = legs.fold(0.0, f64::max);
    legs > 0.0 && trunk > HEM_FACTOR * legs
}
