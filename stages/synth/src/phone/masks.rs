//! The stage that moves true silhouettes as the stabiliser moves the photos.

use crate::phone::draw::shift;
use crate::phone::lens::{Linear, resampled};
use rayon::prelude::*;
use shape::{Mask, MaskRuns, Masks, PhotoId};
use stage::{Ctx, Stage, Stop};
use std::sync::Arc;

stage::params! {
    /// What moves photos; as `synth.phone` has it.
    pub struct PhoneMaskParams {
        /// Standard deviation of the stabiliser's shift of a photo, right and down.
        #[range(0.0..=50.0)]
        #[source(structural)]
        shift_px: f64 = 0.0,
        /// Seed of all that is by chance.
        #[range(0..=1000000)]
        #[source(structural)]
        seed: u32 = 1,
    }
}

stage::inputs! {
    /// Silhouettes of a good camera.
    pub struct PhoneMaskInput {
        /// The silhouettes, of photos that are numbered from 0.
        masks: Arc<Masks>,
    }
}

/// `synth.phone_masks`: masks → masks.
pub struct PhoneMasks;

impl Stage for PhoneMasks {
    const NAME: &'static str = "synth.phone_masks";
    const VERSION: u32 = 1;
    const ABOUT: &'static str =
        "Moves true silhouettes as `synth.phone` with the same shift and seed moves the photos.";
    type Params = PhoneMaskParams;
    type Input = PhoneMaskInput;
    type Output = Masks;

    fn run(p: &PhoneMaskParams, input: PhoneMaskInput, ctx: &Ctx<'_>) -> Result<Masks, Stop> {
        let steps = ctx.steps("masks", input.masks.views.len());
        let one = |(id, mask): &(PhotoId, MaskRuns)| -> Result<(PhotoId, MaskRuns), Stop> {
            let mask = moved(&mask.pixels(), shift(p.seed, id.0, p.shift_px));
            steps.tick()?;
            Ok((*id, mask.into()))
        };
        let masks = input.masks.views.as_slice().par_iter().map(one);
        let masks: Vec<_> = masks.collect::<Result<_, _>>()?;
        Ok(masks.into_iter().collect())
    }
}

/// What a pixel is covered, moved as [`resampled`] moves light. \[px\]
fn moved(mask: &Mask, shift: [f32; 2]) -> Mask {
    if shift == [0.0; 2] {
        return mask.clone();
    }
    let cover: Linear = mask.map(|v| [f32::from(*v) / 255.0; 3]);
    resampled(&cover, shift, 0.0).map(|v| (255.0 * v[1]).round().clamp(0.0, 255.0) as u8)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::phone::{draw::draw, params::PhoneParams};

    #[test]
    fn masks_move_as_the_photos_of_the_same_seed() {
        let p = PhoneParams {
            shift_px: 3.0,
            blur_px: 1.0,
            seed: 7,
            ..PhoneParams::default()
        };
        let (faults, _) = draw(&p, 4);
        for (i, fault) in faults.iter().enumerate() {
            assert_eq!(shift(7, i as u32, 3.0), fault.shift);
        }
        let mut mask = Mask::filled(9, 9, 0);
        *mask.at_mut(4, 4) = 255;
        assert_eq!(moved(&mask, [2.0, -1.0]).at(6, 3), 255);
    }
}
