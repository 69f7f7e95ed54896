//! How the body is cut out, and why it may not be.

use crate::align::rectangle::RectangleError;
use shape::LOOKED_AT_MPX;

/// Weight of the length of the body's outline in every cut (γ). By hand: looked at three scenes (158 with a plate,
/// 160 and 170 without), at 0.7 and 1.4 of it: mean IoU +0.0003 and −0.0002 at most.
pub(crate) const GAMMA: f64 = 40.0;
/// Clusters of each mixture of the colours of a body. By hand: looked at three scenes (158 with a plate, 160 and 170
/// without), at 0.7 and 1.4 of it: mean IoU +0.0001 and −0.0002 at most.
pub(crate) const CLUSTERS: u32 = 6;
/// Height of the side of the disk below its top that is not body. By hand: looked at three scenes (158 with a plate, 160
/// and 170 without), at 0.7 and 1.4 of it: nothing changes. \[mm\]
pub(crate) const DISK_SIDE_MM: f64 = 150.0;

stage::params! {
    /// How photos are cut by their colours.
    pub struct CutParams {
        /// Weight of the border's length against colours (γ).
        #[range(0.0..=1000.0)]
        #[source(derived = "γ of every cut")]
        gamma: f64 = GAMMA,
        /// Rounds of fitting colours and cutting.
        #[range(1..=20)]
        #[source(structural)]
        rounds: u32 = 2,
        /// Clusters of the mixture of the body's colours.
        #[range(1..=20)]
        #[source(derived = "as of every mixture")]
        clusters: u32 = CLUSTERS,
    }
}

stage::params! {
    /// How the body is cut out.
    pub struct GrabCutParams {
        /// How photos are cut.
        #[group(flat)]
        cut: CutParams = CutParams::default(),
        /// Photos are looked at with so many million pixels at most; masks come back at the photos' own size.
        #[range(0.01..=100.0)]
        #[source(structural)]
        most_mpx: f64 = LOOKED_AT_MPX,
        /// Longest side at which the first cut is made; the border is cut again at full size.
        #[range(100..=4000)]
        #[source(structural)]
        coarse_px: u32 = 800,
        /// Height of the side of the disk below its top that is not body.
        #[range(0.0..=500.0)]
        #[source(derived = "as wherever the disk is known")]
        disk_side_mm: f64 = DISK_SIDE_MM,
        /// Whether what the other photos show decides where one alone is in doubt. Needs cameras.
        coherence: bool = true,
        /// A rectangle that holds the body on every photo, [left, top, right, bottom]; beyond it
        /// nothing is body. With it photos are cut by their colours alone where there is neither a
        /// plate nor anything still. Empty for none.
        box_px: Vec<f64> = vec![],
    }
}

stage::failures! {
    /// Why photos cannot be cut.
    pub enum CutError {
        /// Neither plate nor cameras.
        NoPlate = "fail-no-plate": "there is no plate, and without cameras the body cannot be separated from the background: take one photo of the same scene without the subject and call it plate.jpg, hand in masks (silhouette.import), or give the body's place (`box_px`)",
        /// No plate, and nothing that does not move.
        Moves(still: f64) = "fail-plate-moves": "there is no plate, and only {still:.0 %} of the photos' pixels do not move over the turn: did the camera move? take a plate with a fixed camera, hand in masks (silhouette.import), or give the body's place (`box_px`)",
        /// No pixel is body.
        Empty(name: String) = "fail-no-subject": "{name}: nothing in it differs from the empty scene: is the subject in it, or was the camera moved after the plate?",
        /// Nearly all pixels are body.
        Full(name: String) = "fail-all-differs": "{name}: nearly all of it differs from the empty scene: was the camera moved, or the light changed, while photos and plate were taken?",
    }
    wraps {
        /// A rectangle that is none.
        Rectangle(RectangleError),
    }
}
