//! What a phone makes of light: exposure, levels, noise taken out, halos laid along edges.

use crate::noise::chance;
use crate::phone::lens::Linear;
use shape::Image;

/// Levels before they are rounded, 0 to 255.
pub(crate) type Levels = Image<[f32; 3]>;

/// Light as sRGB levels, exposed by so much in each channel, the corners darker by a share; what is
/// beyond white is lost.
pub(crate) fn levels(image: &Linear, gains: [f32; 3], vignetting: f32) -> Levels {
    let middle = [
        (image.width as f32 - 1.0) / 2.0,
        (image.height as f32 - 1.0) / 2.0,
    ];
    let corner = (middle[0] * middle[0] + middle[1] * middle[1]).max(1.0);
    let mut i = 0;
    image.map(|p| {
        let (x, y) = (
            (i % image.width) as f32 - middle[0],
            (i / image.width) as f32 - middle[1],
        );
        i += 1;
        let shade = 1.0 - vignetting * (x * x + y * y) / corner;
        [0, 1, 2].map(|c| shape::level_of_light((p[c] * gains[c] * shade).clamp(0.0, 1.0)))
    })
}

/// Adds noise of a standard deviation, another for each photo.
pub(crate) fn grained(image: &mut Levels, sigma: f32, seed: u32, number: u32) {
    let seed = seed.wrapping_mul(7919).wrapping_add(number);
    for (i, p) in image.data.iter_mut().enumerate() {
        for (c, v) in p.iter_mut().enumerate() {
            // Four even numbers make a nearly normal one, of variance 1/3.
            let four = (0..4).map(|k| chance([i as i32, c as i32, k], seed));
            *v += (four.sum::<f32>() - 2.0) * 3f32.sqrt() * sigma;
        }
    }
}

/// Half the side of the neighbourhood that is smoothed (structural: what a made phone does). \[px\]
const REACH_PX: i64 = 2;
/// Standard deviation of its weights (structural: what a made phone does). \[px\]
const WIDE_PX: f32 = 1.5;

/// Smoothed over neighbours of a like colour (bilateral: Tomasi and Manduchi 1998).
pub(crate) fn denoised(image: &Levels, like: f32) -> Levels {
    let (w, h) = (image.width as i64, image.height as i64);
    let mut out = image.clone();
    for y in 0..h {
        for x in 0..w {
            let here = image.at(x as usize, y as usize);
            let (mut sum, mut total) = ([0.0f32; 3], 0.0f32);
            for v in (y - REACH_PX).max(0)..=(y + REACH_PX).min(h - 1) {
                for u in (x - REACH_PX).max(0)..=(x + REACH_PX).min(w - 1) {
                    let p = image.at(u as usize, v as usize);
                    let far = ((u - x) * (u - x) + (v - y) * (v - y)) as f32;
                    let off: f32 = (0..3).map(|c| (p[c] - here[c]) * (p[c] - here[c])).sum();
                    let weight =
                        libm::expf(-far / (2.0 * WIDE_PX * WIDE_PX) - off / (6.0 * like * like));
                    (0..3).for_each(|c| sum[c] += weight * p[c]);
                    total += weight;
                }
            }
            *out.at_mut(x as usize, y as usize) = sum.map(|s| s / total);
        }
    }
    out
}

/// What a photo has more than its blurred self (1 px) is laid on once more, so many times.
pub(crate) fn sharpened(image: &Levels, strength: f32) -> Levels {
    let soft = crate::phone::lens::blurred(image, 1.0);
    let mut out = image.clone();
    for (to, soft) in out.data.iter_mut().zip(&soft.data) {
        (0..3).for_each(|c| to[c] += strength * (to[c] - soft[c]));
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::phone::lens::light;

    fn back(image: &Levels) -> Linear {
        light(&image.map(|p| p.map(|v| v.round() as u8)))
    }

    #[test]
    fn gains_and_vignetting_are_of_light() {
        let flat = Linear::filled(81, 61, [0.3; 3]);
        let tenth = libm::exp2f(0.1f32);
        let shown = back(&levels(&flat, [tenth, 1.0, 0.9], 0.38));
        let middle = shown.at(40, 30);
        for (c, gain) in [tenth, 1.0, 0.9].into_iter().enumerate() {
            assert!((middle[c] / 0.3 / gain - 1.0).abs() < 0.01, "{c}");
            assert!((shown.at(0, 0)[c] / middle[c] - 0.62).abs() < 0.01, "{c}");
        }
        let over = levels(&flat, [4.0; 3], 0.0);
        assert!(over.data.iter().all(|p| (p[0] - 255.0).abs() < 1e-3));
    }

    #[test]
    fn noise_goes_and_edges_stay_and_get_halos() {
        let mut edge = Levels::filled(80, 60, [60.0; 3]);
        for (i, p) in edge.data.iter_mut().enumerate() {
            *p = [if i % 80 < 40 { 60.0 } else { 160.0 }; 3];
        }
        let spread = |image: &Levels| {
            let some = (10..50).flat_map(|y| (5..35).map(move |x| image.at(x, y)[1] - 60.0));
            (some.map(|d| d * d).sum::<f32>() / 1200.0).sqrt()
        };
        let mut rough = edge.clone();
        grained(&mut rough, 3.0, 1, 1);
        assert!((spread(&rough) - 3.0).abs() < 0.2);
        let smooth = denoised(&rough, 12.0);
        assert!(spread(&smooth) < 1.2, "{}", spread(&smooth));
        assert!(smooth.at(39, 30)[1] < 66.0 && smooth.at(40, 30)[1] > 154.0);
        let sharp = sharpened(&edge, 0.5);
        assert!(sharp.at(39, 30)[1] < 55.0 && sharp.at(40, 30)[1] > 165.0);
        assert!((sharp.at(10, 30)[1] - 60.0).abs() < 1e-3);
    }
}
