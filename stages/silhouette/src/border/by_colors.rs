//! The border at full size where colours are all that is known.

use crate::border::soft_border::coverage;
use crate::border::tiles::band;
use crate::cut::least_cut::Known;
use crate::label::by_colors::{ByColors, costs, window};
use crate::label::color_cut::{Settings, cut};
use crate::label::parts::largest;
use shape::{Image, Mask, Rgb};

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
        &window(photo),
        own,
        settings,
        &settled,
    );
    let fine = Image {
        width: photo.width,
        height: photo.height,
        data: fine,
    };
    coverage(&largest(&fine, &|_| 0.0))
}
