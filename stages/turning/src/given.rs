//! What the motion of somebody who turns is found from.

use shape::{Masks, People, Photos, Tracks};
use std::sync::Arc;

stage::params! {
    /// How the motion of somebody who turns on the spot is found.
    pub struct MotionParams {
        /// Rounds in which joints and outlines settle together; 0: by joints alone.
        #[range(0..=200)]
        #[source(structural)]
        rounds: u32 = 30,
        /// Longest side to which outlines are reduced.
        #[range(100..=4000)]
        #[source(structural)]
        outline_px: u32 = 700,
        /// How many sights of joints a photo's outline counts as, and its features at most.
        #[range(0.1..=1000.0)]
        outline_weight: f64 = 100.0,
        /// What a point of an outline counts for that is an arm's, a leg's or the head's: they move by themselves.
        #[range(0.0..=1.0)]
        limb_weight: f64 = 0.4,
        /// Focal length as if on 36 × 24 mm film where neither EXIF nor capture.toml tells it: of phones' main cameras
        /// 24 to 28 mm.
        #[range(10.0..=300.0)]
        #[source(cited = "Apple, technical specifications of iPhone 12 to 15: main camera 26 mm")]
        focal_35mm: f64 = 26.0,
    }
}

stage::inputs! {
    /// Photos of somebody who turns.
    pub struct MotionInput {
        /// The photos, for lens and names.
        photos: Arc<Photos>,
        /// Joints, and a coarse mask where there is no other.
        people: Arc<People>,
        /// Silhouettes, where they are known.
        masks: Option<Arc<Masks>>,
        /// Features of skin and clothes, where they are followed.
        tracks: Option<Arc<Tracks>>,
    }
}
