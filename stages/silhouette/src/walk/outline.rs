//! The outline on one photo: a least cut by colours about what the cells cover.

use crate::cut::least_cut::{Known, Window, cut_by_odds};

use crate::cells::Block;
use crate::label::parts::SPECK_SHARE;
use crate::raster::{as_mask, raster};
use crate::scene::still_and_disk::Shot;
use crate::walk::colors::Colors;
use shape::{Image, parts, signed_distance};

/// What holds an outline to the cells.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Hold {
    /// The outline is no further outside of the cells. \[cells\]
    pub(crate) outside: f32,
    /// Pixels deeper inside are the subject unless their colours speak against it. \[cells\]
    pub(crate) inside: f32,
    /// How strongly they must.
    pub(crate) firm: f32,
}

/// How deep inside of what the cells cover pixels are. \[px\]
pub(crate) fn depth(block: &Block, solid: &[bool], shot: &Shot) -> Image<f32> {
    let (w, h) = (shot.small.width, shot.small.height);
    let shown = block.shown(solid, &shot.camera, w, h);
    signed_distance(&as_mask(&shown))
}

/// Size of a cell on a photo. \[px\]
pub(crate) fn cell_px(block: &Block, shot: &Shot) -> f32 {
    let far = shot.camera.centre().coords.norm();
    (block.cell * shot.camera.lens.focal[0] / far) as f32
}

/// The least cut of a reduced photo.
pub(crate) fn outline(
    shot: &Shot,
    depth: &Image<f32>,
    cell_px: f32,
    colors: &Colors,
    hold: &Hold,
    gamma: f64,
) -> Image<bool> {
    let (w, h) = (shot.small.width, shot.small.height);
    let known: Vec<Known> = depth
        .data
        .iter()
        .map(|d| match *d < -hold.outside * cell_px {
            true => Known::Background,
            false => Known::Unknown,
        })
        .collect();
    let favour: Vec<f32> = shot
        .small
        .data
        .iter()
        .enumerate()
        .map(|(i, c)| {
            let within = (depth.data[i] / (hold.inside * cell_px).max(1.0)).clamp(-1.0, 1.0);
            colors.favour(*c, (i / w) as f64) + hold.firm * within
        })
        .collect();
    let window = Window::all(&shot.small);
    let data = cut_by_odds(&shot.small, &window, gamma, &favour, &|i| known[i]);
    cleaned(&raster(w, h, data))
}

/// Parts smaller than this part of the greatest are left out: cells have them in one piece, but an arm may hide what
/// joins them. By hand: looked at the walk of a test, at 70 and 140: equal masks.
const SPECK_PART: usize = 100;
/// Without specks, and without holes that are none.
fn cleaned(sides: &Image<bool>) -> Image<bool> {
    let (part, sizes) = parts(sides, true);
    let most = sizes.iter().copied().max().unwrap_or(0);
    let mut kept = Image {
        data: part
            .data
            .iter()
            .map(|p| {
                sizes
                    .get(*p as usize)
                    .is_some_and(|s| s * SPECK_PART >= most)
            })
            .collect(),
        ..*sides
    };
    let (hole, sizes) = parts(&kept, false);
    for (keep, h) in kept.data.iter_mut().zip(&hole.data) {
        *keep |= sizes
            .get(*h as usize)
            .is_some_and(|size| (*size as f64) < SPECK_SHARE * most as f64);
    }
    kept
}

/// A mask's evidence for pixels: as ln p(body) − ln p(background), sure beyond a cell from its border.
pub(crate) fn sureness(sides: &Image<bool>, cell_px: f32) -> Image<f32> {
    let depth = signed_distance(&as_mask(sides));
    depth.map(|d| (d / cell_px.max(1.0) * 4.0).clamp(-8.0, 8.0))
}
