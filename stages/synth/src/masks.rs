//! The stage that tells the true silhouettes.

use crate::raster::cast;
use rayon::prelude::*;
use shape::{Cameras, Mask, MaskRuns, Masks, Mesh, PhotoId, Sway, View};
use stage::{Ctx, Stage, Stop};
use std::sync::Arc;

stage::params! {
    /// How exactly.
    pub struct MaskParams {
        /// Rays through each pixel along each of its sides.
        #[range(1..=15)]
        #[source(structural)]
        rays: u32 = 4,
    }
}

stage::inputs! {
    /// A body and the cameras that see it.
    pub struct MaskInput {
        /// The body at rest.
        mesh: Arc<Mesh>,
        /// The true cameras.
        cameras: Arc<Cameras>,
        /// How the body moves between photos.
        sway: Option<Arc<Sway>>,
    }
}

/// `synth.masks`: mesh, cameras → masks.
pub struct TrueMasks;

impl Stage for TrueMasks {
    const NAME: &'static str = "synth.masks";
    const VERSION: u32 = 2;
    const ABOUT: &'static str =
        "Gives the true silhouettes: how much of each pixel the body covers.";
    type Params = MaskParams;
    type Input = MaskInput;
    type Output = Masks;

    fn run(p: &MaskParams, input: MaskInput, ctx: &Ctx<'_>) -> Result<Masks, Stop> {
        let normals = input.mesh.normals();
        let steps = ctx.steps("masks", input.cameras.views.len());
        let mask = |(id, view): &(PhotoId, View)| -> Result<(PhotoId, MaskRuns), Stop> {
            let lens = &view.camera.lens;
            let mut mask = Mask::filled(lens.width as usize, lens.height as usize, 0);
            let motion = input.sway.as_ref().and_then(|s| s.views.get(*id));
            let rays = p.rays as usize;
            cast(
                (&input.mesh, &input.mesh.positions),
                &normals,
                &view.camera,
                motion,
                rays,
                |x, y, seen| {
                    *mask.at_mut(x, y) = (255.0 * seen.cover).round() as u8;
                },
            );
            steps.tick()?;
            Ok((*id, mask.into()))
        };
        let masks = input.cameras.views.as_slice().par_iter().map(mask);
        let masks: Vec<_> = masks.collect::<Result<_, _>>()?;
        Ok(masks.into_iter().collect())
    }
}
