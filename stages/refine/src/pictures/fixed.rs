//! Images of numbers in sixteen bits: half of what they take as floats, and as near as they need to be.

use shape::{Gray, Image};

/// Numbers in whole steps of [`STEP`].
pub type Fixed = Image<i16>;

/// One step (structural: 255 grey levels fit, and distances up to 256 pixels; rounding leaves a deviation of 0.002, a
/// hundredth of the least noise and of an outline's deviation). \[grey levels or px\]
pub const STEP: f32 = 1.0 / 128.0;

/// A number in whole steps, the nearest that there is.
#[inline]
pub fn to_steps(value: f32) -> i16 {
    whole(value / STEP)
}

/// So many steps, rounded.
#[inline]
pub fn whole(steps: f32) -> i16 {
    (steps + 0.5f32.copysign(steps)) as i16
}

/// An image's numbers in whole steps.
pub fn fixed(image: &Gray) -> Fixed {
    image.map(|value| to_steps(*value))
}

/// The number between pixels, bilinear; outside, that of the nearest border pixel.
#[inline]
pub fn sample(image: &Fixed, x: f32, y: f32) -> f32 {
    image.sample(x, y) * STEP
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_comes_back_within_half_a_step_and_stays_at_the_ends_beyond_them() {
        for k in -2550..=2550 {
            let value = k as f32 * 0.1;
            let back = f32::from(to_steps(value)) * STEP;
            assert!((back - value).abs() <= 0.5 * STEP, "{value} {back}");
        }
        assert_eq!([to_steps(1e6), to_steps(-1e6)], [i16::MAX, i16::MIN]);
    }

    #[test]
    fn between_pixels_it_reads_as_floats_do() {
        let image = Gray {
            width: 2,
            height: 2,
            data: vec![0.0, 255.0, -40.0, 8.5],
        };
        for (x, y) in [(0.0, 0.0), (0.25, 0.5), (1.0, 0.75), (3.0, -1.0)] {
            assert!((sample(&fixed(&image), x, y) - image.sample(x, y)).abs() <= STEP);
        }
    }
}
