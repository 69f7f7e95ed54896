//! The stage that draws a part of a turn's photos by chance, or begins it elsewhere.

use shape::Photos;
use stage::{Ctx, Stage, Stop};
use std::sync::Arc;

stage::params! {
    /// What is left to chance.
    pub struct DrawParams {
        /// How many photos are drawn, in turning order; 0 for all.
        #[range(0..=5000)]
        #[source(structural)]
        keep: u32 = 0,
        /// Whether the turn begins at a photo by chance instead of the first.
        begin: bool = false,
        /// Whether the photos come in an order by chance instead of the turn's.
        shuffle: bool = false,
        /// Seed of what is drawn.
        #[range(0..=1000000)]
        #[chance(seed)]
        #[source(structural)]
        seed: u32 = 1,
    }
}

stage::inputs! {
    /// Photos of a turn.
    pub struct DrawInput {
        /// The photos.
        photos: Arc<Photos>,
    }
}

/// More is to be drawn than there is.
#[derive(Debug, thiserror::Error)]
#[error("{keep} photos are to be drawn of {of}: set `keep` up to {of}")]
pub(crate) struct TooFew {
    keep: u32,
    of: usize,
}

/// `capture.draw`: photos → photos.
pub struct Draw;

impl Stage for Draw {
    const NAME: &'static str = "capture.draw";
    const VERSION: u32 = 1;
    const ABOUT: &'static str = "Draws some of a turn's photos by chance, begins the turn elsewhere, or shuffles it: what replicates of a method may vary.";
    type Params = DrawParams;
    type Input = DrawInput;
    type Output = Photos;
    const METRICS: &'static [&'static str] = &["photos"];

    fn run(p: &DrawParams, input: DrawInput, ctx: &Ctx<'_>) -> Result<Photos, Stop> {
        let of = input.photos.photos.len();
        if p.keep as usize > of {
            return Err(TooFew { keep: p.keep, of }.into());
        }
        let mut photos = (*input.photos).clone();
        let kept = drawn(p, of);
        // Equal steps are left only where all photos are, one after the other.
        if kept.len() < of || p.shuffle {
            photos.rig.step = None;
        }
        photos.photos = kept
            .into_iter()
            .map(|i| input.photos.photos[i].clone())
            .collect();
        ctx.metric("photos", photos.photos.len() as f64, "");
        Ok(photos)
    }
}

/// Which photos, in which order.
fn drawn(p: &DrawParams, of: usize) -> Vec<usize> {
    // SplitMix64 (Steele, Lea and Flood 2014).
    let mut state = u64::from(p.seed);
    let mut below = |n: usize| {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) % n.max(1) as u64) as usize
    };
    let mut order: Vec<usize> = (0..of).collect();
    for i in (1..of).rev() {
        order.swap(i, below(i + 1));
    }
    let keep = if p.keep == 0 { of } else { p.keep as usize };
    let mut kept = order[..keep].to_vec();
    if !p.shuffle {
        kept.sort_unstable();
        let first = below(kept.len());
        if p.begin {
            kept.rotate_left(first);
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_draw_is_a_part_in_turning_order_by_its_seed() {
        let part = |keep: u32, begin: bool, shuffle: bool, seed: u32| {
            let p = DrawParams {
                keep,
                begin,
                shuffle,
                seed,
            };
            drawn(&p, 18)
        };
        assert_eq!(part(0, false, false, 1), (0..18).collect::<Vec<_>>());
        let twelve = part(12, false, false, 1);
        assert!(twelve.len() == 12 && twelve.windows(2).all(|w| w[0] < w[1]));
        assert_ne!(twelve, part(12, false, false, 2));
        assert_eq!(twelve, part(12, false, false, 1));
        let turned = part(0, true, false, 3);
        let falls = turned.windows(2).filter(|w| w[0] > w[1]).count();
        assert_eq!((turned.len(), falls), (18, 1), "one turn, begun elsewhere");
        let mut mixed = part(0, false, true, 1);
        assert_ne!(mixed, (0..18).collect::<Vec<_>>());
        mixed.sort_unstable();
        assert_eq!(mixed, (0..18).collect::<Vec<_>>());
    }
}
