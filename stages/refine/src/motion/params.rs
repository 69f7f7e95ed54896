//! Params that both stages which look for the body's motion share.

use crate::evidence::params::PatchParams;
use crate::evidence::patch::Pairing;
use crate::evidence::scene::VisibilityRules;
use crate::pictures::turn::PhotoSize;
use crate::surface::params::OptimizeSurfaceParams;

stage::params! {
    /// What is looked at; pixels are those of the level.
    pub struct LookParams {
        /// How large photos are.
        #[group(flat)]
        size: PhotoSize = PhotoSize::default(),
        /// Edge of the mesh that is looked at, in pixels of the level on the surface.
        #[range(1.0..=50.0)]
        #[source(derived = "as of refine.optimize_surface")]
        edge_px: f64 = OptimizeSurfaceParams::default().edge_px,
        /// Which patches are compared.
        #[group(flat)]
        patches: PatchParams = PatchParams { tilt_deg: 60.0, ..PatchParams::default() },
        /// Texture counts in full from this many times the noise's variance.
        #[range(0.0..=1000.0)]
        #[source(derived = "as of refine.optimize_surface")]
        noise_gain: f64 = OptimizeSurfaceParams::default().noise_gain,
    }
}

impl LookParams {
    /// At a level of the pyramid.
    pub(crate) fn at(level: u32) -> Self {
        let size = PhotoSize {
            level,
            ..PhotoSize::default()
        };
        LookParams {
            size,
            ..LookParams::default()
        }
    }

    /// Which pictures see a vertex, every two of which are compared.
    pub(crate) fn rules(&self) -> VisibilityRules {
        VisibilityRules::new(self.patches.tilt_deg, Pairing::ALL, self.noise_gain)
    }
}
