//! The stage that reads a body's ground, front, legs, hip and neck, and whether it is a whole one.

use crate::features::standing::standing;
use crate::model::error::ModelError;
use crate::model::file::LevelModel;
use crate::planes::hidden::tell_hip;
use shape::{BodyFeatures, Cameras, HipAt, Mesh, Unit};
use stage::{Ctx, Files, Stage, Stop, message};
use std::sync::Arc;

stage::messages! {
    NO_FRONT = "warn-front": "no feet show which way the body faces, so the hip's and the neck's levels may be wrong: do shoes or a long coat hide them?";
    HIP_HIDDEN = "warn-hip-hidden": "where the buttocks reach farthest back does not show, so the hip's level is estimated from the rest of the body and its interval is wider: does a skirt or coat hide it?";
}

stage::inputs! {
    /// A surface, upright in the turntable frame.
    pub struct BodyInput {
        /// The surface.
        mesh: Arc<Mesh>,
        /// Cameras: where the ground is given.
        cameras: Option<Arc<Cameras>>,
        /// A level model of one's own, one TOML file; without it the one that ships.
        levels: Option<Arc<Files>>,
    }
}

stage::failures! {
    /// Why nothing can be measured.
    pub enum BodyError {
        /// A mesh that is no body.
        NoBody = "fail-no-body": "the surface is empty or below the ground, so there is no body to measure",
    }
}

/// `measure.body`: mesh → body features.
pub struct FindBody;

impl Stage for FindBody {
    const NAME: &'static str = "measure.body";
    const VERSION: u32 = 2;
    const ABOUT: &'static str =
        "Reads a body's ground, front, crotch, hip and neck, and whether it is whole.";
    type Params = ();
    type Input = BodyInput;
    type Output = BodyFeatures;

    fn run(_: &(), input: BodyInput, ctx: &Ctx<'_>) -> Result<BodyFeatures, Stop> {
        let found = standing(&input.mesh, input.cameras.as_deref()).ok_or(BodyError::NoBody)?;
        let mut body = found.body;
        if body.refused.is_some() {
            return Ok(body.shown);
        }
        found.word.iter().for_each(|word| ctx.warn(word));
        let model = level_model(input.levels.as_deref())?;
        let absolute = body.unit == Unit::Metric;
        tell_hip(&mut body, &model, absolute, found.footing);
        if !body.front_is_sure {
            ctx.warn(message!(NO_FRONT));
        }
        if body.whole && matches!(body.hip, Some(HipAt::Hidden(..))) {
            ctx.warn(message!(HIP_HIDDEN));
        }
        Ok(body.shown)
    }
}

/// The level model: the user's, or the one that ships.
pub(crate) fn level_model(files: Option<&Files>) -> Result<LevelModel, Stop> {
    let Some(files) = files else {
        return Ok(LevelModel::built_in());
    };
    let [entry] = files.entries.as_slice() else {
        return Err(ModelError::Count(files.entries.len()).into());
    };
    let bytes = files.read(entry)?;
    Ok(LevelModel::read(
        &entry.name,
        &String::from_utf8_lossy(&bytes),
    )?)
}
