//! How sharp a photo is compared with other photos of the same scene.

use shape::Rgb;

/// Photos are looked at on about so many pixels across: finer is noise of the sensor. By hand: not on record. \[px\]
const ACROSS_PX: usize = 1000;
/// So many photos to each side give how sharp one should be. By hand: not on record.
const AROUND_PHOTOS: usize = 3;
/// A photo is blurred that is less sharp than this share of the middle one around it. By hand: not on record.
const BLURRED_SHARE: f64 = 0.45;

/// How sharp a photo is along its rows, its columns and both diagonals: a camera that is knocked blurs along one of
/// them.
pub(crate) type Sharpness = [f64; 4];

/// The places of blurred photos of a turn. Each is compared with those around it, direction by direction: a body shows
/// more edges from one side than from another.
pub(crate) fn blurred<const N: usize>(sharp: &[[f64; N]]) -> Vec<usize> {
    let n = sharp.len();
    let around = |i: usize, k: usize| {
        let near = (0..n).filter(|j| i.abs_diff(*j).min(n - i.abs_diff(*j)) <= AROUND_PHOTOS);
        shape::upper_median(near.map(|j| sharp[j][k])).unwrap_or_default()
    };
    let is = |i: &usize| (0..N).any(|k| sharp[*i][k] < BLURRED_SHARE * around(*i, k));
    (0..n).filter(is).collect()
}

/// How sharp each photo is against the middle of all, in the direction in which it is least.
pub(crate) fn against_the_middle(sharp: &[Sharpness]) -> Vec<f64> {
    let middle = |k: usize| shape::upper_median(sharp.iter().map(|s| s[k]));
    let middle: Vec<f64> = (0..4)
        .map(|k| middle(k).map_or(1.0, |m| m.max(1e-12)))
        .collect();
    let least = |s: &Sharpness| {
        s.iter()
            .zip(&middle)
            .map(|(s, m)| s / m)
            .fold(f64::MAX, f64::min)
    };
    sharp.iter().map(least).collect()
}

/// Mean square of the second difference of brightness along each direction, against the variance of brightness, over
/// the photo in blocks of pixels: greater is sharper. 0 for a photo of one brightness.
///
/// The terms of the Laplacian of Pech-Pacheco et al. 2000, "Diatom autofocusing in brightfield microscopy", apart and
/// made free of exposure.
pub(crate) fn sharpness(photo: &Rgb) -> Sharpness {
    let block = (photo.width / ACROSS_PX).max(1);
    let (w, h) = (photo.width / block, photo.height / block);
    let light = |x: usize, y: usize| -> f64 {
        let mut sum = 0u32;
        for j in y * block..(y + 1) * block {
            for i in x * block..(x + 1) * block {
                sum += photo.at(i, j).iter().map(|c| u32::from(*c)).sum::<u32>();
            }
        }
        f64::from(sum) / (3 * block * block) as f64
    };
    let all: Vec<f64> = (0..h)
        .flat_map(|y| (0..w).map(move |x| (x, y)))
        .map(|(x, y)| light(x, y))
        .collect();
    let mean = all.iter().sum::<f64>() / all.len().max(1) as f64;
    let variance: f64 = all.iter().map(|v| (v - mean).powi(2)).sum();
    let mut edges = [0.0; 4];
    for y in 1..h.saturating_sub(1) {
        for x in 1..w.saturating_sub(1) {
            let at = y * w + x;
            for (sum, step) in edges.iter_mut().zip([1, w, w + 1, w - 1]) {
                *sum += (all[at - step] + all[at + step] - 2.0 * all[at]).powi(2);
            }
        }
    }
    match variance > 0.0 {
        true => edges.map(|sum| sum / variance),
        false => [0.0; 4],
    }
}

/// The sharpest of each of `most` even stretches, by place; all where there are no more than that.
pub(crate) fn best(sharp: &[f64], most: usize) -> Vec<usize> {
    let stretch = |k: usize| k * sharp.len() / most..(k + 1) * sharp.len() / most;
    if sharp.len() <= most {
        return (0..sharp.len()).collect();
    }
    // The first of equals.
    let sharpest = |k: usize| {
        let places = stretch(k).rev();
        places.max_by(|a, b| sharp[*a].total_cmp(&sharp[*b]))
    };
    (0..most).filter_map(sharpest).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn checks(blur: usize) -> Rgb {
        let data = (0..120 * 90).map(|i| {
            let (x, y) = (i % 120, i / 120);
            let mut sum = 0;
            for dx in 0..=2 * blur {
                sum += usize::from(((x + dx) / 8 + y / 8) % 2 == 0);
            }
            [(40 + 160 * sum / (2 * blur + 1)) as u8; 3]
        });
        Rgb {
            width: 120,
            height: 90,
            data: data.collect(),
        }
    }

    #[test]
    fn a_blurred_photo_is_less_sharp_and_a_brighter_one_is_as_sharp() {
        // Along the rows alone, as by a camera that is knocked.
        let [along, across, ..] = sharpness(&checks(2));
        let sharp = sharpness(&checks(0));
        assert!(along < 0.5 * sharp[0], "{along} {sharp:?}");
        proof::near(across / sharp[1], 1.0, 0.1);
        let mut dim = checks(0);
        dim.data.iter_mut().for_each(|p| *p = p.map(|c| c / 2));
        proof::near(sharpness(&dim)[0] / sharp[0], 1.0, 1e-3);
        assert_eq!(sharpness(&Rgb::filled(20, 20, [7; 3])), [0.0; 4]);
    }

    #[test]
    fn a_photo_that_is_blurred_one_way_is_named() {
        let mut sharp = vec![[1.0, 2.0, 3.0, 4.0]; 9];
        sharp[4][0] = 0.2;
        assert_eq!(blurred(&sharp), [4]);
        let least = against_the_middle(&sharp);
        assert_eq!((least[4], least[0]), (0.2, 1.0));
    }

    #[test]
    fn of_many_the_sharpest_of_each_stretch_is_taken() {
        let sharp = [1.0, 3.0, 2.0, 5.0, 5.0, 4.0];
        assert_eq!(best(&sharp, 3), [1, 3, 4]);
        assert_eq!(best(&sharp, 2), [1, 3]);
        assert_eq!(best(&sharp, 6), [0, 1, 2, 3, 4, 5]);
    }
}
