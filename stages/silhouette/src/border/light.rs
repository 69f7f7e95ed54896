//! Light of a photo's levels: what mixes in a pixel is light, and levels are not in proportion to it.
//!
//! A pixel on the border is `I = a F + (1 - a) B` of the body's light F and the background's B (Porter and Duff 1984).

use shape::{Rgb, light_of_levels};

/// Light, red, green and blue.
pub(crate) type Shown = [f32; 3];

/// Light of each level, and how much it grows from level to level there.
pub(crate) struct Light {
    of: [f32; 256],
    slope: [f32; 256],
}

impl Light {
    /// Of sRGB levels (IEC 61966-2-1).
    pub(crate) fn of_levels() -> Self {
        let of = light_of_levels();
        let slope = std::array::from_fn(|level| {
            let (below, above) = (level.saturating_sub(1), (level + 1).min(255));
            (of[above] - of[below]) / (above - below) as f32
        });
        Light { of, slope }
    }

    /// Of a pixel, red, green, blue.
    pub(crate) fn at(&self, photo: &Rgb, x: usize, y: usize) -> Shown {
        photo.at(x, y).map(|level| self.of[usize::from(level)])
    }

    /// How much a pixel's light grows from level to level.
    pub(crate) fn slope_at(&self, photo: &Rgb, x: usize, y: usize) -> Shown {
        photo.at(x, y).map(|level| self.slope[usize::from(level)])
    }

    /// A pixel as a mixture of the body's light and the background's.
    pub(crate) fn mixing(
        &self,
        photo: &Rgb,
        [x, y]: [usize; 2],
        body: Shown,
        ground: Shown,
    ) -> Mixing {
        let (shown, slope) = (self.at(photo, x, y), self.slope_at(photo, x, y));
        // Noise is even in levels: so many of them, as they are at this pixel.
        let step: Shown = std::array::from_fn(|c| (body[c] - ground[c]) / slope[c]);
        let off: Shown = std::array::from_fn(|c| (shown[c] - ground[c]) / slope[c]);
        let dot = |a: Shown, b: Shown| (0..3).map(|c| a[c] * b[c]).sum::<f32>();
        let apart = dot(step, step);
        let share = (dot(off, step) / apart.max(1.0)).clamp(0.0, 1.0);
        let rest: Shown = std::array::from_fn(|c| off[c] - share * step[c]);
        Mixing {
            share,
            apart,
            off: dot(rest, rest),
        }
    }
}

/// The mean of light.
#[derive(Default)]
pub(crate) struct Mean {
    sum: Shown,
    count: f32,
}

impl Mean {
    pub(crate) fn add(&mut self, light: Shown) {
        (0..3).for_each(|c| self.sum[c] += light[c]);
        self.count += 1.0;
    }

    /// [`None`] of nothing.
    pub(crate) fn mean(&self) -> Option<Shown> {
        (self.count > 0.0).then(|| self.sum.map(|c| c / self.count))
    }
}

/// How a pixel is mixed of body and background.
pub(crate) struct Mixing {
    /// How much of it is body, 0 to 1.
    pub(crate) share: f32,
    /// How far apart body and background are, squared. \[levels²\]
    pub(crate) apart: f32,
    /// How far the pixel is off what that share makes of them, squared. \[levels²\]
    pub(crate) off: f32,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_the_light_is_level_188_and_grows_fastest_where_it_is_bright() {
        let light = Light::of_levels();
        let mut photo = Rgb::filled(2, 1, [188, 0, 255]);
        *photo.at_mut(1, 0) = [20, 128, 255];
        let [half, none, all] = light.at(&photo, 0, 0);
        assert!((half - 0.5029).abs() < 1e-3 && none == 0.0 && all == 1.0);
        let [dark, middle, bright] = light.slope_at(&photo, 1, 0);
        assert!(0.0 < dark && dark < middle && middle < bright);
    }
}
