//! The outline on one photo: a least cut by colours about what the cells cover.

use crate::cut::least_cut::{Known, Window, cut_by_odds};

use crate::cells::Block;
use crate::raster::{as_mask, raster};
use crate::scene::still_and_disk::Shot;
use crate::walk::colors::Colors;
use crate::walk::features::Spot;
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

/// The least cut of a reduced photo. `behind` are pixels that show something behind the subject.
pub(crate) fn outline(
    shot: &Shot,
    depth: &Image<f32>,
    cell_px: f32,
    colors: &Colors,
    behind: &[[f64; 2]],
    hold: &Hold,
    gamma: f64,
) -> Image<bool> {
    let (w, h) = (shot.small.width, shot.small.height);
    let mut known: Vec<Known> = depth
        .data
        .iter()
        .map(|d| match *d < -hold.outside * cell_px {
            true => Known::Background,
            false => Known::Unknown,
        })
        .collect();
    for px in behind {
        let (x, y) = (px[0].round() as usize, px[1].round() as usize);
        if x < w && y < h {
            known[y * w + x] = Known::Background;
        }
    }
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
    let sides = raster(w, h, data);
    // A gap is where colours speak for the background.
    let open = |i: usize| colors.favour(shot.small.data[i], (i / w) as f64) < -1.0;
    cleaned(&sides, &open)
}

/// Parts smaller than this part of the greatest are left out: cells have them in one piece, but an arm may hide what
/// joins them. By hand: looked at the walk of a test, at 70 and 140: equal masks.
const SPECK_PART: usize = 100;
/// Holes smaller than this part of the greatest part are filled, and up to a tenth of it those where most pixels are
/// not `open`. By hand: looked at the walk of a test, none filled: mean IoU −0.0005.
const HOLE_PART: usize = 1000;

/// Without specks, and without holes that are none.
fn cleaned(sides: &Image<bool>, open: &dyn Fn(usize) -> bool) -> Image<bool> {
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
    let mut opens = vec![0usize; sizes.len()];
    for (i, h) in hole.data.iter().enumerate() {
        if let Some(count) = opens.get_mut(*h as usize) {
            *count += usize::from(open(i));
        }
    }
    for (keep, h) in kept.data.iter_mut().zip(&hole.data) {
        let Some(size) = sizes.get(*h as usize) else {
            continue;
        };
        let small = size * HOLE_PART < most;
        let closed = size * 10 < most && 2 * opens[*h as usize] < *size;
        *keep |= small || closed;
    }
    kept
}

/// Pixels of a shot that show points outside of a block's cells' surroundings.
pub(crate) fn behind(spots: &[Spot], k: usize, block: &Block, near: &[bool]) -> Vec<[f64; 2]> {
    let outside = |s: &&Spot| block.cell_of(&s.at).is_none_or(|i| !near[i]);
    let of = |s: &Spot| {
        s.sights
            .iter()
            .find(|(shot, _)| *shot == k)
            .map(|(_, px)| *px)
    };
    spots.iter().filter(outside).filter_map(of).collect()
}

/// A mask's evidence for pixels: as ln p(body) − ln p(background), sure beyond a cell from its border.
pub(crate) fn sureness(sides: &Image<bool>, cell_px: f32) -> Image<f32> {
    let depth = signed_distance(&as_mask(sides));
    depth.map(|d| (d / cell_px.max(1.0) * 4.0).clamp(-8.0, 8.0))
}
