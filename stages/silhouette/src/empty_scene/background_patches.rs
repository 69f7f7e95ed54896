//! Background patches: bits of the background that were kept as body where no photo shows it without the body.
//!
//! A patch of a body moves across the photo as it turns, so that photos taken near by show it beside its
//! place. A picture on the wall does not move: where they show it at all, they show it in its place. Nor
//! does the crown of a head, but that is in its place on all photos.

use crate::empty_scene::doubtful_patches::Vouched;
use crate::scene::still_and_disk::Shot;
use rayon::prelude::*;
use shape::{Image, Rgb, parts};

/// Photos that were taken within so many degrees are asked. By hand: not on record. \[°\]
const NEIGHBOUR_DEG: f64 = 45.0;
/// How far around a patch is still its place, as a share of the photo's height. By hand: not on record.
const SAME_PLACE_SHARE: f64 = 0.01;
/// How far above and below the same part of a body may be on another photo, as a share of the height. By hand: not on
/// record.
const SAME_HEIGHT_SHARE: f64 = 0.04;
/// A patch takes so large a share of the body's pixels at least. By hand: not on record.
const MIN_PATCH_SHARE: f64 = 0.001;
/// Levels by which a colour may differ in each channel and still be the same. By hand: not on record.
const SAME_COLOR_LEVELS: u8 = 16;
/// A colour is found again if so many pixels have it, as a share of the patch's. By hand: not on record.
const MIN_FOUND_SHARE: f64 = 0.05;
/// What so large a share of the photos shows in its place is the body's, near the axis. By hand: not on record.
const STAYS_SHARE: f64 = 0.35;
/// A colour is strange to the body at some height if a smaller share of it has it there. By hand: not on record.
const RARE_SHARE: f64 = 0.001;
/// Levels of a bin of colours (derived: as many as colours differ by that are the same, so that these are in one bin or
/// the next).
const BIN_LEVELS: usize = SAME_COLOR_LEVELS as usize;
/// Bins along a channel (derived).
const BINS: usize = 256 / BIN_LEVELS;

/// Pixels of each cut that are none of the body. `radius` is the disk's, 0 without one: its top is left out.
pub(crate) fn background_patches(
    shots: &[Shot],
    cuts: &[Option<Image<bool>>],
    radius: f64,
) -> Vec<Vec<usize>> {
    let Some(vouched) = Vouched::of(shots, cuts) else {
        return vec![vec![]; shots.len()];
    };
    let rare = rare_by_row(shots, cuts, &vouched);
    let one = |(k, (shot, cut)): (usize, (&Shot, &Option<Image<bool>>))| {
        let Some(cut) = cut else { return vec![] };
        let strange = |i: usize| {
            let color = shot.small.data[i];
            let rare = rare[i / cut.width][bin(color)];
            vouched.alone(shot, cut, i, radius) && (rare || vouched.strange(color))
        };
        let data = (0..cut.data.len()).map(strange).collect();
        let body = cut.data.iter().filter(|b| **b).count();
        let least = ((body as f64 * MIN_PATCH_SHARE) as usize).max(1);
        let other_photos =
            near(shots, k).filter_map(|j| Some((&shots[j].small, cuts[j].as_ref()?)));
        let other_photos: Vec<(&Rgb, &Image<bool>)> = other_photos.collect();
        let stays = |patch: &[usize]| {
            let stays = |i: &&usize| stays(shots, cuts, shot.small.data[**i], **i);
            2 * patch.iter().filter(stays).count() >= patch.len()
        };
        patches(&Image { data, ..*cut })
            .into_iter()
            .filter(|patch| patch.len() >= least && !stays(patch))
            .filter(|patch| !is_found(&shot.small, patch, &other_photos))
            .flatten()
            .collect()
    };
    let all = shots.par_iter().zip(cuts).enumerate();
    all.map(one).collect()
}

/// Photos that were taken near by.
fn near(shots: &[Shot], k: usize) -> impl Iterator<Item = usize> {
    let azimuth = |j: usize| {
        let at = shots[j].camera.centre();
        libm::atan2(at.y, at.x).to_degrees()
    };
    (0..shots.len()).filter(move |j| {
        let apart = (azimuth(*j) - azimuth(k)).rem_euclid(360.0);
        *j != k && apart.min(360.0 - apart) < NEIGHBOUR_DEG
    })
}

/// The pixels of each part.
fn patches(of: &Image<bool>) -> Vec<Vec<usize>> {
    let (of, sizes) = parts(of, true);
    let mut patches = vec![vec![]; sizes.len()];
    for (i, part) in of.data.iter().enumerate() {
        if *part != u32::MAX {
            patches[*part as usize].push(i);
        }
    }
    patches
}

fn bin(color: [u8; 3]) -> usize {
    let next = |bin: usize, level: &u8| bin * BINS + usize::from(*level) / BIN_LEVELS;
    color.iter().fold(0, next)
}

/// Of each row the bins of colours that hardly any of the body has near that height, where photos show
/// it before a background that they know.
fn rare_by_row(shots: &[Shot], cuts: &[Option<Image<bool>>], vouched: &Vouched) -> Vec<Vec<bool>> {
    let first = cuts.iter().flatten().next();
    let (width, height) = first.map_or((0, 0), |cut| (cut.width, cut.height));
    let counts = |y: usize| {
        let mut counts = vec![0u32; BINS * BINS * BINS];
        for (shot, cut) in shots.iter().zip(cuts) {
            let Some(cut) = cut else { continue };
            let row = y * width..(y + 1) * width;
            row.filter(|i| vouched.before_scene(cut, *i))
                .for_each(|i| counts[bin(shot.small.data[i])] += 1);
        }
        counts
    };
    let counts: Vec<Vec<u32>> = (0..height).into_par_iter().map(counts).collect();
    let reach = (height as f64 * SAME_HEIGHT_SHARE).ceil() as usize;
    let rare = |y: usize| {
        let mut sum = vec![0u32; BINS * BINS * BINS];
        for row in &counts[y.saturating_sub(reach)..(y + reach + 1).min(height)] {
            sum.iter_mut()
                .zip(row)
                .for_each(|(sum, count)| *sum += count);
        }
        rare(sum)
    };
    (0..height).into_par_iter().map(rare).collect()
}

/// Bins that hold few colours, together with those beside; none if there are no colours.
fn rare(mut counts: Vec<u32>) -> Vec<bool> {
    let all: u32 = counts.iter().sum();
    for stride in [1, BINS, BINS * BINS] {
        let alone = counts.clone();
        for (i, sum) in counts.iter_mut().enumerate() {
            let at = i / stride % BINS;
            *sum += if at > 0 { alone[i - stride] } else { 0 };
            *sum += if at + 1 < BINS { alone[i + stride] } else { 0 };
        }
    }
    let least = f64::from(all) * RARE_SHARE;
    counts.iter().map(|sum| f64::from(*sum) < least).collect()
}

/// Whether many photos show a colour as body at a pixel.
fn stays(shots: &[Shot], cuts: &[Option<Image<bool>>], color: [u8; 3], i: usize) -> bool {
    let shows = |(shot, cut): &(&Shot, &Option<Image<bool>>)| {
        let body = cut.as_ref().is_some_and(|cut| cut.data[i]);
        body && alike(shot.small.data[i], color)
    };
    let count = shots.iter().zip(cuts).filter(shows).count();
    count as f64 >= STAYS_SHARE * shots.len() as f64
}

fn alike(a: [u8; 3], b: [u8; 3]) -> bool {
    (0..3).all(|k| a[k].abs_diff(b[k]) <= SAME_COLOR_LEVELS)
}

/// Whether other photos show most of a patch's colours on the body, near its height and beside its place.
fn is_found(photo: &Rgb, patch: &[usize], other_photos: &[(&Rgb, &Image<bool>)]) -> bool {
    let (width, height) = (photo.width, photo.height);
    let around = |v: usize, share: f64, end: usize| {
        let reach = (height as f64 * share).ceil() as usize;
        v.saturating_sub(reach)..(v + reach + 1).min(end)
    };
    let mut place = vec![false; width * height];
    for i in patch {
        let columns = around(i % width, SAME_PLACE_SHARE, width);
        for row in around(i / width, SAME_PLACE_SHARE, height) {
            place[row * width..][columns.clone()].fill(true);
        }
    }
    let rows = patch.iter().map(|i| i / width);
    let top = around(rows.clone().min().unwrap_or(0), SAME_HEIGHT_SHARE, height).start;
    let bottom = around(rows.max().unwrap_or(0), SAME_HEIGHT_SHARE, height).end;
    let beside = |(photo, cut): &(&Rgb, &Image<bool>)| -> Vec<[u8; 3]> {
        let there = |i: &usize| cut.data[*i] && !place[*i];
        let of_body = (top * width..bottom * width).filter(there);
        of_body.map(|i| photo.data[i]).collect()
    };
    let beside: Vec<[u8; 3]> = other_photos.iter().flat_map(beside).collect();
    let enough = (patch.len() as f64 * MIN_FOUND_SHARE).ceil() as usize;
    let found = |i: &&usize| {
        let like = |c: &&[u8; 3]| alike(**c, photo.data[**i]);
        beside.iter().filter(like).take(enough).count() >= enough
    };
    2 * patch.iter().filter(found).count() >= patch.len()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::raster;
    use nalgebra::{Matrix3, Rotation3, Vector3};
    use shape::{Camera, Intrinsics, PhotoId, Pose};

    const SIZE: (usize, usize) = (80, 120);
    const SKIN: [u8; 3] = [200, 150, 120];

    /// Eighteen photos of a turn, on which a body of skin's colour takes some columns; `patch` is the
    /// colour of what else it seems to show, by photo and column, in rows 50 to 62.
    fn turn(
        patch: &dyn Fn(usize, usize) -> Option<[u8; 3]>,
    ) -> (Vec<Shot>, Vec<Option<Image<bool>>>) {
        let one = |k: usize| {
            let (s, c) = libm::sincos(k as f64 * std::f64::consts::TAU / 18.0);
            let rows = Matrix3::new(c, s, 0.0, 0.0, 0.0, -1.0, -s, c, 0.0);
            // It is broader on every second photo, so that the rest show what is beside.
            let columns = if k.is_multiple_of(2) { 20..60 } else { 26..54 };
            let covered = |i: usize| columns.contains(&(i % SIZE.0));
            let shown = |i: usize| {
                let (x, y) = (i % SIZE.0, i / SIZE.0);
                let patch = (50..62).contains(&y).then(|| patch(k, x)).flatten();
                let shade = (7 * x + 13 * y + 5 * k) % 16;
                let lit = |c: [u8; 3]| c.map(|v| v + shade as u8);
                lit(if covered(i) {
                    patch.unwrap_or(SKIN)
                } else {
                    [60, 90, 60]
                })
            };
            let (width, height) = SIZE;
            let small = raster(width, height, (0..width * height).map(shown).collect());
            let cut = small.map(|_| true);
            let cut = Image {
                data: (0..cut.data.len()).map(covered).collect(),
                ..cut
            };
            let camera = Camera {
                lens: Intrinsics::simple(width as u32, height as u32, 100.0),
                pose: Pose {
                    rotation: Rotation3::from_matrix_unchecked(rows),
                    translation: Vector3::new(0.0, 0.0, 900.0),
                },
            };
            let id = PhotoId(k as u32);
            (Shot { id, small, camera }, Some(cut))
        };
        (0..18).map(one).unzip()
    }

    fn found(patch: &dyn Fn(usize, usize) -> Option<[u8; 3]>) -> Vec<usize> {
        let (shots, cuts) = turn(patch);
        background_patches(&shots, &cuts, 0.0)
            .iter()
            .map(Vec::len)
            .collect()
    }

    #[test]
    fn a_picture_that_two_photos_show_in_its_place_is_no_body() {
        let columns = |k: usize| if k == 4 { 40..50 } else { 42..50 };
        let picture = |k: usize, x: usize| {
            let shows = (4..6).contains(&k) && columns(k).contains(&x);
            shows.then_some([30, 200, 200])
        };
        let mut want = vec![0; 18];
        (want[4], want[5]) = (120, 96);
        assert_eq!(found(&picture), want);
    }

    #[test]
    fn a_print_that_turns_with_the_body_is_body() {
        let print = |k: usize, x: usize| {
            let from = 30 + 6 * k.saturating_sub(3);
            let shows = (3..6).contains(&k) && (from..from + 8).contains(&x);
            shows.then_some([30, 200, 200])
        };
        assert_eq!(found(&print), vec![0; 18]);
    }

    #[test]
    fn a_crown_that_all_photos_show_in_its_place_is_body() {
        let crown = |_: usize, x: usize| (34..46).contains(&x).then_some([40, 30, 25]);
        assert_eq!(found(&crown), vec![0; 18]);
    }

    #[test]
    fn a_shade_of_the_bodys_own_colours_is_body() {
        let shade = |k: usize, x: usize| {
            let shows = k == 4 && (40..50).contains(&x);
            shows.then_some([190, 142, 112])
        };
        assert_eq!(found(&shade), vec![0; 18]);
    }
}
