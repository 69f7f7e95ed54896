//! Why a body was refused: what photos and facts tell of the cause, where the surface alone shows only that legs or feet are missing.

use shape::{
    BodyPart, CONTRADICTION, Cameras, GIVEN_STATURE, Girths, Length, LostParts, Masks, Mesh,
    PhotoId, Refusal, Rig, Scale, Unit, coherence,
};
use stage::{Field, Message, Template, message};

stage::messages! {
    AND_MORE = "photos-and-more": "{names} and {count} more";
    EMPTY_PHOTOS = "warn-empty-photos": "next to no subject is seen on {names}: leave such photos out, or correct their masks";
    MOSTLY_LOST = "warn-mostly-lost": "{count} of {of} masks leave out a part of the body that this needs: correct these masks, or take a photo of the empty scene as the plate";
    OUTLINE_CUTS = "warn-outline-cuts": "the outline on {names} cuts away up to {share:.0 %} of what nearly all other photos show as body: look at this mask; correct it, or leave the photo out";
    APART = "warn-hangs-apart": "the surface holds {share:.0 %} of what all outlines show as body, the rest hangs apart from it and was left out: look where the masks cut the body through";
    SHORT = "warn-short": "the surface is {height:.0 cm} high, the stature was given as {stature:.0 cm}: {missing:.0 %} of the height are missing; look whether the masks have legs and head";
    LIGHT = "warn-light": "the surface holds {holds:.1 l}, a body of {weight:.1 kg} fills about {fills:.1 l}: {missing:.0 %} of the volume are missing; look at the masks, and check scale and weight";
    SURFACE_UNIT = "length-surface-unit": "the unit of the surface";
}

/// A photo whose outline has less than this share of the usual area shows no subject.
/// By hand: looked at three scans and five captures, at 0.7 and 1.4 of it: nothing changes.
const EMPTY_SHARE: f64 = 0.05;
/// A surface with less than this share of what all outlines share has lost a part of the body.
/// By hand: looked at three scans and five captures, at 0.7 and 1.4 of it: nothing changes.
const LEAST_KEPT_SHARE: f64 = 0.7;
/// Density of a body with air in its lungs: it hardly floats (structural: that of water; by how much people differ is
/// in [`LACKING_SHARE`]). \[kg/l\]
const DENSITY_KG_L: f64 = 1.0;
/// Share of a body's volume that density, clothes and scales do not explain.
/// By hand: looked at three scans and five captures, at 0.7 and 1.4 of it: nothing changes.
const LACKING_SHARE: f64 = 0.25;
/// So many photos are named at most (structural: the message's length).
const NAMED: usize = 5;

/// What a cause is looked for in.
pub(crate) struct Evidence<'a> {
    /// The surface.
    pub(crate) mesh: &'a Mesh,
    /// The cameras.
    pub(crate) cameras: Option<&'a Cameras>,
    /// The silhouettes.
    pub(crate) masks: Option<&'a Masks>,
    /// Parts of the body that masks leave out.
    pub(crate) lost_parts: Option<&'a LostParts>,
    /// What is known of the capture.
    pub(crate) rig: &'a Rig,
    /// The weight that was given. \[kg\]
    pub(crate) kg: Option<f64>,
}

/// Reasons that a body which is not whole leads to.
const BROKEN: [Refusal; 5] = [
    Refusal::NoLegs,
    Refusal::NotUpright,
    Refusal::NoGround,
    Refusal::NoLimb,
    Refusal::NoNeck,
];

/// Puts the cause in the place of what it led to, where the body was refused as a whole and a cause is found.
pub(crate) fn explain(girths: &mut Girths, input: &Evidence<'_>) {
    let whole = |m: &shape::Missing| m.id.is_none() && BROKEN[..3].contains(&m.reason);
    if !girths.missing.iter().any(whole) {
        return;
    }
    let Some((reason, why)) = cause(girths.unit, input) else {
        return;
    };
    for missing in &mut girths.missing {
        if BROKEN.contains(&missing.reason) {
            (missing.reason, missing.why) = (reason, why.clone());
        }
    }
}

/// The cause, and a sentence.
fn cause(unit: Unit, input: &Evidence<'_>) -> Option<(Refusal, Message)> {
    let photos = input.cameras.zip(input.masks);
    let by_photos = photos.and_then(|(cameras, masks)| {
        empty(cameras, masks)
            .or_else(|| input.lost_parts.and_then(lost))
            .or_else(|| outlines(input, cameras, masks))
    });
    let known = || short(input).or_else(|| light(input));
    by_photos.or_else(|| known().filter(|_| unit == Unit::Metric))
}

/// Names of photos, some at most.
fn named(cameras: &Cameras, photos: &[PhotoId]) -> Field {
    let name = |id: &PhotoId| cameras.views.get(*id).map(|v| v.name.as_str());
    let names: Vec<&str> = photos.iter().filter_map(name).take(NAMED).collect();
    match photos.len() > NAMED {
        true => message!(AND_MORE, names = names, count = photos.len() - NAMED).into(),
        false => names.into(),
    }
}

/// Photos with next to nothing in their outline.
fn empty(cameras: &Cameras, masks: &Masks) -> Option<(Refusal, Message)> {
    let areas: Vec<(PhotoId, f64)> = cameras
        .views
        .join(&masks.views)
        .map(|(id, _, mask)| (id, mask.share()))
        .collect();
    let usual = shape::upper_median(areas.iter().map(|a| a.1))?;
    let none = areas.iter().filter(|(_, area)| *area < EMPTY_SHARE * usual);
    let none: Vec<PhotoId> = none.map(|(id, _)| *id).collect();
    let named = named(cameras, &none);
    (!none.is_empty()).then(|| {
        let why = message!(EMPTY_PHOTOS, names = named);
        (Refusal::EmptyPhoto, why)
    })
}

/// A part of the body that most masks leave out.
fn lost(parts: &LostParts) -> Option<(Refusal, Message)> {
    let first = BodyPart::ALL
        .into_iter()
        .find_map(|part| left_out(parts, part));
    first.map(|why| (Refusal::Incomplete, why))
}

/// Why nothing around a part can be measured, where most masks leave it out.
pub(crate) fn left_out(parts: &LostParts, part: BodyPart) -> Option<Message> {
    parts
        .mostly(part)
        .then(|| message!(MOSTLY_LOST, count = parts.of(part).len(), of = parts.photos))
}

/// Outlines that contradict those of all other photos, or a surface that kept only a part of what they share.
fn outlines(input: &Evidence<'_>, cameras: &Cameras, masks: &Masks) -> Option<(Refusal, Message)> {
    let seen = coherence(cameras, masks)?;
    let beyond: Vec<(PhotoId, f64)> = seen.contradicting().collect();
    if let Some((_, most)) = beyond.first() {
        let ids: Vec<PhotoId> = beyond.iter().map(|(id, _)| *id).collect();
        let why = message!(
            OUTLINE_CUTS,
            names = named(cameras, &ids),
            share = 100.0 * most
        );
        return Some((Refusal::Outlines, why));
    }
    let kept = input.mesh.volume() / seen.shared;
    (kept < LEAST_KEPT_SHARE).then(|| {
        let why = message!(APART, share = 100.0 * kept);
        (Refusal::Incomplete, why)
    })
}

/// A surface that is shorter than the stature that was given.
fn short(input: &Evidence<'_>) -> Option<(Refusal, Message)> {
    let stated = input.rig.stature_mm?;
    let (low, high) = input.mesh.bounds()?;
    let tall = high.z - low.z;
    (tall < (1.0 - CONTRADICTION * GIVEN_STATURE) * stated).then(|| {
        let why = message!(
            SHORT,
            height = tall / 10.0,
            stature = stated / 10.0,
            missing = 100.0 * (1.0 - tall / stated)
        );
        (Refusal::Incomplete, why)
    })
}

/// A surface that holds less than the weight that was given.
fn light(input: &Evidence<'_>) -> Option<(Refusal, Message)> {
    let kg = input.kg?;
    let (holds, fills) = (input.mesh.volume() * 1e-6, kg / DENSITY_KG_L);
    (holds < (1.0 - LACKING_SHARE) * fills).then(|| {
        let why = message!(
            LIGHT,
            holds = holds,
            weight = kg,
            fills = fills,
            missing = 100.0 * (1.0 - holds / fills)
        );
        (Refusal::Incomplete, why)
    })
}

/// A stature as the surface shows it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Tall {
    /// Crown above the ground. \[mm\]
    pub(crate) mm: Option<f64>,
    /// Its standard deviation. \[mm\]
    pub(crate) sigma_mm: Option<f64>,
}

/// Two lengths that contradict each other beyond what both can err, in words: those of the cameras, or the unit of the cameras and
/// the stature, where the one that was given is not the one that was measured.
pub(crate) fn disputed(input: &Evidence<'_>, tall: Tall, unit: Unit) -> Option<[Template; 2]> {
    if let Some(Scale::Disputed(pair)) = input.cameras.map(|c| c.scale) {
        return Some(pair.map(Length::template));
    }
    let (stated, mm) = input.rig.stature_mm.zip(tall.mm)?;
    let errs = tall.sigma_mm.unwrap_or(0.0) / mm;
    let far = CONTRADICTION * libm::hypot(GIVEN_STATURE, errs);
    let apart = unit == Unit::Metric && (stated / mm - 1.0).abs() > far;
    apart.then_some([SURFACE_UNIT, Length::Stature.template()])
}
