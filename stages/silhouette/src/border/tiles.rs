//! Squares of coarse pixels in which the border is.

use crate::cut::least_cut::Window;
use crate::raster::raster;
use shape::Image;
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
    let (w, h) = (sides.width as i32, sides.height as i32);
    let mut band = raster(sides.width, sides.height, vec![false; sides.data.len()]);
    for y in 0..h {
        for x in 0..w {
            let here = sides.at(x as usize, y as usize);
            let differs = |dx: i32, dy: i32| {
                let (nx, ny) = (x + dx, y + dy);
                nx >= 0 && ny >= 0 && nx < w && ny < h && sides.at(nx as usize, ny as usize) != here
            };
            let near = (-2..=2).any(|dy| (-2..=2).any(|dx| differs(dx, dy)));
            *band.at_mut(x as usize, y as usize) = near;
        }
    }
    band
}
