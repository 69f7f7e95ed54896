//! Squares of coarse pixels in which the border is, cut again at full size so that memory stays small.

use crate::cut::least_cut::{Known, Window};
use crate::raster::raster;
use crate::scene::backdrop::thinned;
use shape::{Image, Rgb};
use std::ops::Range;

/// A square of coarse pixels, clipped to the photo.
pub(crate) struct Tile {
    pub(crate) x: Range<usize>,
    pub(crate) y: Range<usize>,
}

impl Tile {
    /// What is cut of it at full size: a margin of four coarse pixels around the tile is cut too, then
    /// thrown away.
    pub(crate) fn with_margin(&self, coarse: &Image<bool>, factor: usize) -> Window {
        let widened = |r: &Range<usize>, most: usize| {
            let (start, end) = (r.start.saturating_sub(4), (r.end + 4).min(most));
            (start * factor, (end - start) * factor)
        };
        let (x, width) = widened(&self.x, coarse.width);
        let (y, height) = widened(&self.y, coarse.height);
        Window {
            x,
            y,
            width,
            height,
        }
    }
}

/// The tiles of 16 pixels in which some of the band is, row by row.
pub(crate) fn tiles(band: &Image<bool>) -> Vec<Tile> {
    /// How much memory a cut takes (structural).
    const SIDE: usize = 16;
    let along = |most: usize| {
        let starts = (0..most).step_by(SIDE);
        starts.map(move |start| start..(start + SIDE).min(most))
    };
    let all = along(band.height).flat_map(|y| along(band.width).map(move |x| (x, y.clone())));
    let on_band = |tile: &Tile| {
        let mut rows = tile.y.clone();
        rows.any(|y| tile.x.clone().any(|x| band.at(x, y)))
    };
    all.map(|(x, y)| Tile { x, y }).filter(on_band).collect()
}

/// Coarse pixels within two of the border.
pub(crate) fn band(sides: &Image<bool>) -> Image<bool> {
    let (body, background) = (thinned(sides, 2), thinned(&sides.map(|b| !b), 2));
    let near = body
        .data
        .iter()
        .zip(&background.data)
        .map(|(a, b)| !a && !b);
    raster(sides.width, sides.height, near.collect())
}

/// What is known of coarse pixels: by the cut, but within the band by what was certain before.
pub(crate) fn settled(
    coarse: &Image<bool>,
    band: &Image<bool>,
    certain: &dyn Fn(usize) -> Known,
) -> Image<Known> {
    let one = |i: usize| match (band.data[i], coarse.data[i]) {
        (true, _) => certain(i),
        (false, false) => Known::Background,
        (false, true) => Known::Body,
    };
    let all = (0..coarse.data.len()).map(one).collect();
    raster(coarse.width, coarse.height, all)
}

/// What the coarse pixel of a pixel has.
pub(crate) fn of_small<T: Copy>(coarse: &Image<T>, factor: usize, x: usize, y: usize) -> T {
    let (x, y) = (x / factor, y / factor);
    coarse.at(x.min(coarse.width - 1), y.min(coarse.height - 1))
}

/// A coarse image at the size of the photo.
pub(crate) fn enlarged<T: Copy>(
    coarse: &Image<T>,
    factor: usize,
    [width, height]: [usize; 2],
) -> Image<T> {
    let mut data = Vec::with_capacity(width * height);
    for row in (0..height).map(|y| coarse.row((y / factor).min(coarse.height - 1))) {
        let end = data.len() + width;
        for value in row {
            data.extend(std::iter::repeat_n(*value, factor));
        }
        data.resize(end, row[row.len() - 1]);
    }
    raster(width, height, data)
}

/// A coarse cut at the size of the photo, its band cut again window by window by `cut`.
pub(crate) fn cut_again(
    photo: &Rgb,
    factor: usize,
    coarse: &Image<bool>,
    band: &Image<bool>,
    cut: &dyn Fn(&Window) -> Vec<bool>,
) -> Image<bool> {
    let width = photo.width;
    let mut sides = enlarged(coarse, factor, [width, photo.height]);
    for tile in tiles(band) {
        let window = tile.with_margin(coarse, factor);
        let body = cut(&window);
        let (left, right) = (tile.x.start * factor, tile.x.end * factor);
        for y in tile.y.start * factor..tile.y.end * factor {
            let from = (y - window.y) * window.width + left - window.x;
            sides.data[y * width..][left..right].copy_from_slice(&body[from..][..right - left]);
        }
    }
    sides
}
