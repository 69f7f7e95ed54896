//! The outline of a reduced photo again at full size, window by window so that memory stays small.

use crate::border::soft_border::soft_border;
use crate::border::tiles::{band, cut_again, of_small, settled};
use crate::cut::least_cut::{Known, cut_by_odds};
use crate::likelihood::background::Noise;
use crate::walk::colors::Colors;
use shape::{Image, Mask, Rgb};

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
    let mut sides = match factor {
        1 => coarse.clone(),
        _ => by_colors(photo, factor, coarse, colors, gamma),
    };
    for y in 0..sides.height {
        for x in 0..sides.width {
            if sides.at(x, y) && closed(x, y) {
                *sides.at_mut(x, y) = false;
            }
        }
    }
    soft_border(photo, None, &sides, NOISE)
}

/// The border cut again.
fn by_colors(
    photo: &Rgb,
    factor: usize,
    coarse: &Image<bool>,
    colors: &Colors,
    gamma: f64,
) -> Image<bool> {
    let band = band(coarse);
    let known = settled(coarse, &band, &|_| Known::Unknown);
    let known = |i: usize| of_small(&known, factor, i % photo.width, i / photo.width);
    cut_again(photo, factor, coarse, &band, &|window| {
        let rows = window.y..window.y + window.height;
        let favour: Vec<f32> = rows
            .flat_map(|y| {
                let row = &photo.row(y)[window.x..window.x + window.width];
                row.iter()
                    .map(move |c| colors.favour(*c, y as f64 / factor as f64))
            })
            .collect();
        cut_by_odds(photo, window, gamma, &favour, &known)
    })
}
