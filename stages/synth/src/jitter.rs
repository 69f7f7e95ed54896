//! The stage that moves the borders of silhouettes by chance.

use crate::dice::Dice;
use rayon::prelude::*;
use shape::{Mask, MaskRuns, Masks, PhotoId};
use stage::{Ctx, Stage, Stop};
use std::sync::Arc;

stage::params! {
    /// How far borders move, and how smoothly.
    pub struct JitterParams {
        /// Standard deviation of a border's way, right and down.
        #[range(0.0..=100.0)]
        #[source(structural)]
        border_px: f64 = 0.5,
        /// Distance along which that way changes.
        #[range(1.0..=2000.0)]
        #[source(structural)]
        length_px: f64 = 16.0,
        /// Seed of the ways; each photo has its own.
        #[range(0..=1000000)]
        #[chance(seed)]
        #[source(structural)]
        seed: u32 = 1,
    }
}

stage::inputs! {
    /// Silhouettes.
    pub struct JitterInput {
        /// The silhouettes.
        masks: Arc<Masks>,
    }
}

/// `synth.jitter`: masks → masks.
pub struct JitterMasks;

impl Stage for JitterMasks {
    const NAME: &'static str = "synth.jitter";
    const VERSION: u32 = 1;
    const ABOUT: &'static str = "Moves the borders of silhouettes by chance, smoothly: the errors of masks, as large as they are asked for.";
    type Params = JitterParams;
    type Input = JitterInput;
    type Output = Masks;

    fn run(p: &JitterParams, input: JitterInput, ctx: &Ctx<'_>) -> Result<Masks, Stop> {
        let steps = ctx.steps("masks", input.masks.views.len());
        let one = |(id, mask): &(PhotoId, MaskRuns)| -> Result<(PhotoId, MaskRuns), Stop> {
            let moved = moved(&mask.pixels(), p, id.0);
            steps.tick()?;
            Ok((*id, moved.into()))
        };
        let masks = input.masks.views.as_slice().par_iter().map(one);
        let masks: Vec<_> = masks.collect::<Result<_, _>>()?;
        Ok(masks.into_iter().collect())
    }
}

/// A mask read where a smooth field of ways leads: drawn at the corners of a grid, cubic between them.
fn moved(mask: &Mask, p: &JitterParams, number: u32) -> Mask {
    let mut dice = Dice::new(p.seed, 0x6d61_0000 + number);
    let cells = |size: usize| (size as f64 / p.length_px).ceil() as usize + 1;
    let (wide, high) = (cells(mask.width), cells(mask.height));
    let ways: Vec<[f64; 2]> = (0..wide * high)
        .map(|_| [dice.normal() * p.border_px, dice.normal() * p.border_px])
        .collect();
    let at = |x: usize, y: usize| {
        let place = |v: usize| {
            let v = v as f64 / p.length_px;
            let share = v.fract();
            // Smooth at the corners (Perlin 1985).
            (v as usize, share * share * (3.0 - 2.0 * share))
        };
        let ((i, u), (j, v)) = (place(x), place(y));
        let corner = |di: usize, dj: usize| ways[(j + dj) * wide + i + di];
        let mix = |k: usize| {
            let row = |dj: usize| corner(0, dj)[k] * (1.0 - u) + corner(1, dj)[k] * u;
            row(0) * (1.0 - v) + row(1) * v
        };
        [x as f64 + mix(0), y as f64 + mix(1)]
    };
    let mut out = Mask::filled(mask.width, mask.height, 0);
    for y in 0..mask.height {
        for x in 0..mask.width {
            *out.at_mut(x, y) = between(mask, at(x, y));
        }
    }
    out
}

/// What a mask shows between its pixels; beyond its edge what it shows there.
fn between(mask: &Mask, [x, y]: [f64; 2]) -> u8 {
    let most = |v: f64, size: usize| v.clamp(0.0, (size - 1) as f64);
    let (x, y) = (most(x, mask.width), most(y, mask.height));
    let (i, j) = (x as usize, y as usize);
    let (right, down) = ((i + 1).min(mask.width - 1), (j + 1).min(mask.height - 1));
    let (u, v) = (x - i as f64, y - j as f64);
    let level = |x: usize, y: usize| f64::from(mask.at(x, y));
    let row = |y: usize| level(i, y) * (1.0 - u) + level(right, y) * u;
    (row(j) * (1.0 - v) + row(down) * v).round() as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn borders_move_as_far_as_is_asked_and_nothing_else_does() {
        let mut half = Mask::filled(400, 400, 0);
        for y in 0..400 {
            (0..200).for_each(|x| *half.at_mut(x, y) = 255);
        }
        let run = |border_px: f64, seed: u32| {
            let p = JitterParams {
                border_px,
                seed,
                ..JitterParams::default()
            };
            moved(&half, &p, 0)
        };
        assert_eq!(run(0.0, 1), half);
        assert_eq!(run(3.0, 1), run(3.0, 1));
        assert_ne!(run(3.0, 1), run(3.0, 2), "each seed has its own");
        let out = run(3.0, 1);
        let place = |y: usize| {
            (0..400)
                .map(|x| f64::from(out.at(x, y)) / 255.0)
                .sum::<f64>()
        };
        let off: Vec<f64> = (0..400).map(|y| place(y) - 200.0).collect();
        let spread = (off.iter().map(|o| o * o).sum::<f64>() / 400.0).sqrt();
        // Between corners the field is a mean of theirs, so somewhat smaller than at them.
        assert!((1.5..3.6).contains(&spread), "{spread}");
        assert!((0..400).all(|y| out.at(100, y) == 255 && out.at(300, y) == 0));
    }
}
