//! Planes across thighs, and what of a thigh may be hidden where legs join low on the surface.

use crate::features::body::Body;
use crate::features::limb::{Limbs, Segment, limbs};
use crate::features::marks::hip;
use crate::geometry::halves::{half, webbed};
use crate::geometry::slices::Slice;
use crate::model::crotch::{Hidden, SIGMA, crotch};
use crate::planes::limbs::{Across, LEAST_UPRIGHT, Placed, holds_other, sure};
use crate::sections::across_leg::without_hand;
use nalgebra::{Point3, Vector3};
use shape::{BodyFeatures, Mesh, Plane, PlaneSigma, Refusal, Side};

/// A crotch lower than this share of stature is none: the thighs are one on the surface below it, by
/// nearly 0.1 of stature under the crotch that people have (0.481 ± 0.015 of 6068, ANSUR II).
const ONE: f64 = 0.385;
/// The thigh is looked for above this share of the crotch's height: knees are at 0.61 at most (tibial height, ANSUR
/// II).
const LOWEST_SHARE: f64 = 0.8;
/// So far below where the legs join, as a share of stature, the fold between them is no part of a thigh. By hand:
/// looked at 50 made bodies' thighs, 0.0145 of a leg's way: 0.012 on a grid of 0.0025 left out half a step more at
/// either end (docs/lab/girths.md).
const BELOW_JOIN: f64 = 0.0142;
/// A ring that is so many times as long as the one a hundredth of stature lower is two legs'. By hand: looked at three
/// scans, at 0.7 and 1.4 of it: 12 and 4 of 66 girths are refused.
const JUMP_FACTOR: f64 = 1.15;

/// A web begins a little lower than it shows, as a share of stature: a step of the search (structural: samples).
const CLEAR_OF_WEB: f64 = 0.0025;

/// Planes of a thigh and tapes in them, as far up as they are its own.
pub(crate) struct Shown {
    /// From low to high. \[mm\]
    found: Vec<(Plane, f64)>,
    fullest: (Plane, f64),
    /// How far above the ground legs join, or a web between them begins; none where they touch and folds part them. \[mm\]
    clear: Option<f64>,
}

impl Shown {
    /// Of a side.
    pub(crate) fn of(limbs: &Limbs<'_>, body: &Body, side: f64) -> Result<Shown, Refusal> {
        let join = body.legs_join.ok_or(Refusal::NoLegs)? - body.ground;
        match join < ONE * body.stature {
            true => touching(body, side),
            false => thigh(limbs, body, side),
        }
    }
}

/// A thigh where it is fullest below the crotch (ISO 8559-1 5.3.20): level, or square to a leg that leans.
fn thigh(limbs: &Limbs<'_>, body: &Body, side: f64) -> Result<Shown, Refusal> {
    let leg = limbs.leg(side)?;
    let down = -leg.axis(Segment::Thigh).ok_or(Refusal::NoLimb)?.along;
    let upright = -down.z > LEAST_UPRIGHT;
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
    let inward = body.left * side;
    let mut skin: Vec<f64> = Vec::new();
    let mut s = low;
    while s < end + 0.06 * body.stature {
        let Some((plane, ring)) = across.at(s) else {
            break;
        };
        // Upward, as long as the ring is one leg's: what takes in the other one jumps.
        let lower = ways.iter().rposition(|way| s - way > 3.5 * coarse);
        let jumps = |tape: f64| lower.is_some_and(|i| tape > JUMP_FACTOR * found[i].1);
        let hand = jumps(ring.tape) && holds_other(limbs, body, side, &ring) == Some(false);
        let free = hand
            .then(|| without_hand(body, &ring, side)?.ok())
            .flatten();
        let tape = free.map_or(ring.tape, |free| free.tape_mm);
        if jumps(tape) {
            if step < 0.1 * coarse {
                match hand {
                    true => return Err(Refusal::Hand),
                    false => break,
                }
            }
            step /= 2.0;
            s -= step;
            continue;
        }
        skin.push(webbed(&ring, &inward));
        found.push((plane, tape));
        ways.push(s);
        s += step;
    }
    let top = found.last().ok_or(Refusal::NoSection)?.0.point_mm[2] - body.ground;
    if top < ONE * body.stature && leg.bent == 0.0 {
        return touching(body, side);
    }
    // Beside a web a tape would go around it: below it only.
    let web = begins(&skin).filter(|_| upright);
    let ends = |i: usize| [ways[i.saturating_sub(1)], ways[i]];
    let web = web.map(|i| web_at(&across, &inward, ends(i), coarse));
    let web = web.unwrap_or(f64::MAX);
    let height = |p: &Plane| -down.dot(&Vector3::from(p.point_mm));
    let last = height(&found.last().ok_or(Refusal::NoSection)?.0) - BELOW_JOIN * body.stature;
    let highest = last.min(web - CLEAR_OF_WEB * body.stature);
    // Nor is a fault of the surface at one section a leg's.
    let whole = found.iter().zip(skin).filter(|(_, web)| *web < 1.0);
    let mut found: Vec<(Plane, f64)> = whole.map(|(f, _)| *f).collect();
    found.retain(|f| height(&f.0) <= highest);
    // The tape right there, for it may be the fullest.
    let below = found.last().ok_or(Refusal::NoSection)?.0;
    let up = -down * (highest - height(&below));
    let there = across.through(Point3::from(below.point_mm) + up);
    let there = there.filter(|(_, ring)| webbed(ring, &inward) < 1.0);
    found.extend(there.map(|(plane, ring)| (plane, ring.tape)));
    let among = |f: &&(Plane, f64)| f.0.point_mm[2] >= body.ground + LOWEST_SHARE * top;
    let fullest = *found
        .iter()
        .filter(among)
        .max_by(|a, b| a.1.total_cmp(&b.1))
        .ok_or(Refusal::NoSection)?;
    // The lower the legs part, or a web between them begins, the farther above may be what they hide.
    Ok(Shown {
        found,
        fullest,
        clear: Some(top.min(web - body.ground)),
    })
}

/// The first of sections that a web is beside, by how [`webbed`] each is. What shows at one alone is a fault of the surface, so
/// each counts as the middle one of three.
fn begins(skin: &[f64]) -> Option<usize> {
    let middle = |i: usize| {
        let near = [i.saturating_sub(1), i, (i + 1).min(skin.len() - 1)];
        let mut three = near.map(|k| skin[k]);
        three.sort_by(f64::total_cmp);
        three[1]
    };
    (0..skin.len()).find(|i| middle(*i) >= 1.0)
}

/// Height at which a web begins between two ways. \[mm\]
fn web_at(across: &Across<'_>, inward: &Vector3<f64>, ways: [f64; 2], coarse: f64) -> f64 {
    let [mut clear, mut not] = ways;
    while not - clear > 0.1 * coarse {
        let way = (clear + not) / 2.0;
        let found = across.at(way);
        match found.is_some_and(|(_, ring)| webbed(&ring, inward) < 1.0) {
            true => clear = way,
            false => not = way,
        }
    }
    across
        .at(not)
        .map_or(f64::MAX, |(plane, _)| plane.point_mm[2])
}

/// Thighs that are one on the surface, parted between their folds: where the half of a ring is last a leg's, below the crotch
/// that the buttocks suggest.
fn touching(body: &Body, side: f64) -> Result<Shown, Refusal> {
    let buttock = hip(body).ok_or(Refusal::ThighsOne)? - body.ground;
    let crotch = crotch(buttock / body.stature) - BELOW_JOIN;
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
    let fullest = *found.last().ok_or(Refusal::ThighsOne)?;
    Ok(Shown {
        clear: None,
        fullest,
        found,
    })
}

/// The fullest of a thigh's planes as far up as it is clear, how sure it is, and what may be hidden above it.
pub(crate) fn unseen(body: &Body, shown: &Shown) -> Result<(Placed, Option<Hidden>), Refusal> {
    let (seat, hip) = hip_tape(body).ok_or(Refusal::ThighsOne)?;
    let (plane, tape) = shown.fullest;
    let share = |mm: f64| mm / body.stature;
    let crotch = crotch(share(seat - body.ground));
    let hidden = shown
        .clear
        .map(|clear| Hidden::of(crotch, share(clear), ONE, tape / hip));
    // The fullest of what shows is read, and what is above is hidden; parted between folds, it ends at the expected crotch. A level plane
    // leans with no line of a leg.
    let line = sure(shown.clear.map_or(SIGMA * body.stature, |_| 0.0));
    let level = plane.normal[2].abs() == 1.0;
    let sigma = PlaneSigma {
        hidden_mm: hidden.map(|h| h.most * tape).filter(|mm| *mm > 0.0),
        tilt_rad: if level { Some(0.0) } else { line.tilt_rad },
        ..line
    };
    Ok(((plane, sigma), hidden.filter(|h| h.matters(tape))))
}

/// Where the hip is, and the tape around it. \[mm\]
fn hip_tape(body: &Body) -> Option<(f64, f64)> {
    let z = hip(body)?;
    Some((z, body.trunk(z)?.tape))
}

/// What a table of thighs has of one: how far its upper end is below the expected crotch, the hip's tape, its own where it is fullest, 0.02 below that
/// and 0.04 below; shares of stature.
pub fn thigh_seen(mesh: &Mesh, features: &BodyFeatures, side: Side) -> Option<[f64; 5]> {
    let body = Body::of(mesh, features.clone());
    let shown = Shown::of(&limbs(mesh, &body), &body, side.sign()).ok()?;
    let (seat, hip) = hip_tape(&body)?;
    let (plane, tape) = shown.fullest;
    let lower = |way: f64| {
        let z = plane.point_mm[2] - way * body.stature;
        let off = |f: &&(Plane, f64)| (f.0.point_mm[2] - z).abs();
        let near = shown
            .found
            .iter()
            .min_by(|a, b| off(a).total_cmp(&off(b)))?;
        (off(&near) < 0.0025 * body.stature).then_some(near.1)
    };
    let above = crotch((seat - body.ground) / body.stature) - shown.clear? / body.stature;
    let tapes = [hip, tape, lower(0.02)?, lower(0.04)?].map(|mm| mm / body.stature);
    Some([above, tapes[0], tapes[1], tapes[2], tapes[3]])
}

#[cfg(test)]
mod tests {
    use super::begins;

    #[test]
    fn what_shows_at_one_section_alone_is_no_web() {
        assert_eq!(begins(&[0.0, 0.1, 3.0, 0.0, 0.1]), None);
        assert_eq!(begins(&[0.0, 0.1, 3.0, 2.0, 0.0]), Some(2));
        assert_eq!(begins(&[]), None);
    }
}
