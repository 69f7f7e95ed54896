//! Local tones: what surroundings differ by from the whole picture is taken back in part, as phones do of dark and bright parts.
//!
//! Of the logarithm of a level its surroundings' is a base, whose contrast is reduced (Durand and Dorsey 2002; by a normal
//! density here, so that a halo is around what is dark).

use crate::phone::finish::Levels;
use crate::phone::lens::blurred;
use shape::{Gray, Image};

/// Pixels along a side that are one of the base (structural: it decides time, for a base is far wider). \[px\]
const BLOCK: usize = 8;
/// What is added to levels, so that black has a logarithm (structural: what a made phone does).
const BLACK_LEVELS: f32 = 8.0;

/// A picture of which a share of what surroundings differ by, `reach` pixels wide, is taken back.
pub(crate) fn toned(image: &Levels, share: f32, reach: f32) -> Levels {
    let (wide, tall) = (image.width.div_ceil(BLOCK), image.height.div_ceil(BLOCK));
    let mut small = Image::filled(wide, tall, [0.0f32; 3]);
    let mut counts = vec![0.0f32; wide * tall];
    for (i, p) in image.data.iter().enumerate() {
        let block = i / image.width / BLOCK * wide + i % image.width / BLOCK;
        let bright = p.iter().sum::<f32>() / 3.0;
        small.data[block][0] += libm::logf(bright.max(0.0) + BLACK_LEVELS);
        counts[block] += 1.0;
    }
    let both = small.data.iter_mut().zip(&counts);
    both.for_each(|(sum, count)| sum[0] /= count);
    let mean = small.data.iter().map(|p| p[0]).sum::<f32>() / small.data.len() as f32;
    let base = Gray {
        width: wide,
        height: tall,
        data: blurred(&small, reach / BLOCK as f32)
            .data
            .iter()
            .map(|p| p[0])
            .collect(),
    };
    let mut out = image.clone();
    for (i, p) in out.data.iter_mut().enumerate() {
        let place = |v: usize| (v as f32 + 0.5) / BLOCK as f32 - 0.5;
        let at = base.sample(place(i % image.width), place(i / image.width));
        let times = libm::expf(share * (mean - at));
        *p = p.map(|v| (v + BLACK_LEVELS) * times - BLACK_LEVELS);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_around_a_dark_part_becomes_brighter_by_a_share_of_what_it_differs_by() {
        let flat = Levels::filled(160, 120, [150.0; 3]);
        let same = toned(&flat, 0.5, 10.0);
        assert!(same.data.iter().all(|p| (p[0] - 150.0).abs() < 0.01));
        // Half of it is dark: at the edge the base is midway, far from it that of the half.
        let mut halves = flat.clone();
        for (i, p) in halves.data.iter_mut().enumerate() {
            *p = [if i % 160 < 80 { 150.0 } else { 40.0 }; 3];
        }
        let ratio = libm::logf((150.0 + BLACK_LEVELS) / (40.0 + BLACK_LEVELS));
        let shown = toned(&halves, 0.5, 10.0);
        let times = |x: usize| {
            let level = |image: &Levels| image.at(x, 60)[1] + BLACK_LEVELS;
            libm::logf(level(&shown) / level(&halves))
        };
        assert!((times(20) + 0.25 * ratio).abs() < 0.01, "{}", times(20));
        assert!(times(79).abs() < 0.03, "{}", times(79));
        assert!((times(140) - 0.25 * ratio).abs() < 0.01, "{}", times(140));
    }
}
