//! Params of the stages that move the surface.

use crate::evidence::params::PatchParams;
use crate::pictures::turn::PhotoSize;

stage::choice! {
    /// How a vertex follows the photos.
    pub enum Flow {
        /// Its own pull (eq. 3).
        Rigid = "rigid",
        /// The weighted median of its neighbourhood's (eq. 5–7).
        WeightedMedian = "weighted_median",
    }
}

stage::params! {
    /// The evolution; lengths in pixels of the level on the surface, as in all of eq. 3–7 here.
    pub struct EvolveParams {
        /// Each vertex' own pull (eq. 3), or its neighbourhood's weighted median (eq. 5–7).
        flow: Flow = Flow::Rigid,
        /// Weight λ of mean curvature (eq. 3).
        #[range(0.0..=1000.0)]
        lambda: f64 = 1.0,
        /// Weight η of near neighbours in the median (eq. 7).
        #[range(0.0..=1000.0)]
        #[source(derived = "as of refine.optimize_surface")]
        eta: f64 = OptimizeSurfaceParams::default().eta,
        /// Weight κ of alike curved neighbours in the median (eq. 7).
        #[range(0.0..=1000.0)]
        #[source(derived = "as of refine.optimize_surface")]
        kappa: f64 = OptimizeSurfaceParams::default().kappa,
        /// Rings of neighbours in the median.
        #[range(1..=2)]
        #[source(cited = "the paper, eq. 7: the neighbours of a vertex")]
        rings: u32 = 1,
        /// Time step Δt, in square pixels.
        #[range(0.00001..=1.0)]
        #[source(cited = "the paper, experiments: 0.01")]
        time_step: f64 = 0.01,
        /// Steps.
        #[range(0..=100000)]
        #[source(structural)]
        iterations: u32 = 100,
        /// Steps after which visibility is looked at anew.
        #[range(1..=1000)]
        #[source(structural)]
        look_every: u32 = 10,
        /// How large photos are looked at.
        #[group(flat)]
        size: PhotoSize = PhotoSize::default(),
        /// Edge of the mesh, in pixels of the level; 0 keeps the mesh as it is.
        #[range(0.0..=50.0)]
        #[source(derived = "as of refine.optimize_surface")]
        edge_px: f64 = OptimizeSurfaceParams::default().edge_px,
        /// Which patches are compared.
        #[group(flat)]
        patches: PatchParams = PatchParams { patch: 3, level_patch: false, ..PatchParams::default() },
        /// Greatest angle between two photos that are compared.
        #[range(5.0..=180.0)]
        pair_to_deg: f64 = 180.0,
    }
}

stage::params! {
    /// How the surface is optimized.
    pub struct OptimizeSurfaceParams {
        /// How large photos are looked at.
        #[group(flat)]
        size: PhotoSize = PhotoSize::default(),
        /// Edge of the mesh, in pixels of the level on the surface; 0 keeps the mesh as it is.
        #[range(0.0..=50.0)]
        #[source(by_hand = "the sample of a dressed man: halved, trunk 0.7 mm farther off; doubled, 0.6 mm (docs/lab/numbers.md)")]
        edge_px: f64 = 4.0,
        /// Whether each vertex follows its own pull (eq. 3) or its neighbourhood's weighted median (eq. 6).
        flow: Flow = Flow::Rigid,
        /// Weight of near neighbours in the median (eq. 7).
        // A unit: a median of weights asks only how they are to each other.
        #[range(0.0..=1000.0)]
        #[source(structural)]
        eta: f64 = 1.0,
        /// Weight of alike curved neighbours in the median (eq. 7).
        #[range(0.0..=1000.0)]
        #[source(by_hand = "the sample of a dressed man: halved and doubled, nothing changes, for its flow is no median (docs/lab/numbers.md)")]
        kappa: f64 = 1.0,
        /// Which patches are compared.
        #[group(flat)]
        patches: PatchParams = PatchParams::default(),
        /// Least angle between two photos that are compared.
        #[range(0.0..=90.0)]
        #[source(by_hand = "the sample of a dressed man: halved and doubled, nothing changes, for no two photos are as near as 6° (docs/lab/numbers.md)")]
        pair_from_deg: f64 = 3.0,
        /// Greatest angle between two photos that are compared.
        #[range(5.0..=180.0)]
        #[source(by_hand = "four captures: at 65° trunks of three 0.02 to 0.07 mm nearer, of one 0.01 mm farther off, tapes up to 0.1 % smaller (docs/lab/numbers.md)")]
        pair_to_deg: f64 = 50.0,
        /// Texture counts in full from this many times the noise's variance.
        #[range(0.0..=1000.0)]
        #[source(by_hand = "the sample of a dressed man: halved and doubled, trunk 0.01 mm nearer and farther off (docs/lab/numbers.md)")]
        noise_gain: f64 = 4.0,
        /// Length below which detail is smoothed where texture is plain, in pixels of the level.
        #[range(0.0..=200.0)]
        #[source(by_hand = "the sample of a dressed man: halved, trunk 0.4 mm farther off; doubled, 1.5 mm (docs/lab/numbers.md)")]
        smooth_px: f64 = 8.0,
        /// Rings of neighbours over which curvature is averaged: what is as round as these rests.
        #[range(0..=50)]
        #[source(by_hand = "the sample of a dressed man: halved, trunk 0.03 mm nearer (docs/lab/numbers.md)")]
        rest_rings: u32 = 3,
        /// Weight of the silhouettes.
        #[range(0.0..=100.0)]
        #[source(by_hand = "the sample of a dressed man: halved, trunk 0.02 mm farther off, tapes by 0.17 % of theirs (docs/lab/numbers.md)")]
        contour_weight: f64 = 0.3,
        /// Weight of the visual hull: what shows outside of a silhouette is drawn back into all of them.
        #[range(0.0..=100.0)]
        hull_weight: f64 = 10.0,
        /// How far outside of a silhouette the surface may show, in pixels of the level.
        #[range(0.0..=100.0)]
        slack_px: f64 = 3.0,
        /// What hangs on a neck of at most so many edges is cut off; 0 keeps it.
        #[range(0..=8)]
        neck_edges: u32 = 6,
        /// How far inward a better place is looked for first, in pixels of the level; 0 is nowhere.
        #[range(0.0..=100.0)]
        reach_px: f64 = 0.0,
        /// Photos are not read again at a vertex that moved less since they were, in pixels of the level; its agreement goes on by slope and stiffness.
        #[range(0.0..=1.0)]
        still_px: f64 = 0.1,
        /// Rounds that begin with such a search.
        #[range(0..=100)]
        #[source(structural)]
        searches: u32 = 1,
        /// Times that visibility is looked at anew.
        #[range(1..=100)]
        #[source(structural)]
        rounds: u32 = 3,
        /// Most steps between two looks.
        #[range(1..=100)]
        #[source(structural)]
        steps: u32 = 4,
    }
}
