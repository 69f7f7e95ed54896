//! The stage that finds where to measure, without a statistical body model.

use crate::features::body::Body;
use crate::features::limb::limbs;
use crate::features::marks::{Marks, marks};
use crate::find_body::level_model;
use crate::model::law::Place;
use crate::model::predict::Cover;
use crate::planes::custom::{OwnGirth, own, taken_names};
use crate::planes::joints::arm_joints;
use crate::planes::limbs::parts;
use crate::planes::place::{across_neck, arms, legs, trunk};
use crate::planes::trunk::Trunk;
use crate::planes::wanted::{Waist, Wanted};
use crate::sections::narrowest::narrowest;
use shape::{BodyFeatures, GirthId, Landmarks, Mesh, Missing, Refusal, Side, Unit};
use stage::{Ctx, Field, Files, Message, Mistake, Named, Stage, Stop, message};
use std::sync::Arc;

stage::messages! {
    TALL = "warn-tall": " ({height:.0 cm} tall)";
    MADE_LEVELS = "warn-made-levels": "this body{tall} is outside the range of adults that the waist and chest model was fitted on (a child, a small figure, an unusual build, or a wrong stature): the levels of waist and chest come from synthetic bodies, and their intervals are wider";
    GUESSED_LEVELS = "warn-guessed-levels": "this body{tall} is outside the range that the waist and chest model knows: the levels of waist and chest are rough estimates, and their intervals are wide accordingly; check the stature, and that the whole body is visible and upright";
}

stage::params! {
    /// Which definitions are used.
    pub struct LandmarkParams {
        /// Which girths: all, or those of a set; what the pipeline declares comes besides.
        set: Wanted = Wanted::All,
        /// Which waist is called WC.
        waist: Waist = Waist::Natural,
        /// How much farther forward the neck leans than its own axis tells.
        #[range(-30.0..=30.0)]
        #[source(structural)]
        neck_lean_deg: f64 = 0.0,
        /// Girths of your own, by name: `[girth.mid_thigh]` with `part = "thigh"` and `at = 0.5`.
        girth: Named<OwnGirth> = Named::default(),
    }
}

stage::inputs! {
    /// A body.
    pub struct LandmarkInput {
        /// The surface.
        mesh: Arc<Mesh>,
        /// What it shows of the body: ground, front, hip, neck.
        features: Arc<BodyFeatures>,
        /// A level model of one's own, one TOML file; without it the one that ships.
        levels: Option<Arc<Files>>,
    }
}

/// `measure.landmarks`: mesh, body features → landmarks.
pub struct FindLandmarks;

impl Stage for FindLandmarks {
    const NAME: &'static str = "measure.landmarks";
    const VERSION: u32 = 47;
    const ABOUT: &'static str = "Finds neck, chest, waist, hip, arms and legs from marks on the outline: buttocks, bust, shoulders, ears.";
    type Params = LandmarkParams;
    type Input = LandmarkInput;
    type Output = Landmarks;

    fn check(p: &LandmarkParams) -> Vec<Mistake> {
        taken_names(&p.girth.0)
    }

    fn run(p: &LandmarkParams, input: LandmarkInput, ctx: &Ctx<'_>) -> Result<Landmarks, Stop> {
        let (mesh, body) = (
            &input.mesh,
            Body::of(&input.mesh, (*input.features).clone()),
        );
        let mut found = Landmarks {
            unit: body.unit,
            ..Landmarks::default()
        };
        if let Some(why) = body.refused {
            found.missing = nothing(p, why);
            return Ok(found);
        }
        if body.grounded {
            found.ground_mm = Some(body.ground);
            found.stature_mm = Some(body.stature);
            found.stature_sigma_mm = body.stature_sigma;
        }
        let level = |z: f64| [0.0, 0.0, z];
        let crown = level(body.ground + body.stature);
        found.points.push(("crown".into(), crown));
        let crotch = body.crotch.map(|z| ("crotch".into(), level(z)));
        found.points.extend(crotch);
        found.points.push(("front".into(), body.front.into()));
        let model = level_model(input.levels.as_deref())?;
        let absolute = found.unit == Unit::Metric;
        let marks = marks(&body);
        let between = |m: &Marks| (body.ground + m.hip, body.ground + m.bust);
        let narrow = |m: &Marks| narrowest(mesh, &body, between(m));
        let reported = marks
            .as_ref()
            .map(|m| Trunk::new(&body, m, &model, absolute, narrow(m)));
        let tall = absolute.then_some(body.stature);
        let cover = reported.as_ref().and_then(Trunk::cover);
        if let Some(word) = cover.and_then(|cover| word(cover, tall)) {
            ctx.warn(word);
        }
        trunk(p.waist, &body, reported.as_ref(), &mut found);
        let notch = model.law(Place::Notch);
        let word = across_neck(p.neck_lean_deg, mesh, &body, notch, &mut found);
        word.iter().for_each(|word| ctx.warn(word));
        let mut limbs = limbs(mesh, &body);
        let word = arm_joints(&mut limbs, &model);
        word.iter().for_each(|word| ctx.warn(word));
        arms(&limbs, &body, &mut found);
        let word = legs(&limbs, &body, &mut found);
        word.iter().for_each(|word| ctx.warn(word));
        own(&body, reported.as_ref(), &limbs, &p.girth.0, &mut found)?;
        found.found.retain(|l| p.set.holds(l.by));
        found
            .missing
            .retain(|m| m.id.is_none_or(|id| p.set.holds(id)));
        if let Some((reason, why)) = crate::features::whole::no_stature(&body) {
            (found.stature_mm, found.stature_sigma_mm) = (None, None);
            found.missing.push(Missing::number("stature", reason, why));
        }
        found.parts = parts(mesh, &body, &limbs);
        Ok(found)
    }
}

/// What is missing of a body of which nothing is known.
fn nothing(p: &LandmarkParams, why: Refusal) -> Vec<Missing> {
    let limbs = |id: fn(Side) -> GirthId| Side::BOTH.map(id);
    let all = [GirthId::Hip, GirthId::Waist, GirthId::Chest, GirthId::Neck];
    let all = all.into_iter().chain(limbs(GirthId::UpperArm));
    let all = all.chain(limbs(GirthId::Thigh)).chain(limbs(GirthId::Calf));
    let wanted = all.filter(|id| p.set.holds(*id));
    let mut missing: Vec<Missing> = wanted.map(|id| Missing::new(id, why)).collect();
    missing.push(Missing::number("stature", why, why.message()));
    missing
}

/// What is reported of a body that the measured people do not cover, so tall where lengths are known. \[mm\]
fn word(cover: Cover, tall: Option<f64>) -> Option<Message> {
    let tall = match tall {
        Some(mm) => Field::from(message!(TALL, height = mm / 10.0)),
        None => Field::from(""),
    };
    match cover {
        Cover::People => None,
        Cover::Made => Some(message!(MADE_LEVELS, tall = tall)),
        Cover::Outside => Some(message!(GUESSED_LEVELS, tall = tall)),
    }
}
