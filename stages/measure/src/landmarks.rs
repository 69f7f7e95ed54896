//! The stage that finds where to measure, without a statistical body model.

use crate::features::body::{Body, body};
use crate::features::marks::{Marks, hip, marks};
use crate::geometry::slices::level;
use crate::planes::levels;
use crate::planes::limbs::{legs, parts, upper_arm};
use nalgebra::Point3;
use shape::{Cameras, Landmark, Landmarks, Mesh, Missing, Part, Plane};
use stage::{Ctx, Stage, Stop};
use std::sync::Arc;

stage::choice! {
    /// Where the waist is; four definitions are in use.
    pub enum Waist {
        /// The natural waist, between lowest rib and hip bone (ISO 8559-1 5.3.10).
        Natural = "natural",
        /// The narrowest of the trunk (ISAK).
        Narrowest = "narrowest",
        /// The navel (MESA).
        Navel = "navel",
        /// The top of the hip bone (NIH).
        HipBone = "hip_bone",
    }
}

stage::params! {
    /// Which definitions are used.
    pub struct LandmarkParams {
        /// Which waist is called WC.
        waist: Waist = Waist::Natural,
        /// How much farther forward the neck leans than head and shoulders tell.
        #[range(-30.0..=30.0)]
        neck_lean_deg: f64 = 0.0,
    }
}

stage::inputs! {
    /// A surface, upright in the turntable frame.
    pub struct LandmarkInput {
        /// The surface.
        mesh: Arc<Mesh>,
        /// Cameras: where the ground is.
        cameras: Option<Arc<Cameras>>,
    }
}

/// A mesh that is no body.
#[derive(Debug, thiserror::Error)]
#[error("the surface is empty or lies below the ground, so there is no body to measure")]
pub struct NoBody;

/// `measure.landmarks`: mesh → landmarks.
pub struct FindLandmarks;

impl Stage for FindLandmarks {
    const NAME: &'static str = "measure.landmarks";
    const VERSION: u32 = 14;
    const ABOUT: &'static str = "Finds neck, chest, waist, hip, arms and legs from marks on the outline: buttocks, hollow of the back, bust, shoulders, ears.";
    type Params = LandmarkParams;
    type Input = LandmarkInput;
    type Output = Landmarks;

    fn run(p: &LandmarkParams, input: LandmarkInput, ctx: &Ctx<'_>) -> Result<Landmarks, Stop> {
        let mesh = &input.mesh;
        let lowest = mesh.bounds().map_or(0.0, |b| b.0.z);
        let ground = input.cameras.as_ref().map_or(lowest, |c| c.ground_mm);
        let body = body(mesh, ground).ok_or(NoBody)?;
        let mut found = Landmarks {
            stature_mm: body.stature,
            ..Landmarks::default()
        };
        found
            .points
            .push(("crown".into(), [0.0, 0.0, ground + body.stature]));
        if let Some(z) = body.crotch {
            found.points.push(("crotch".into(), [0.0, 0.0, z]));
        }
        let front = ("front".to_owned(), body.front.into());
        found.points.push(front);
        if !body.front_is_sure {
            ctx.warn(
                "no feet tell which way the body faces, so the hip's and the neck's levels may be wrong: \
                 do shoes or a long coat hide them?",
            );
        }
        let marks = marks(&body);
        trunk(p, &body, marks.as_ref(), &mut found);
        across_neck(p, mesh, &body, &mut found);
        arms(mesh, &body, marks.as_ref(), &mut found);
        legs(&body, &mut found);
        if let Some(why) = crate::features::whole::no_stature(&body) {
            found.stature_mm = 0.0;
            found.missing.push(missing("stature", why));
        }
        found.parts = parts(mesh, &body);
        found
            .missing
            .iter()
            .for_each(|m| ctx.warn(format!("{}: {}", m.name, m.why)));
        Ok(found)
    }
}

pub(crate) fn landmark(
    name: &str,
    label: &str,
    definition: &str,
    plane: Plane,
    part: Part,
) -> Landmark {
    let (name, label, definition) = (name.into(), label.into(), definition.into());
    Landmark {
        name,
        label,
        definition,
        plane,
        part,
        sigma: shape::PlaneSigma::default(),
    }
}

/// A level plane amid the ring of the trunk.
fn across(body: &Body, z: f64) -> Plane {
    let amid = body.trunk(z).map_or(Point3::origin(), |r| r.centre);
    Plane {
        point_mm: [amid.x, amid.y, z],
        ..level(z)
    }
}

pub(crate) fn missing(name: &str, why: &str) -> Missing {
    let (name, why) = (name.into(), why.into());
    Missing { name, why }
}

/// Hip, waist and chest.
fn trunk(p: &LandmarkParams, body: &Body, marks: Option<&Marks>, found: &mut Landmarks) {
    let mut add = |name: &str, label: &str, z: f64, text: &str| {
        let plane = across(body, z);
        found
            .found
            .push(landmark(name, label, text, plane, Part::Trunk));
    };
    let lowest = body.crotch.and_then(|crotch| hip(body, crotch));
    if let Some(z) = lowest {
        let text =
            "hip: horizontal, at the greatest prominence of the buttocks (ISO 8559-1 5.3.13)";
        add("HC", "hip", z, text);
        if let Some(z) = longest(body, z) {
            let text = "hip, greatest: horizontal, the longest tape near the hip's level";
            add("HC_max", "hip, greatest", z, text);
        }
    }
    if let Some(m) = marks {
        let (z, text) = waist(p.waist, body, m);
        add("WC", "waist", z, text);
        // The other definitions stand beside the chosen one, each under its own name.
        for (which, name, label) in [
            (Waist::Natural, "WC_natural", "waist, natural"),
            (Waist::Narrowest, "WC_narrowest", "waist, narrowest"),
            (Waist::Navel, "WC_navel", "waist at the navel"),
            (Waist::HipBone, "WC_hip_bone", "waist at the hip bone"),
        ] {
            let is = which != Waist::Narrowest || narrowest(body, m).is_some();
            if which != p.waist && is {
                let (z, text) = waist(which, body, m);
                add(name, label, z, text);
            }
        }
        let z = body.ground + levels::chest(m, body.stature);
        let text = "chest: horizontal at the nipples' height, trunk only (ISO 8559-1 5.3.4)";
        add("CC", "chest", z, text);
    }
    let why = unlike(body);
    if lowest.is_none() {
        found.missing.push(missing("HC", why));
    }
    if marks.is_none() {
        found.missing.push(missing("WC", why));
        found.missing.push(missing("CC", why));
    }
}

/// What is missing of an upright body.
fn unlike(body: &Body) -> &'static str {
    match (body.crotch, body.neck) {
        (None, _) => {
            "no two legs were found, and levels are told from where they join: is the body cut off, or does a coat or a skirt hide them?"
        }
        (_, None) => {
            "no neck was found between head and shoulders, and levels are told from it: does hair or a collar hide it, or do the photos cut the head off?"
        }
        _ => "trunk and legs are not those of an upright body",
    }
}

/// The waist's height and what it is called.
fn waist(which: Waist, body: &Body, m: &Marks) -> (f64, &'static str) {
    let natural = body.ground + levels::waist(m, body.stature);
    match which {
        Waist::Natural => (
            natural,
            "waist: horizontal, amid lowest rib and hip bone (ISO 8559-1 5.3.10, WHO)",
        ),
        Waist::Narrowest => match narrowest(body, m) {
            Some(z) => (z, "waist: horizontal, the narrowest of the trunk (ISAK)"),
            None => (
                natural,
                "waist: horizontal, amid lowest rib and hip bone, as ISAK has it where nothing is narrowest",
            ),
        },
        Waist::Navel => (
            natural - 0.017 * body.stature,
            "waist: horizontal, at the navel's usual height (MESA)",
        ),
        Waist::HipBone => (
            natural - 0.030 * body.stature,
            "waist: horizontal, at the usual height of the top of the hip bone (NIH)",
        ),
    }
}

/// The neck, across its axis.
fn across_neck(p: &LandmarkParams, mesh: &Mesh, body: &Body, found: &mut Landmarks) {
    // A body that is cut off has no stature, and levels are shares of it.
    let whole = body
        .crotch
        .and_then(|_| crate::features::neck::throat(mesh, body));
    let plane = whole.and_then(|throat| {
        let told = levels::neck_lean(&throat, body.stature);
        let lean = told.clamp(0.0, 0.8) + p.neck_lean_deg.to_radians();
        throat.leaning(mesh, body, throat.level, lean)
    });
    match plane {
        Some(plane) => {
            let text = "neck: across its axis, amid its height (ISO 8559-1 5.3.2)";
            found
                .found
                .push(landmark("NC", "neck", text, plane, Part::Head));
        }
        None if body.crotch.is_none() => found.missing.push(missing("NC", unlike(body))),
        None => found.missing.push(missing(
            "NC",
            "no neck was found between head and shoulders: does hair or a collar hide it, or do the photos cut the head off?",
        )),
    }
}

/// Both upper arms.
fn arms(mesh: &Mesh, body: &Body, marks: Option<&Marks>, found: &mut Landmarks) {
    for (name, label, side, part) in [
        ("AC_L", "upper arm, left", 1.0, Part::ArmLeft),
        ("AC_R", "upper arm, right", -1.0, Part::ArmRight),
    ] {
        let text = "upper arm: across the arm, amid shoulder and elbow (ISO 8559-1 5.3.16)";
        match marks.and_then(|m| upper_arm(mesh, body, side, m)) {
            Some(plane) => found.found.push(landmark(name, label, text, plane, part)),
            None if marks.is_none() => found.missing.push(missing(name, unlike(body))),
            None => found.missing.push(missing(
                name,
                "this arm does not stand clear of the trunk on the surface: hold it farther away",
            )),
        }
    }
}

/// How far from the hip's level the greatest girth of the hips is looked for, as a share of stature.
const NEAR_HIP: f64 = 0.03;

/// The height near the hip's at which the tape around the trunk is longest.
fn longest(body: &Body, hip: f64) -> Option<f64> {
    let low = body.crotch?.max(hip - NEAR_HIP * body.stature);
    body.between(low, hip + NEAR_HIP * body.stature)
        .filter_map(|s| Some((s.z, s.rings.first()?.tape)))
        .max_by(|a, b| a.1.total_cmp(&b.1))
        .map(|(z, _)| z)
}

/// The height of a true minimum of the trunk's tape between hip and bust.
fn narrowest(body: &Body, m: &Marks) -> Option<f64> {
    let tapes: Vec<(f64, f64)> = body
        .between(body.ground + m.hip, body.ground + m.bust)
        .filter_map(|s| Some((s.z, s.rings.first()?.tape)))
        .collect();
    let least = tapes.iter().min_by(|a, b| a.1.total_cmp(&b.1))?;
    let ends = tapes.first()?.1.min(tapes.last()?.1);
    (least.1 < 0.99 * ends).then_some(least.0)
}
