//! Whether a surface is a body that stands upright on two legs of its own: lying, sitting, upside down
//! and under a coat, levels mean nothing.

use crate::features::body::{Body, body};
use crate::features::flat::flat_share;
use crate::geometry::slices::Slice;
use nalgebra::{Point3, Vector3};
use shape::{Mesh, Refusal};

/// A body that stands is higher than so many times its greatest reach across: arms spread wide reach 1.1
/// of the stature.
const TALL: f64 = 0.8;
/// How far the trunk's middle is from that of the shins at most, seen from above, as a share of stature:
/// thighs of one who sits are 0.3 long.
const OVER: f64 = 0.12;
/// How many times as large a trunk is just above the crotch as both thighs just below; at a hem a coat
/// or skirt is more.
const HEM: f64 = 1.7;

/// A share of the surface in one plane from which on it is cut through: of six scans at most 0.026, of halves of two of them, cut
/// lengthwise and covered, at least 0.16 (2026).
const CUT: f64 = 0.08;

/// Why a body is none that stands: a reason. `None` for one that does.
pub(crate) fn unfit(mesh: &Mesh, body: &Body) -> Option<Refusal> {
    let upside_down = || (body.crotch.is_none() || body.neck.is_none()) && stands_on_its_head(mesh);
    if many_legs(body) {
        return Some(Refusal::ManyLegs);
    }
    if flat_share(mesh) > CUT {
        return Some(Refusal::CutThrough);
    }
    if lies(mesh, body.stature) || sits(body) || upside_down() {
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
fn lies(mesh: &Mesh, stature: f64) -> bool {
    let across = |k: u32| {
        let (s, c) = libm::sincos(f64::from(k) * std::f64::consts::PI / 12.0);
        let reach = mesh
            .positions
            .iter()
            .map(|p| c * f64::from(p[0]) + s * f64::from(p[1]));
        let (low, high) = reach.fold((f64::MAX, f64::MIN), |e, x| (e.0.min(x), e.1.max(x)));
        high - low
    };
    stature < TALL * (0..12).map(across).fold(0.0, f64::max)
}

/// Whether a body shows legs and a neck the other way up.
fn stands_on_its_head(mesh: &Mesh) -> bool {
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

/// Whether the trunk is not above the legs: it sits, or bends far over.
fn sits(body: &Body) -> bool {
    let Some(crotch) = body.crotch else {
        return false;
    };
    let inside = crotch - body.ground;
    let middle = |low: f64, high: f64, rings: usize| {
        let (mut sum, mut count) = (Vector3::zeros(), 0.0);
        for slice in body.between(low, high) {
            for ring in slice.rings.iter().take(rings) {
                sum += ring.centre.coords;
                count += 1.0;
            }
        }
        (count > 0.0).then(|| Point3::from(sum / count))
    };
    let shins = middle(body.ground + 0.3 * inside, body.ground + 0.6 * inside, 2);
    let trunk = middle(crotch + 0.1 * body.stature, crotch + 0.25 * body.stature, 1);
    let off = shins.zip(trunk).map(|(a, b)| (b - a).xy().norm());
    off.is_some_and(|off| off > OVER * body.stature)
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
    legs > 0.0 && trunk > HEM * legs
}
