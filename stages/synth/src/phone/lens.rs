//! What lens, stabiliser and hand do to light: resampled, blurred, shaken.

use shape::{Image, Rgb, cubic_weights, light_of_levels};

/// Red, green, blue in proportion to light, 0 to 1.
pub(crate) type Linear = Image<[f32; 3]>;

/// Light of an sRGB photo.
pub(crate) fn light(photo: &Rgb) -> Linear {
    let table = light_of_levels();
    photo.map(|p| p.map(|v| table[usize::from(v)]))
}

/// The picture shifted right and down, red drawn out from the middle and blue drawn in, by so many
/// pixels at the corners (Catmull and Rom's cubic).
pub(crate) fn resampled(image: &Linear, shift: [f32; 2], lateral_px: f32) -> Linear {
    let (w, h) = (image.width, image.height);
    let middle = [(w as f32 - 1.0) / 2.0, (h as f32 - 1.0) / 2.0];
    let corner = libm::hypotf(middle[0], middle[1]).max(1.0);
    let scale = [1.0 + lateral_px / corner, 1.0, 1.0 - lateral_px / corner];
    let mut out = image.clone();
    for y in 0..h {
        for x in 0..w {
            let off = [x as f32 - middle[0], y as f32 - middle[1]];
            for c in 0..3 {
                let at = [0, 1].map(|i| off[i] / scale[c] + middle[i] - shift[i]);
                out.at_mut(x, y)[c] = cubic(image, at, c).max(0.0);
            }
        }
    }
    out
}

/// One channel between pixels.
fn cubic(image: &Linear, at: [f32; 2], channel: usize) -> f32 {
    let base = at.map(f32::floor);
    let [across, down] = [0, 1].map(|i| cubic_weights(at[i] - base[i]));
    let inside = |v: f32, size: usize| v.clamp(0.0, (size - 1) as f32) as usize;
    let mut sum = 0.0;
    for (j, v) in down.iter().enumerate() {
        let row = image.row(inside(base[1] + j as f32 - 1.0, image.height));
        for (i, u) in across.iter().enumerate() {
            sum += u * v * row[inside(base[0] + i as f32 - 1.0, image.width)][channel];
        }
    }
    sum
}

/// The mean along a line through each pixel, as long as the hand moved. \[px\]
pub(crate) fn shaken(image: &Linear, along: [f32; 2]) -> Linear {
    let (w, h) = (image.width, image.height);
    let count = (2.0 * libm::hypotf(along[0], along[1])).ceil().max(1.0) as usize;
    let mut out = image.clone();
    for y in 0..h {
        for x in 0..w {
            let mut sum = [0.0; 3];
            for k in 0..count {
                let t = (k as f32 + 0.5) / count as f32 - 0.5;
                let at = [x as f32 + t * along[0], y as f32 + t * along[1]];
                (0..3).for_each(|c| sum[c] += cubic(image, at, c));
            }
            *out.at_mut(x, y) = sum.map(|s| (s / count as f32).max(0.0));
        }
    }
    out
}

/// Blurred by a normal distribution. \[px\]
pub(crate) fn blurred(image: &Linear, sigma: f32) -> Linear {
    let reach = (3.0 * sigma).ceil() as i64;
    let weight = |d: i64| libm::expf(-(d * d) as f32 / (2.0 * sigma * sigma));
    let total: f32 = (-reach..=reach).map(weight).sum();
    let weights: Vec<f32> = (-reach..=reach).map(|d| weight(d) / total).collect();
    let (w, h) = (image.width as i64, image.height as i64);
    let along = |from: &Linear, step: [i64; 2]| {
        let mut out = from.clone();
        for y in 0..h {
            for x in 0..w {
                let mut sum = [0.0; 3];
                for (k, weight) in weights.iter().enumerate() {
                    let d = k as i64 - reach;
                    let (u, v) = (x + d * step[0], y + d * step[1]);
                    let p = from.at(u.clamp(0, w - 1) as usize, v.clamp(0, h - 1) as usize);
                    (0..3).for_each(|c| sum[c] += weight * p[c]);
                }
                *out.at_mut(x as usize, y as usize) = sum;
            }
        }
        out
    };
    along(&along(image, [1, 0]), [0, 1])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A soft ball of light in each channel.
    fn ball(at: [f32; 2], sigma: f32) -> Linear {
        let mut image = Linear::filled(81, 61, [0.0; 3]);
        for (i, p) in image.data.iter_mut().enumerate() {
            let (dx, dy) = ((i % 81) as f32 - at[0], (i / 81) as f32 - at[1]);
            *p = [libm::expf(-(dx * dx + dy * dy) / (2.0 * sigma * sigma)); 3];
        }
        image
    }

    /// Middle and variances of a channel's light. \[px, px²\]
    fn moments(image: &Linear, c: usize) -> ([f64; 2], [f64; 2]) {
        let (mut sum, mut first, mut second) = (0.0, [0.0; 2], [0.0; 2]);
        for (i, p) in image.data.iter().enumerate() {
            let (at, v) = ([(i % 81) as f64, (i / 81) as f64], f64::from(p[c]));
            sum += v;
            (0..2).for_each(|a| {
                first[a] += v * at[a];
                second[a] += v * at[a] * at[a];
            });
        }
        let mean = first.map(|f| f / sum);
        (mean, [0, 1].map(|a| second[a] / sum - mean[a] * mean[a]))
    }

    #[test]
    fn a_shift_is_as_large_as_given() {
        let moved = resampled(&ball([40.0, 30.0], 3.0), [0.6, -0.3], 0.0);
        for c in 0..3 {
            let (at, _) = moments(&moved, c);
            assert!(
                (at[0] - 40.6).abs() < 0.01 && (at[1] - 29.7).abs() < 0.01,
                "{at:?}"
            );
        }
    }

    #[test]
    fn red_is_outside_of_green_and_blue_inside() {
        // 30 of 50 pixels from the middle to the corner.
        let moved = resampled(&ball([64.0, 48.0], 3.0), [0.0; 2], 0.5);
        let away = |c: usize| {
            let (at, _) = moments(&moved, c);
            libm::hypot(at[0] - 40.0, at[1] - 30.0)
        };
        let [red, green, blue] = [0, 1, 2].map(away);
        assert!((red - green - 0.3).abs() < 0.01, "{red} {green}");
        assert!((green - blue - 0.3).abs() < 0.01, "{blue} {green}");
    }

    #[test]
    fn blur_and_shake_add_their_variances() {
        let image = ball([40.0, 30.0], 3.0);
        let (_, soft) = moments(&blurred(&image, 1.3), 1);
        proof::near(soft[0], 9.0 + 1.69, 0.02);
        let (_, drawn) = moments(&shaken(&image, [6.0, 0.0]), 1);
        // Of twelve places along the line, whose ends are half a place within.
        proof::near(drawn[0] - 9.0, 36.0 / 12.0 * (1.0 - 1.0 / 144.0), 0.02);
        proof::near(drawn[1], 9.0, 0.02);
    }

    #[test]
    fn light_is_that_of_srgb_levels() {
        let photo = Rgb {
            width: 3,
            height: 1,
            data: vec![[0; 3], [188; 3], [255; 3]],
        };
        let light = light(&photo);
        assert_eq!(light.data[0], [0.0; 3]);
        assert!((light.data[1][0] - 0.5029).abs() < 1e-3);
        assert_eq!(light.data[2], [1.0; 3]);
    }
}
