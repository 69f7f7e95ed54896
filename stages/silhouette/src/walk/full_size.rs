//! The outline of a reduced photo again at full size, window by window so that memory stays small.

use crate::border::soft_border::{coverage, soft_border};
use crate::border::tiles::{band, tiles};
use crate::cut::least_cut::{Known, cut_by_odds};
use crate::likelihood::background::Noise;
use crate::raster::raster;
use crate::walk::colors::Colors;
use shape::{Image, Mask, Rgb};

/// Half the side of the neighbourhood in which the background's colour is sought. \[px\]
const REACH: usize = 6;
/// Pixels this near to the border may show both sides. \[px\]
const MIXED: f32 = 2.5;
/// Noise that is believed of a photo. \[levels\]
const NOISE: Noise = Noise::even(2.0);

/// The mask of a photo from the sides of the reduced one; `closed` tells of pixels of the photo that
/// cannot be the subject.
pub(crate) fn at_full_size(
    photo: &Rgb,
    factor: usize,
    coarse: &Image<bool>,
    colors: &Colors,
    gamma: f64,
    closed: &dyn Fn(usize, usize) -> bool,
) -> Mask {
    let mut sides = widened(photo, factor, coarse);
    if factor > 1 {
        cut_again(photo, factor, coarse, colors, gamma, &mut sides);
    }
    for y in 0..sides.height {
        for x in 0..sides.width {
            if sides.at(x, y) && closed(x, y) {
                *sides.at_mut(x, y) = false;
            }
        }
    }
    soft_border(photo, &beside(photo, &sides), &sides, NOISE)
}

/// Sides at full size, each pixel as its reduced one.
fn widened(photo: &Rgb, factor: usize, coarse: &Image<bool>) -> Image<bool> {
    let at = |i: usize| {
        let (x, y) = (i % photo.width / factor, i / photo.width / factor);
        coarse.at(x.min(coarse.width - 1), y.min(coarse.height - 1))
    };
    raster(
        photo.width,
        photo.height,
        (0..photo.data.len()).map(at).collect(),
    )
}

/// Cuts the border again.
fn cut_again(
    photo: &Rgb,
    factor: usize,
    coarse: &Image<bool>,
    colors: &Colors,
    gamma: f64,
    sides: &mut Image<bool>,
) {
    let band = band(coarse);
    let settled = |i: usize| {
        let (x, y) = (i % photo.width / factor, i / photo.width / factor);
        let (x, y) = (x.min(coarse.width - 1), y.min(coarse.height - 1));
        match (band.at(x, y), coarse.at(x, y)) {
            (true, _) => Known::Unknown,
            (false, true) => Known::Body,
            (false, false) => Known::Background,
        }
    };
    for tile in tiles(&band) {
        let window = tile.with_margin(coarse, factor);
        let rows = window.y..window.y + window.height;
        let favour: Vec<f32> = rows
            .flat_map(|y| {
                let row = &photo.row(y)[window.x..window.x + window.width];
                row.iter()
                    .map(move |c| colors.favour(*c, y as f64 / factor as f64))
            })
            .collect();
        let body = cut_by_odds(photo, &window, gamma, &favour, &settled);
        let (left, right) = (tile.x.start * factor, tile.x.end * factor);
        for y in tile.y.start * factor..tile.y.end * factor {
            let from = (y - window.y) * window.width + left - window.x;
            sides.data[y * photo.width..][left..right]
                .copy_from_slice(&body[from..][..right - left]);
        }
    }
}

/// What the photo would show near the border without the subject: the mean of the background beside.
fn beside(photo: &Rgb, sides: &Image<bool>) -> Rgb {
    let far = shape::signed_distance(&coverage(sides));
    let (w, h) = (photo.width, photo.height);
    let mut without = photo.clone();
    for y in 0..h {
        for x in 0..w {
            let here = far.at(x, y);
            if !(-MIXED..=MIXED).contains(&here) {
                continue;
            }
            let (mut sum, mut count) = ([0u32; 3], 0u32);
            for row in y.saturating_sub(REACH)..(y + REACH + 1).min(h) {
                for column in x.saturating_sub(REACH)..(x + REACH + 1).min(w) {
                    if far.at(column, row) < -MIXED {
                        (0..3).for_each(|c| sum[c] += u32::from(photo.at(column, row)[c]));
                        count += 1;
                    }
                }
            }
            if count > 0 {
                *without.at_mut(x, y) = sum.map(|s| ((s + count / 2) / count) as u8);
            }
        }
    }
    without
}
