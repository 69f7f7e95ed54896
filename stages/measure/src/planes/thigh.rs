//! Planes across thighs, and what of a thigh may be hidden where legs join low on the surface.

use crate::features::body::Body;
use crate::features::limb::{Limbs, Segment};
use crate::features::marks::hip;
use crate::geometry::halves::{half, webbed};
use crate::geometry::slices::Slice;
use crate::model::crotch::{Hidden, crotch};
use crate::planes::limbs::{Across, EXTREME, Placed, UPRIGHT, holds_other, sure};
use nalgebra::Vector3;
use shape::{Plane, PlaneSigma, Refusal};

/// A crotch lower than this share of stature is none: the thighs are one on the surface below it, by
/// nearly 0.1 of stature under the crotch that people have (0.481 ± 0.015 of 6068, ANSUR II).
pub(crate) const ONE: f64 = 0.385;
/// The thigh is looked for above this share of the crotch's height.
const THIGH: f64 = 0.8;
/// So far below where the legs join, as a share of stature, the fold between them is no part of a thigh.
/// 0.012 on a grid of 0.0025 left out half a step more at either end, in the mean; twelve stances were looked at (docs/lab/girths.md).
const BELOW: f64 = 0.0145;
/// A ring that is so many times as long as the one a hundredth of stature lower is two legs'.
const JUMP: f64 = 1.15;

/// A web begins a little lower than it shows, as a share of stature.
const CLEAR_OF_WEB: f64 = 0.0025;
/// A thigh where it is fullest below the crotch (ISO 8559-1 5.3.20): level, or square to a leg that leans; and what of it
/// may be hidden, if that is more than a survey allows.
pub(crate) fn thigh(
    limbs: &Limbs<'_>,
    body: &Body,
    side: f64,
) -> Result<(Placed, Option<Hidden>), Refusal> {
    let leg = limbs.leg(side)?;
    let down = -leg.axis(Segment::Thigh).ok_or(Refusal::NoLimb)?.along;
    let upright = -down.z > UPRIGHT;
    let down = if upright { -Vector3::z() } else { down };
    let across = Across::new(limbs, leg, down, body.stature);
    let (knee, end) = (leg.middle.s, leg.clear_to());
    let low = knee + 0.45 * (leg.crotch - knee);
    // What counts as one leg's ends between two steps, and the fullest place may be right below it: the last step is halved until
    // neither hangs on where the first one was.
    let coarse = 0.0025 * body.stature;
    let mut step = coarse;
    let mut found: Vec<(Plane, f64)> = Vec::new();
    let mut ways: Vec<f64> = Vec::new();
    // Beside a web between the thighs a tape would go around it: below it only.
    let mut web = f64::MAX;
    let mut s = low;
    while s < end + 0.06 * body.stature {
        let Some((plane, ring)) = across.at(s) else {
            break;
        };
        // Upward, as long as the ring is one leg's: what takes in the other one jumps.
        let lower = ways.iter().rposition(|way| s - way > 3.5 * coarse);
        if lower.is_some_and(|i| ring.tape > JUMP * found[i].1) {
            if step < 0.1 * coarse {
                match holds_other(limbs, body, side, &ring) {
                    Some(false) => return Err(Refusal::Hand),
                    _ => break,
                }
            }
            step /= 2.0;
            s -= step;
            continue;
        }
        if upright && webbed(&ring, &(body.left * side)) {
            web = web.min(plane.point_mm[2]);
        }
        found.push((plane, ring.tape));
        ways.push(s);
        s += step;
    }
    let top = found.last().ok_or(Refusal::NoSection)?.0.point_mm[2] - body.ground;
    if top < ONE * body.stature && leg.bent == 0.0 {
        return touching(body, side);
    }
    let highest = ways.last().ok_or(Refusal::NoSection)? - BELOW * body.stature;
    if let Some((plane, ring)) = across.at(highest) {
        found.push((plane, ring.tape));
        ways.push(highest);
    }
    let among = |f: &&(Plane, f64), way: f64| {
        let z = f.0.point_mm[2];
        way <= highest && z >= body.ground + THIGH * top && z < web - CLEAR_OF_WEB * body.stature
    };
    let fullest = found
        .iter()
        .zip(&ways)
        .filter(|(f, way)| among(f, **way))
        .map(|(f, _)| f)
        .max_by(|a, b| a.1.total_cmp(&b.1))
        .ok_or(Refusal::NoSection)?;
    // The lower the legs part, or a web between them begins, the farther above may be what they hide.
    let ((plane, sigma), hidden) = unseen(body, &found, fullest, top.min(web - body.ground))?;
    let by_a_web = hidden.filter(Hidden::by_a_web);
    let longer = by_a_web.map(|h| h.growth * (h.above * body.stature));
    let sigma = PlaneSigma {
        hidden_mm: longer,
        ..sigma
    };
    Ok(((plane, sigma), hidden))
}

/// Thighs that are one on the surface, parted between their folds: where the half of a ring is last a leg's, below the crotch
/// that the buttocks suggest.
pub(crate) fn touching(body: &Body, side: f64) -> Result<(Placed, Option<Hidden>), Refusal> {
    let buttock = hip(body).ok_or(Refusal::ThighsOne)? - body.ground;
    let crotch = crotch(buttock / body.stature) - BELOW;
    let both = |slice: &Slice| {
        let ring = slice.rings.first()?;
        let plane = Plane {
            point_mm: ring.centre.into(),
            normal: (-Vector3::z()).into(),
        };
        let one = |side: f64| Some(half(&ring.curve, &plane, &(body.left * side))?.tape);
        one(-side).and(one(side)).map(|tape| (plane, tape))
    };
    let found: Vec<(Plane, f64)> = body.shares((ONE, crotch)).filter_map(both).collect();
    let highest = found.last().ok_or(Refusal::ThighsOne)?;
    unseen(body, &found, highest, highest.0.point_mm[2] - body.ground)
}

/// The fullest of a thigh's planes as far up as it is clear, how sure it is, and what is hidden above it. \[mm\]
fn unseen(
    body: &Body,
    found: &[(Plane, f64)],
    fullest: &(Plane, f64),
    clear: f64,
) -> Result<(Placed, Option<Hidden>), Refusal> {
    let buttock = hip(body).ok_or(Refusal::ThighsOne)? - body.ground;
    let growth = |above: f64| growth(found, fullest, above * body.stature);
    let hidden = Hidden::of(buttock / body.stature, clear / body.stature, growth);
    let sigma = libm::hypot(EXTREME, hidden.rms) * body.stature;
    let matters = hidden.matters(body.stature);
    Ok(((fullest.0, sure(sigma)), matters.then_some(hidden)))
}

/// How much a tape grows upward over so long a way up to its fullest place. \[mm a mm\]
fn growth(tapes: &[(Plane, f64)], fullest: &(Plane, f64), way: f64) -> f64 {
    let down = |f: &(Plane, f64)| fullest.0.point_mm[2] - f.0.point_mm[2];
    let off = |f: &(Plane, f64)| (down(f) - way).abs();
    let lower = tapes.iter().min_by(|a, b| off(a).total_cmp(&off(b)));
    let lower = lower.filter(|f| down(f) > 0.0);
    lower.map_or(0.0, |f| (fullest.1 - f.1) / down(f))
}
