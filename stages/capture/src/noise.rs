//! How much noise photos have: what differs between two pictures where nothing moved.

use crate::glance::Together;
use crate::ordered::in_order;
use crate::verdict::{Finding, Grade, camera_is_fixed};
use rayon::prelude::*;
use shape::{Photo, PhotoError, Photos, Rgb};
use stage::message;

stage::messages! {
    NOISE = "find-noise": "the photos have noise of {levels:.1} grey levels";
    LESS_NOISE = "find-noise-mend": "masks may lose parts where clothes have the background's colour: take them in more light, at a lower ISO, or in clothes that differ more from the background";
}

/// Pictures are looked at in squares of so many pixels across (structural: samples). \[px\]
const SQUARE: usize = 16;
/// Squares with a pixel at or beyond these hold less noise than there was (structural: the ends of what a file holds,
/// and two levels). \[levels\]
const CLIPPED_LEVELS: (u8, u8) = (2, 253);
/// The noise is that of the square at this share of all, from the quietest on: the subject and its shadow cover less
/// than the rest of them (structural: any share that is still).
const QUIET_SHARE: f64 = 0.4;
/// So many photos, evenly over the turn, are looked at (structural: samples).
const LOOKED_AT: usize = 6;
/// Photos are noisy from here on. \[levels\] By hand: looked at the sample with noise added: girths of version 0.2.0
/// were right up to 3.1 levels; at 4.2 masks lost strips of a white shirt before a grey wall and waists were up to 3.9
/// % too small.
const NOISY_LEVELS: f64 = 3.0;

/// What photos were compared with.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Against {
    /// The photo of the empty scene.
    Plate,
    /// The next photo.
    Neighbours,
}

/// The noise of one of two pictures of a scene that have as much of it: the standard deviation of a colour, in each
/// square about the square's own mean, so that neither exposure nor shadows count. \[levels\]
/// `None` where sizes differ, or nothing is between black and white.
pub fn noise(a: &Rgb, b: &Rgb) -> Option<f64> {
    if (a.width, a.height) != (b.width, b.height) {
        return None;
    }
    let across = a.width / SQUARE;
    let squares = (0..across * (a.height / SQUARE)).filter_map(|k| {
        let corner = [k % across, k / across].map(|n| n * SQUARE);
        square(a, b, corner)
    });
    let mut variances: Vec<f64> = squares.collect();
    variances.sort_by(f64::total_cmp);
    let at = (QUIET_SHARE * variances.len() as f64) as usize;
    // The difference of two has twice the variance of one.
    variances.get(at).map(|v| (v / 2.0).sqrt())
}

/// Variance of what two pictures differ by in a square, the mean of the colours'.
fn square(a: &Rgb, b: &Rgb, [left, top]: [usize; 2]) -> Option<f64> {
    let (mut sums, mut squares) = ([0i64; 3], 0i64);
    for (x, y) in (0..SQUARE * SQUARE).map(|k| (left + k % SQUARE, top + k / SQUARE)) {
        for (c, (one, other)) in a.at(x, y).into_iter().zip(b.at(x, y)).enumerate() {
            let (low, high) = (one.min(other), one.max(other));
            if low <= CLIPPED_LEVELS.0 || high >= CLIPPED_LEVELS.1 {
                return None;
            }
            let differs = i64::from(one) - i64::from(other);
            sums[c] += differs;
            squares += differs * differs;
        }
    }
    let n = (SQUARE * SQUARE) as f64;
    let of_means: f64 = sums.iter().map(|s| (*s as f64).powi(2) / n).sum();
    Some((squares as f64 - of_means) / (3.0 * (n - 1.0)))
}

/// The noise of the photos of a camera that did not move: the middle one of a few. \[levels\]
pub(crate) fn of_photos(
    photos: &Photos,
    together: &Together,
) -> Result<Option<(f64, Against)>, PhotoError> {
    if !camera_is_fixed(together) {
        return Ok(None);
    }
    let all = &photos.photos;
    let count = LOOKED_AT.min(all.len());
    let plate = photos.plate.as_ref().map(Photo::decode).transpose()?;
    let (other, against) = match &plate {
        Some(plate) => (Some(plate), Against::Plate),
        None => (None, Against::Neighbours),
    };
    let one = |k: usize| -> Result<Option<f64>, PhotoError> {
        let i = k * all.len() / count;
        let photo = all[i].decode()?;
        match other {
            Some(plate) => Ok(noise(&photo, plate)),
            None => Ok(noise(&photo, &all[(i + 1) % all.len()].decode()?)),
        }
    };
    let found = in_order((0..count).into_par_iter().map(one))?;
    Ok(shape::upper_median(found.into_iter().flatten()).map(|levels| (levels, against)))
}

/// What is odd about so much noise.
pub(crate) fn noisy(levels: f64) -> Option<Finding> {
    (levels >= NOISY_LEVELS).then(|| Finding {
        grade: Grade::Doubt,
        what: message!(NOISE, levels = levels),
        mend: message!(LESS_NOISE),
        photos: vec![],
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A graded wall with a subject before two fifths of it, a gain on all, noise of one's own.
    fn made(seed: u64, subject: usize, gain: f64, levels: f64) -> Rgb {
        let mut dice = proof::Dice(seed);
        let (width, height) = (320, 240);
        let data = (0..width * height).map(|i| {
            let (x, y) = (i % width, i / width);
            let stripe = 25 * ((x * 3 + y * 5 + subject * 7) / 4 % 4);
            let wall = match (subject..subject + 110).contains(&x) {
                true => 60 + stripe,
                false => 90 + x / 8 + y / 8,
            };
            [0; 3].map(|_| (wall as f64 * gain + levels * dice.normal()).round() as u8)
        });
        Rgb {
            width,
            height,
            data: data.collect(),
        }
    }

    #[test]
    fn made_noise_is_found_beside_a_subject_and_in_another_exposure() {
        // What a camera rounds off is noise, too.
        let rounded = |levels: f64| (levels * levels + 1.0 / 12.0).sqrt();
        for levels in [1.0, 2.0, 4.0, 8.0] {
            let empty = made(1, 500, 1.0, levels);
            let seen = noise(&made(2, 60, 1.03, levels), &empty).unwrap();
            proof::near(seen / rounded(levels), 1.0, 0.05);
            let next = noise(&made(2, 60, 1.0, levels), &made(3, 75, 1.0, levels)).unwrap();
            proof::near(next / rounded(levels), 1.0, 0.05);
        }
        assert_eq!(
            noise(&made(1, 60, 1.0, 0.0), &made(1, 60, 1.0, 0.0)),
            Some(0.0)
        );
    }

    #[test]
    fn what_is_clipped_or_of_another_size_gives_no_noise() {
        let white = Rgb::filled(64, 64, [255; 3]);
        assert_eq!(noise(&white, &white), None);
        let [a, b] = [64, 48].map(|width| Rgb::filled(width, 64, [90; 3]));
        assert_eq!(noise(&a, &b), None);
        assert_eq!(noise(&a, &a), Some(0.0));
    }

    #[test]
    fn noise_is_odd_from_three_levels_on() {
        assert_eq!(noisy(2.99), None);
        assert!(noisy(3.0).unwrap().what.contains("3.0"));
    }
}
