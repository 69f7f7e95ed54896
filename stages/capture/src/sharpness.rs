//! How sharp a photo is compared with other photos of the same scene.

use shape::Rgb;

/// Photos are looked at on about so many pixels across: finer is noise of the sensor. By hand: not on record. \[px\]
const ACROSS_PX: usize = 1000;
/// So many photos to each side give how sharp one should be. By hand: not on record.
const AROUND_PHOTOS: usize = 3;
/// A photo is blurred that is less sharp than this share of the middle one around it. By hand: not on record.
const BLURRED_SHARE: f64 = 0.45;

/// The places of blurred photos of a turn. Each is compared with those around it: a body shows more edges from one side
/// than from another.
pub(crate) fn blurred(sharp: &[f64]) -> Vec<usize> {
    let n = sharp.len();
    let around = |i: usize| {
        let near = (0..n).filter(|j| i.abs_diff(*j).min(n - i.abs_diff(*j)) <= AROUND_PHOTOS);
        shape::upper_median(near.map(|j| sharp[j])).unwrap_or_default()
    };
    let is = |i: &usize| sharp[*i] < BLURRED_SHARE * around(*i);
    (0..n).filter(is).collect()
}

/// Mean square of the Laplacian of brightness, against the variance of brightness, over the photo in
/// blocks of pixels: greater is sharper. 0 for a photo of one brightness.
///
/// Pech-Pacheco et al. 2000, "Diatom autofocusing in brightfield microscopy", made free of exposure.
pub fn sharpness(photo: &Rgb) -> f64 {
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
    let mut edges = 0.0;
    for y in 1..h.saturating_sub(1) {
        for x in 1..w.saturating_sub(1) {
            let at = y * w + x;
            let around = all[at - 1] + all[at + 1] + all[at - w] + all[at + w];
            edges += (around - 4.0 * all[at]).powi(2);
        }
    }
    match variance > 0.0 {
        true => edges / variance,
        false => 0.0,
    }
}

/// The sharpest of each of `most` even stretches, by place; all where there are no more than that.
pub fn best(sharp: &[f64], most: usize) -> Vec<usize> {
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
        let (sharp, blurred) = (sharpness(&checks(0)), sharpness(&checks(2)));
        assert!(blurred < 0.8 * sharp, "{blurred} {sharp}");
        let mut dim = checks(0);
        dim.data.iter_mut().for_each(|p| *p = p.map(|c| c / 2));
        proof::near(sharpness(&dim) / sharp, 1.0, 1e-3);
        assert_eq!(sharpness(&Rgb::filled(20, 20, [7; 3])), 0.0);
    }

    #[test]
    fn of_many_the_sharpest_of_each_stretch_is_taken() {
        let sharp = [1.0, 3.0, 2.0, 5.0, 5.0, 4.0];
        assert_eq!(best(&sharp, 3), [1, 3, 4]);
        assert_eq!(best(&sharp, 2), [1, 3]);
        assert_eq!(best(&sharp, 6), [0, 1, 2, 3, 4, 5]);
    }
}
