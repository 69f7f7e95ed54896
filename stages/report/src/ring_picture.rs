//! The stage that draws the camera ring.

use crate::ring;
use shape::{Cameras, Document};
use stage::{Ctx, Stage, Stop};
use std::sync::Arc;

stage::inputs! {
    /// Cameras.
    pub struct RingInput {
        /// The cameras to draw.
        cameras: Arc<Cameras>,
    }
}

/// `report.ring`: cameras → document (SVG).
pub struct RingPicture;

impl Stage for RingPicture {
    const NAME: &'static str = "report.ring";
    const VERSION: u32 = 4;
    const ABOUT: &'static str = "Draws the cameras around the subject, from above and the side.";
    type Params = ();
    type Input = RingInput;
    type Output = Document;

    fn run(_: &(), input: RingInput, _: &Ctx<'_>) -> Result<Document, Stop> {
        let bytes = ring::svg(&input.cameras).into_bytes();
        Ok(Document {
            media: "image/svg+xml".into(),
            bytes,
        })
    }
}
