//! Planes across arms and legs, from their own lines and joints.

use crate::features::body::Body;
use crate::features::extent::extent;
use crate::features::limb::follow::Knot;
use crate::features::limb::{Limb, Limbs, Segment};
use crate::features::marks::hip;
use crate::geometry::halves::{half, webbed};
use crate::geometry::slices::{Ring, Slice};
use crate::model::crotch::{Hidden, crotch};
use nalgebra::Vector3;
use shape::{Mesh, Part, Plane, PlaneSigma, Refusal};

/// A plane and how sure it is.
pub(crate) type Placed = (Plane, PlaneSigma);

/// How sure the line of a segment is. \[rad\]
const TILT: f64 = 2.5 * std::f64::consts::PI / 180.0;
/// A leg that leans less is taken level, as the standard has it. \[cos\]
const UPRIGHT: f64 = 0.966;
/// A crotch lower than this share of stature is none: the thighs are one on the surface below it, by
/// nearly 0.1 of stature under the crotch that people have (0.481 ± 0.015 of 6068, ANSUR II).
pub(crate) const ONE: f64 = 0.385;
/// The thigh is looked for above this share of the crotch's height.
const THIGH: f64 = 0.8;
/// So far below where the legs join, as a share of stature, the fold between them is no part of a thigh.
/// 0.012 on a grid of 0.0025 left out half a step more at either end, in the mean; twelve stances were looked at (docs/lab/girths.md).
const BELOW: f64 = 0.0145;
/// An upper arm shows at least so much of itself above the elbow, as a share of stature.
const CLEAR: f64 = 0.025;
/// A girth that grows by no more than this up to the knee has stopped growing; one that falls by half as much has narrowed.
const FLAT: f64 = 1.01;
/// How sure the level of a greatest girth is, as a share of stature: fitted on thighs and calves of the first fifty bodies of
/// `models/made/strangers.py`, of whose intervals nine in ten then contain the truth.
const EXTREME: f64 = 0.0033;

fn sure(level: f64) -> PlaneSigma {
    PlaneSigma {
        level_mm: Some(level),
        tilt_rad: Some(TILT),
        ..PlaneSigma::default()
    }
}

/// Square to a segment's line at a share of the way from its joint near the trunk (0) to the other (1),
/// and how sure its place is.
///
/// # Errors
///
/// If the limb has no such segment, or its line is not known.
pub fn share(limb: &Limb, segment: Segment, share: f64) -> Result<Placed, Refusal> {
    let (plane, sigma) = limb.at_share(segment, share).ok_or(Refusal::NoLimb)?;
    Ok((plane, sure(sigma)))
}

/// Across an upper arm midway between acromion and elbow (ISO 8559-1 5.3.16), centred on the arm's own ring where
/// the surface shows one.
pub(crate) fn upper_arm(limbs: &Limbs<'_>, stature: f64, side: f64) -> Result<Placed, Refusal> {
    let arm = limbs.arm(side)?;
    if arm.clear_to() < arm.middle.s + CLEAR * stature {
        return Err(Refusal::Fused);
    }
    let (plane, middle) = arm.mid_upper_arm().ok_or(Refusal::NoLimb)?;
    let sigma = PlaneSigma {
        repeat_mm: middle.again,
        ..sure(middle.sigma)
    };
    Ok((plane, sigma))
}

/// A ring of one leg, level or square to its line, and the plane it is in.
struct Across<'a> {
    limbs: &'a Limbs<'a>,
    leg: &'a Limb,
    /// Normal of the planes, downward.
    down: Vector3<f64>,
    within: f64,
}

impl<'a> Across<'a> {
    fn new(limbs: &'a Limbs<'a>, leg: &'a Limb, down: Vector3<f64>, stature: f64) -> Self {
        Across {
            limbs,
            leg,
            down,
            within: 0.2 * stature,
        }
    }

    /// At a place of the leg's line.
    fn at(&self, s: f64) -> Option<(Plane, Ring)> {
        let plane = Plane {
            point_mm: self.leg.point(s).into(),
            normal: self.down.into(),
        };
        let ring = self.limbs.cuts.ring(&plane, self.within, 0.0)?;
        let mut plane = plane;
        plane.point_mm = ring.centre.into();
        Some((plane, ring))
    }
}

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
    let longer = hidden.filter(Hidden::by_a_web).map(|h| {
        let way = h.above * body.stature;
        growth(&found, fullest, way) * way
    });
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
    let hidden = Hidden::of(buttock / body.stature, clear / body.stature);
    let sigma = libm::hypot(EXTREME, hidden.rms) * body.stature;
    let growth = growth(found, fullest, hidden.above * body.stature);
    let matters = hidden.matters(body.stature, growth);
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

/// Whether a ring reaches the line of the other leg. `None` if that is not known.
fn holds_other(limbs: &Limbs<'_>, body: &Body, side: f64, ring: &Ring) -> Option<bool> {
    let left = body.left * side;
    let (other, (inner, _)) = (limbs.leg(-side).ok()?, extent(ring, &left)?);
    let off = |k: &&Knot| (k.centre.z - ring.centre.z).abs();
    let near = other.knots.iter().min_by(|a, b| off(a).total_cmp(&off(b)));
    Some(near.is_none_or(|k| inner < k.centre.coords.dot(&left)))
}

/// A ring that is so many times as long as the one a hundredth of stature lower is two legs'.
const JUMP: f64 = 1.15;

/// A calf where it is greatest between ankle and knee (ISO 8559-1 5.3.24), square to the shank: a greatest of its own, not
/// the end of what is looked at, so that neither the knee nor a hem above it is taken.
pub(crate) fn calf(limbs: &Limbs<'_>, body: &Body, side: f64) -> Result<Placed, Refusal> {
    let leg = limbs.leg(side)?;
    let down = -leg.axis(Segment::Shank).ok_or(Refusal::NoLimb)?.along;
    let across = Across::new(limbs, leg, down, body.stature);
    /// Steps to either side that are near.
    const NEAR: usize = 6;
    let (ankle, knee) = (leg.end.s, leg.middle.s);
    let step = 0.0025 * body.stature;
    let (low, high) = (
        ankle + 0.3 * (knee - ankle),
        (knee - 0.02 * body.stature).min(leg.clear_to()),
    );
    let count = ((high - low) / step).max(0.0) as usize;
    // Up to where both legs are one on the surface.
    let own = |(_, ring): &(Plane, Ring)| holds_other(limbs, body, side, ring) != Some(true);
    let found: Vec<(Plane, f64)> = (0..count + NEAR)
        .filter_map(|i| across.at(low + step * i as f64))
        .take_while(own)
        .map(|(plane, ring)| (plane, ring.tape))
        .collect();
    let most = |i: usize| found[i..=i + NEAR].iter().map(|f| f.1).fold(0.0, f64::max);
    let inner = NEAR..found.len().saturating_sub(NEAR);
    // Between a calf and what is larger above it, the shank narrows.
    let narrows = |i: usize| {
        let (own, above) = (found[i].1, &found[i..]);
        let larger = above.iter().position(|f| f.1 > own);
        let least = |k: usize| above[..k].iter().map(|f| f.1).fold(own, f64::min);
        larger.is_none_or(|k| (1.0 + FLAT) / 2.0 * least(k) <= own)
    };
    // Greatest of those that nothing near exceeds, to either side.
    let peak = inner
        .clone()
        .filter(|i| most(*i - NEAR).max(most(*i)) <= found[*i].1 && narrows(*i))
        .max_by(|a, b| found[*a].1.total_cmp(&found[*b].1));
    if let Some(peak) = peak {
        return Ok((found[peak].0, sure(EXTREME * body.stature)));
    }
    // A leg that hardly narrows below its knee: where it stops growing for good.
    let above = |i: usize| found[i..].iter().map(|f| f.1).fold(0.0, f64::max);
    let flat = inner.into_iter().find(|i| above(*i) <= FLAT * found[*i].1);
    let at = flat.ok_or(Refusal::NoPeak)?;
    Ok((found[at].0, sure(2.0 * EXTREME * body.stature)))
}

/// The part of each vertex: limbs by their own land, head above the neck; the rest is trunk.
pub fn parts(mesh: &Mesh, body: &Body, limbs: &Limbs<'_>) -> Vec<u8> {
    let neck = body.neck.unwrap_or(f64::MAX);
    let part = |v: usize| match limbs.parts[v] {
        Some(part) => part,
        None if f64::from(mesh.positions[v][2]) > neck => Part::Head,
        None => Part::Trunk,
    };
    (0..mesh.positions.len()).map(|v| part(v) as u8).collect()
}
