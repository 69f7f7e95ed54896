//! Light of a photo's levels: what mixes in a pixel is light, and levels are not in proportion to it.

use shape::{Rgb, light_of_levels};

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
    pub(crate) fn at(&self, photo: &Rgb, x: usize, y: usize) -> [f32; 3] {
        photo.at(x, y).map(|level| self.of[usize::from(level)])
    }

    /// How much a pixel's light grows from level to level.
    pub(crate) fn slope_at(&self, photo: &Rgb, x: usize, y: usize) -> [f32; 3] {
        photo.at(x, y).map(|level| self.slope[usize::from(level)])
    }
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
