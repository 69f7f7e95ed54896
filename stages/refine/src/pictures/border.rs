//! How sure a silhouette's border is, by how little its photo shows of it.

use crate::pictures::pinhole::{pinhole, straightened};
use shape::{Gray, HIDDEN, Intrinsics, Outline, SHOWN};
use std::sync::Arc;

/// How little a photo shows of its silhouette's border.
#[derive(Clone)]
pub struct Border {
    /// 0 where colours along the border differ much, 1 where they are alike: near each pixel of the whole photo, reduced and
    /// without distortion.
    hidden: Arc<Gray>,
    /// Width and height of the whole photo at this level. \[px\]
    whole: [usize; 2],
    /// How tall the body is. \[px of this level\]
    height: f64,
}

impl Border {
    /// Of a photo with this lens, `whole` pixels wide and high at its level.
    pub(crate) fn of(outline: &Outline, lens: &Intrinsics, whole: [usize; 2]) -> Border {
        let [width, height] = outline.size;
        let from = lens.resized(width as u32, height as u32);
        let (hidden, to) = (outline.hidden_near(), pinhole(lens, outline.size));
        let hidden = straightened(&hidden, &from, &to, |hidden| hidden);
        Border {
            hidden: Arc::new(hidden),
            whole,
            height: outline.height() * whole[0] as f64 / width as f64,
        }
    }

    /// Standard deviation of the border near a pixel of the whole photo. \[px of this level\]
    pub fn sigma_px(&self, at: [f64; 2]) -> f64 {
        let reduced = |i: usize, size: usize| {
            let by = size as f64 / self.whole[i] as f64;
            ((at[i] + 0.5) * by - 0.5) as f32
        };
        let hidden = &self.hidden;
        let share = hidden.sample(reduced(0, hidden.width), reduced(1, hidden.height));
        self.height * libm::sqrt(SHOWN * SHOWN + f64::from(share) * HIDDEN * HIDDEN)
    }
}
