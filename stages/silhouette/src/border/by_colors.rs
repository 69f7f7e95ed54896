//! The border at full size where colours are all that is known.

use crate::border::soft_border::coverage;
use crate::border::tiles::{band, of_small, settled};
use crate::cut::least_cut::{Known, Window};
use crate::label::by_colors::{ByColors, costs};
use crate::label::color_cut::{Costs, Settings, cut};
use crate::label::parts::without_specks;
use crate::raster::raster;
use shape::{Mask, Rgb};

/// The mask at full size of what was parted at a reduced size, `factor` times smaller, where `known` is certain.
pub(crate) fn fine_by_colors(
    photo: &Rgb,
    coarse: &ByColors,
    known: &[Known],
    factor: usize,
    settings: &Settings,
) -> Mask {
    let ByColors { sides, ground, own } = coarse;
    let known = settled(sides, &band(sides), &|i| known[i]);
    let known = |i: usize| of_small(&known, factor, i % photo.width, i / photo.width);
    let background = costs(photo, ground);
    let fine = cut(
        photo,
        &Costs {
            background: &background,
            ..Costs::default()
        },
        &Window::all(photo),
        own,
        settings,
        &known,
    );
    let fine = raster(photo.width, photo.height, fine);
    coverage(&without_specks(&fine))
}
