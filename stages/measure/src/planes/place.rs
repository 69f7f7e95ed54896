//! Landmarks of one body, part by part: a plane with how sure it is, or a typed reason.

use crate::features::body::Body;
use crate::features::limb::Limbs;
use crate::features::neck::neck_features;
use crate::model::law::Law;
use crate::model::level::Level;
use crate::planes::calf::calf;
use crate::planes::limbs::upper_arm;
use crate::planes::neck::{is_groove, plane_at, tilted};
use crate::planes::neck_level::neck_level;
use crate::planes::thigh::{Shown, unseen};
use crate::planes::trunk::{Placed, Trunk, hip_plane, longest_hip_plane, unlike};
use crate::planes::wanted::Waist;
use shape::{GirthId, Landmark, Landmarks, Mesh, Missing, Part, Plane, PlaneSigma, Refusal, Side};
use stage::{Message, message};

stage::messages! {
    NECK_UNLIKE = "warn-neck-unlike": "this neck is unlike those that its level was fitted on, so its interval is wider: is the head straight, and the neck bare?";
    THIGHS_LOW = "warn-thighs-low": "the legs join on the surface {far} below the crotch that stature and hip suggest, so the thighs are measured lower than they may be fullest, and their intervals reach up: place the feet farther apart";
}

/// Hip, waists and chest; the waist of the user's choice is called WC, the other definitions are
/// beside it under their own names.
pub(crate) fn trunk(
    chosen: Waist,
    body: &Body,
    reported: Option<&Trunk<'_>>,
    found: &mut Landmarks,
) {
    let at = |id: GirthId, placed: Placed| Landmark {
        sigma: placed.sigma,
        ..Landmark::new(id, placed.plane, Part::Trunk)
    };
    // The hip shows on its own, without head and neck.
    let sure = |t: &Trunk<'_>| (t.hip_sigma(), t.shown());
    let (sigma, shown) = reported.map(sure).unwrap_or_default();
    let hip = hip_plane(body).map(|plane| at(GirthId::Hip, Placed { plane, sigma }));
    let longest = longest_hip_plane(body).map(|plane| {
        let sigma = shown;
        at(GirthId::HipGreatest, Placed { plane, sigma })
    });
    let placed = |which: Waist| match which {
        Waist::Natural => reported?.at(Level::Waist),
        Waist::Narrowest => reported?.narrowest(),
        Waist::Navel => reported?.at(Level::Navel),
        Waist::HipBone => reported?.at(Level::HipBone),
    };
    let waist = placed(chosen).map(|p| at(GirthId::Waist, p).by(chosen.id()));
    let beside = [
        Waist::Natural,
        Waist::Narrowest,
        Waist::Navel,
        Waist::HipBone,
    ];
    let beside = beside.into_iter().filter(|which| *which != chosen);
    let beside = beside.filter_map(|which| Some(at(which.id(), placed(which)?)));
    let chest = reported.and_then(|t| t.at(Level::Chest));
    let chest = chest.map(|p| at(GirthId::Chest, p));
    let nowhere = reported.is_some_and(|t| t.narrowest().is_none());
    let asked_nowhere = nowhere && chosen == Waist::Narrowest;
    for (id, there) in [
        (GirthId::Hip, hip.is_some()),
        (GirthId::Waist, waist.is_some()),
        (GirthId::WaistNarrowest, !nowhere || asked_nowhere),
        (GirthId::Chest, chest.is_some()),
    ] {
        let reason = match id {
            GirthId::WaistNarrowest => Refusal::NoExtreme,
            GirthId::Waist if asked_nowhere => Refusal::NoExtreme,
            // Of a whole body: under a skirt.
            GirthId::Hip if body.whole => Refusal::NoLegs,
            _ => unlike(body),
        };
        found
            .missing
            .extend((!there).then(|| Missing::new(id, reason)));
    }
    found.found.extend(hip.into_iter().chain(longest));
    found
        .found
        .extend(waist.into_iter().chain(beside).chain(chest));
}

/// The neck, square to its axis; warns if it is a stranger to the law.
pub(crate) fn across_neck(
    lean_deg: f64,
    mesh: &Mesh,
    body: &Body,
    law: &Law,
    found: &mut Landmarks,
) -> Option<Message> {
    if !body.whole {
        // A body that is cut off: nothing tells that this is its neck.
        let missing = Missing::new(GirthId::Neck, unlike(body));
        found.missing.push(missing);
        return None;
    }
    let neck = neck_features(mesh, body).ok_or(Refusal::NoNeck);
    let placed = neck.and_then(|f| {
        // Outlines do not show the bottom of a groove.
        if body.carved && is_groove(&f) {
            return Err(Refusal::NeckGroove);
        }
        let level = neck_level(&f, law).ok_or(Refusal::NoNeck)?;
        let at = plane_at(&f, level.share)?;
        let at = tilted(&f, at, lean_deg.to_radians())?;
        // A plane that had to slide is as unsure as it slid far.
        let off = at.off.with(level.sigma) * f.diameter_mm();
        let sigma = PlaneSigma {
            level_mm: Some(off),
            tilt_rad: Some(level.tilt),
            repeat_mm: level.repeat.map(|r| r * f.diameter_mm()),
            hidden_mm: None,
        };
        let neck = Landmark::new(GirthId::Neck, at.plane, Part::Head);
        Ok((Landmark { sigma, ..neck }, level.inside))
    });
    match placed {
        Ok((neck, inside)) => {
            found.found.push(neck);
            (!inside).then(|| message!(NECK_UNLIKE))
        }
        Err(reason) => {
            found.missing.push(Missing::new(GirthId::Neck, reason));
            None
        }
    }
}

/// Adds a girth of a limb, or why it is not there.
fn limb(
    found: &mut Landmarks,
    id: GirthId,
    part: Part,
    placed: Result<(Plane, PlaneSigma), Refusal>,
) {
    match placed {
        Ok((plane, sigma)) => found.found.push(Landmark {
            sigma,
            ..Landmark::new(id, plane, part)
        }),
        Err(reason) => found.missing.push(Missing::new(id, reason)),
    }
}

/// Both upper arms.
pub(crate) fn arms(limbs: &Limbs<'_>, body: &Body, found: &mut Landmarks) {
    for side in Side::BOTH {
        let id = GirthId::UpperArm(side);
        // Shares of a stature that is none tell nothing.
        let placed = match body.whole {
            false => Err(unlike(body)),
            true => upper_arm(limbs, side.sign()),
        };
        limb(found, id, Part::arm(side), placed);
    }
}

/// Thigh and calf of both legs; a warning if so much of a thigh's upper end may be hidden that it matters.
pub(crate) fn legs(limbs: &Limbs<'_>, body: &Body, found: &mut Landmarks) -> Option<Message> {
    let mut hidden = 0.0f64;
    for side in Side::BOTH {
        let (part, sign) = (Part::leg(side), side.sign());
        let mut parted = || {
            let (placed, above) = unseen(body, &Shown::of(limbs, body, sign)?)?;
            if let Some(above) = above {
                hidden = hidden.max(above.above * body.stature);
            }
            Ok(placed)
        };
        let [thigh, calf] = match body.whole {
            false => [Err(unlike(body)), Err(unlike(body))],
            true => [parted(), calf(limbs, body, sign)],
        };
        limb(found, GirthId::Thigh(side), part, thigh);
        limb(found, GirthId::Calf(side), part, calf);
    }
    (hidden > 0.0).then(|| message!(THIGHS_LOW, far = found.unit.field(hidden)))
}
