//! The border at full size where colours are all that is known.

use crate::border::soft_border::coverage;
use crate::border::tiles::band;
use crate::cut::least_cut::{Known, Window};
use crate::label::by_colors::{ByColors, costs};
use crate::label::color_cut::{Settings, cut};
use crate::label::parts::largest;
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
    let near = band(sides);
    let at = |i: usize| {
        let (x, y) = (i % photo.width / factor, i / photo.width / factor);
        (x.min(sides.width - 1), y.min(sides.height - 1))
    };
    let settled = |i: usize| {
        let (x, y) = at(i);
        match (near.at(x, y), sides.at(x, y)) {
            (true, _) => known[y * sides.width + x],
            (false, true) => Known::Body,
            (false, false) => Known::Background,
        }
    };
    let background = costs(photo, ground);
    let fine = cut(
        photo,
        [&background, &[]],
        &Window::all(photo),
        own,
        settings,
        &settled,
    );
    let fine = raster(photo.width, photo.height, fine);
    coverage(&largest(&fine, &|_| 0.0))
}
