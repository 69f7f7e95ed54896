//! The stage that holds a motion against the true one.

use crate::apart::apart;
use serde_json::json;
use shape::{Cameras, Document};
use stage::{Ctx, Stage, Stop};
use std::sync::Arc;

stage::inputs! {
    /// A motion, and the true one.
    pub struct ScoreInput {
        /// Cameras as found.
        cameras: Arc<Cameras>,
        /// Cameras as the body saw them.
        truth: Arc<Cameras>,
    }
}

/// Too few photos to hold one motion against another.
#[derive(Debug, thiserror::Error)]
#[error("only {0} photos have both a camera and a true one: at least 3 are wanted")]
pub struct TooFew(usize);

/// `turning.score`: cameras, true cameras → a table of errors.
pub struct ScoreMotion;

impl Stage for ScoreMotion {
    const NAME: &'static str = "turning.score";
    const VERSION: u32 = 1;
    const ABOUT: &'static str = "Holds the motion of somebody who turned on the spot against the true one, wherever its frame is; errors are metrics.";
    type Params = ();
    type Input = ScoreInput;
    type Output = Document;
    const METRICS: &'static [&'static str] = &["azimuth", "sideways", "depth", "scale"];

    fn run(_: &(), input: ScoreInput, ctx: &Ctx<'_>) -> Result<Document, Stop> {
        let both: Vec<_> = input.cameras.views.join(&input.truth.views).collect();
        let poses: Vec<_> = both
            .iter()
            .map(|(_, found, truth)| (found.camera.pose, truth.camera.pose))
            .collect();
        let apart = apart(&poses).ok_or(TooFew(poses.len()))?;
        ctx.metric("azimuth", apart.azimuth.to_degrees(), "°");
        ctx.metric("sideways", apart.sideways, "mm");
        ctx.metric("depth", apart.depth, "mm");
        ctx.metric("scale", 100.0 * (apart.scale - 1.0), "%");
        let file = json!({
            "photos": poses.len(), "azimuth_rms_deg": apart.azimuth.to_degrees(), "sideways_rms_mm": apart.sideways,
            "depth_rms_mm": apart.depth, "scale_error_pct": 100.0 * (apart.scale - 1.0),
        });
        Ok(Document {
            media: "application/json".into(),
            bytes: serde_json::to_vec_pretty(&file).expect("bug: JSON"),
        })
    }
}
