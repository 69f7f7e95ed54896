//! Where photos of a turn show what turns: features there determine the cameras, those of a still
//! background do not.

use rayon::prelude::*;
use shape::{Gray, Image, Photo, PhotoError, Photos, QUIET_SHARE, QUIET_SIGMAS, registered};

/// Size to which photos are reduced (structural: a region's border is then known to a 400th of the photo, an eighth of
/// what `JOINED_SHARE` adds to it). \[px\]
const LONGEST_PX: usize = 400;
/// A pixel changes where it differs by more than so many standard deviations of the noise, and levels. By hand: looked
/// at two captures: the first halved, nothing changes; the first doubled, size +0.06 % for one; the second halved, size
/// +0.06 % for one; the second doubled, size +0.12 % for one (docs/lab/numbers.md).
const CHANGES_BEYOND: (f32, f32) = (5.0, 6.0);
/// Reach to which what changes is joined, as a share of the longer side. By hand: looked at two captures: halved,
/// rotations +0.02° for one; doubled, size −0.08 % for one (docs/lab/numbers.md).
const JOINED_SHARE: f64 = 0.02;
/// Longest gap in a row that is closed, as a share of the longer side. By hand: looked at two captures, halved and
/// doubled: no more than chance (docs/lab/numbers.md).
const GAP_SHARE: f64 = 0.15;
/// Shares of a photo that may change: less is noise, more is a camera that moved. By hand: looked at two captures: the
/// first halved, doubled and 0, nothing changes; the second halved, rotations +0.26° for one; the second doubled,
/// nothing changes (docs/lab/numbers.md).
const CHANGING_SHARES: std::ops::RangeInclusive<f64> = 0.01..=0.6;

/// What of each photo turns, reduced; `None` where nothing is still, or nothing turns.
pub(crate) fn moving(photos: &Photos) -> Result<Option<Vec<Image<bool>>>, PhotoError> {
    let small = |photo: &Photo| {
        let by = (photo.width.max(photo.height) as usize / LONGEST_PX).max(1);
        Ok(photo.decode()?.gray().reduced(by))
    };
    let smalls: Vec<Gray> = photos
        .photos
        .par_iter()
        .map(small)
        .collect::<Result<_, _>>()?;
    Ok(regions(&smalls))
}

/// The same of reduced photos.
fn regions(smalls: &[Gray]) -> Option<Vec<Image<bool>>> {
    let (placed, still) = registered(smalls);
    let still = still?;
    let placed: Vec<_> = placed.into_iter().collect::<Option<_>>()?;
    let changes: Vec<Image<bool>> = smalls
        .par_iter()
        .zip(&placed)
        .map(|(small, placed)| {
            let there = placed.brought_gray(small);
            let off = there.data.iter().zip(&still.data);
            let off: Vec<f32> = off.map(|(a, b)| (placed.levelled(*a) - b).abs()).collect();
            let mut sorted = off.clone();
            let quiet = (off.len() as f64 * QUIET_SHARE) as usize;
            let (_, quiet, _) = sorted.select_nth_unstable_by(quiet, f32::total_cmp);
            let least = (CHANGES_BEYOND.0 * *quiet / QUIET_SIGMAS as f32).max(CHANGES_BEYOND.1);
            Image {
                width: still.width,
                height: still.height,
                data: off.iter().map(|d| *d > least).collect(),
            }
        })
        .collect();
    // What a quarter of the photos show otherwise than the middle one of all is swept by what turns.
    let often = |i: usize| 4 * changes.iter().filter(|c| c.data[i]).count() >= changes.len();
    let core: Vec<bool> = (0..still.data.len()).map(often).collect();
    let whole = |changes: &Image<bool>| {
        let data = changes.data.iter().zip(&core).map(|(a, b)| *a || *b);
        joined(&Image {
            data: data.collect(),
            ..*changes
        })
    };
    let regions: Vec<Image<bool>> = changes.par_iter().map(whole).collect();
    let share =
        |r: &Image<bool>| r.data.iter().filter(|m| **m).count() as f64 / r.data.len() as f64;
    let usual = shape::upper_median(regions.iter().map(share))?;
    CHANGING_SHARES.contains(&usual).then_some(regions)
}

/// What is near to each other becomes one, without its holes; single pixels go.
fn joined(changes: &Image<bool>) -> Image<bool> {
    let reach = ((changes.width.max(changes.height) as f64 * JOINED_SHARE) as usize).max(1);
    let kept = spread(&spread(changes, 1, false), 1, true);
    let wide = spread(&kept, reach, true);
    filled(&bridged(&wide))
}

/// Gaps of a row that are shorter than a trunk is wide are closed: crown and soles never change.
fn bridged(from: &Image<bool>) -> Image<bool> {
    let longest = from.width.max(from.height) as f64;
    let mut out = from.clone();
    for y in 0..from.height {
        let mut last: Option<usize> = None;
        for x in (0..from.width).filter(|x| from.at(*x, y)) {
            let gap = last.map_or(0..0, |l| l + 1..x);
            if (gap.len() as f64) < GAP_SHARE * longest {
                gap.for_each(|x| *out.at_mut(x, y) = true);
            }
            last = Some(x);
        }
    }
    out
}

/// Pixels whose neighbourhood, `reach` to each side, holds `kind`, take it.
fn spread(from: &Image<bool>, reach: usize, kind: bool) -> Image<bool> {
    let (w, h) = (from.width, from.height);
    let along = |from: &Image<bool>, across: bool| {
        let one = |i: usize| {
            let (x, y) = (i % w, i / w);
            let found = if across {
                (x.saturating_sub(reach)..(x + reach + 1).min(w)).any(|x| from.at(x, y) == kind)
            } else {
                (y.saturating_sub(reach)..(y + reach + 1).min(h)).any(|y| from.at(x, y) == kind)
            };
            found == kind
        };
        Image {
            width: w,
            height: h,
            data: (0..w * h).map(one).collect(),
        }
    };
    along(&along(from, true), false)
}

/// Without holes: what the border cannot reach is inside.
fn filled(from: &Image<bool>) -> Image<bool> {
    let (w, h) = (from.width, from.height);
    let mut inside = from.map(|_| true);
    let border = (0..w).flat_map(|x| [(x, 0), (x, h - 1)]);
    let mut open: Vec<(usize, usize)> = border
        .chain((0..h).flat_map(|y| [(0, y), (w - 1, y)]))
        .collect();
    while let Some((x, y)) = open.pop() {
        if from.at(x, y) || !std::mem::replace(inside.at_mut(x, y), false) {
            continue;
        }
        let near = [
            (x.wrapping_sub(1), y),
            (x + 1, y),
            (x, y.wrapping_sub(1)),
            (x, y + 1),
        ];
        open.extend(near.into_iter().filter(|(x, y)| *x < w && *y < h));
    }
    inside
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Photos of a background before which a plain block with a few marks goes to and fro; each is shifted and
    /// exposed otherwise if `phone`.
    fn turn(phone: bool, camera_moves: bool) -> Vec<Gray> {
        let mut dice = proof::Dice(5);
        let (w, h) = (160usize, 220usize);
        let background = |x: f64, y: f64| {
            110.0
                + 40.0 * libm::sin(x / 7.0) * libm::cos(y / 5.0)
                + 30.0 * libm::sin((x + 2.0 * y) / 17.0)
        };
        (0..9)
            .map(|k| {
                let phase = f64::from(k) * 0.7;
                let left = 55.0 + 12.0 * libm::sin(phase);
                let shift = match (camera_moves, phone) {
                    (true, _) => 37.0 * f64::from(k),
                    (_, true) => 0.7 * libm::cos(phase),
                    _ => 0.0,
                };
                let gain = if phone {
                    1.0 + 0.06 * libm::cos(phase)
                } else {
                    1.0
                };
                let mut image = Gray::filled(w, h, 0.0);
                for i in 0..w * h {
                    let (x, y) = ((i % w) as f64, (i / w) as f64);
                    let body = (left..left + 45.0).contains(&x) && (40.0..190.0).contains(&y);
                    let shown = if body {
                        200.0
                    } else {
                        background(x + shift, y)
                    };
                    image.data[i] = (gain * shown + dice.normal()) as f32;
                }
                image
            })
            .collect()
    }

    #[test]
    fn what_turns_is_found_whole_though_its_middle_never_changes() {
        for phone in [false, true] {
            let regions = regions(&turn(phone, false)).unwrap();
            for region in &regions {
                assert!(region.at(78, 110), "the middle of the body");
                let far = [(8, 8), (150, 8), (8, 210), (150, 210), (8, 110)];
                assert!(far.iter().all(|(x, y)| !region.at(*x, *y)), "{phone}");
            }
        }
    }

    #[test]
    fn a_camera_that_moves_leaves_nothing_still() {
        assert_eq!(regions(&turn(false, true)), None);
    }
}
