//! How a subject that was walked around is cut out, and why it may not be.

use crate::params::{CLUSTERS, GAMMA};

stage::params! {
    /// How a subject that was walked around is cut out.
    pub struct WalkParams {
        /// Longest side to which photos are reduced while cells and outlines are found; the border is
        /// cut again at full size.
        #[range(100..=4000)]
        #[source(structural)]
        coarse_px: u32 = 600,
        /// Cells along the greatest side of the block about the subject, at first; a quarter more later.
        #[range(32..=400)]
        #[source(structural)]
        cells: u32 = 128,
        /// Rounds of fitting colours and cutting cells, before any outline.
        #[range(1..=20)]
        #[source(structural)]
        rounds: u32 = 4,
        /// Rounds of cells from outlines and outlines from cells.
        #[range(1..=10)]
        #[source(structural)]
        passes: u32 = 2,
        /// Clusters of the mixture of the subject's colours; the background's has half as many more.
        #[range(1..=20)]
        #[source(derived = "as of every mixture")]
        clusters: u32 = CLUSTERS,
        /// Price of parting two cells.
        #[range(0.0..=100.0)]
        smooth: f64 = 1.0,
        /// Weight of an outline's length against colours (γ).
        #[range(0.0..=1000.0)]
        #[source(derived = "γ of every cut")]
        gamma: f64 = GAMMA,
        /// Height below which nothing is the subject: a pedestal's top. In the frame of the
        /// cameras; of a walk without scale their mean distance is 1000. By itself it ends at the
        /// floor, or where `whole` of the photos no longer show it.
        #[range(-100000.0..=100000.0)]
        #[source(structural)]
        bottom_mm: f64 = -100_000.0,
        /// Share of the photos that must show the subject down to where it is taken to end.
        #[range(0.1..=1.0)]
        whole: f64 = 0.9,
        /// Widest gap between cameras around the subject.
        #[range(30.0..=360.0)]
        most_gap_deg: f64 = 120.0,
        /// Least share of the pixels near the outlines (in the middle photo) that colours alone put on
        /// the right side.
        #[range(0.5..=1.0)]
        least_by_color: f64 = 0.82,
        /// How alike (intersection over union, in the middle photo) outlines of the last two passes
        /// must be, and outlines and what all photos together show.
        #[range(0.0..=1.0)]
        least_agreement: f64 = 0.85,
        /// Greatest share of the features amid the cameras which outlines may lack.
        #[range(0.0..=1.0)]
        most_lacking: f64 = 0.1,
    }
}

stage::failures! {
    /// Why a walk gives no masks.
    pub enum WalkCutError {
        /// Too few cameras.
        Few(found: usize, least: usize) = "fail-walk-views": "only {found} photos have a camera, but to separate a subject from the background by a walk around it takes at least {least}: take more photos, all the way round, or hand in masks",
        /// Cameras on one side.
        OneSide(gap: f64) = "fail-walk-open": "the cameras leave {gap:.0 °} around the subject open: walk all the way round, or hand in masks",
        /// Nothing that all see.
        NoMiddle = "fail-walk-nowhere": "there is no place that nearly all cameras look at: keep the subject amid the photos, or hand in masks",
        /// Nothing found.
        Nothing = "fail-walk-nothing": "nothing amid the cameras differs from the background by its colours: is the subject in the middle of the photos? hand in masks, or take the photos before another background",
        /// Colours alike.
        Alike(share: f64, least: f64) = "fail-walk-colours": "subject and background have nearly the same colours: beside the outline only {share:.0 %} of the pixels are on the side of their colour ({least:.0 %} are asked for, `least_by_color`), so the masks would be guesses: hand in masks, or take the photos before another background",
        /// Masks that change.
        Unsettled(share: f64, least: f64) = "fail-walk-unsettled": "the outlines do not settle: those of the last two passes share only {share:.0 %} ({least:.0 %} are asked for, `least_agreement`): hand in masks",
        /// Masks that contradict each other.
        Contradict(share: f64, least: f64) = "fail-walk-contradict": "the outlines contradict each other: each shares only {share:.0 %} with what all together show ({least:.0 %} are asked for, `least_agreement`): did the subject move, or step aside? hand in masks",
        /// Parts are lacking.
        Lacking(share: f64, most: f64) = "fail-walk-lacking": "{share:.0 %} of the features amid the cameras are in no outline (at most {most:.0 %} may be, `most_lacking`): a part of the subject has the background's colours, or more than the subject is there: hand in masks, or take the photos before another background",
        /// Cut off.
        CutOff(count: usize, of: usize, names: String) = "fail-walk-border": "the subject runs over the border of {count} of {of} photos ({names}): take photos that show it whole, or hand in masks",
    }
}
