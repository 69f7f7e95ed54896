//! What all photos say together: a ray that misses the hull of the others sees background, and one
//! that passes deep through it sees body.

use crate::cut::least_cut::Known;
use nalgebra::Point3;
use rayon::prelude::*;
use shape::{Camera, Cameras, Mask, PhotoId};
use std::collections::BTreeMap;

/// Cells along the greatest side of the block that is carved.
const CELLS: f64 = 160.0;
/// Photos that may dissent: one is the photo in question, one more may be wrong.
pub(crate) const DISSENT: usize = 2;
/// Cells that are peeled off before what is left is certain body.
const PEEL: usize = 2;
/// Cells that are laid on before what is not covered is certain background.
const COAT: usize = 3;

/// A block of cells, x fastest.
pub(crate) struct Block {
    pub(crate) origin: Point3<f64>,
    /// Side of a cell. \[mm\]
    pub(crate) cell: f64,
    pub(crate) count: [usize; 3],
}

impl Block {
    pub(crate) fn centre(&self, i: usize) -> Point3<f64> {
        let [nx, ny, _] = self.count;
        let at =
            nalgebra::Vector3::new((i % nx) as f64, (i / nx % ny) as f64, (i / nx / ny) as f64);
        self.origin + at * self.cell
    }

    /// The same space in smaller cells, so many along its greatest side.
    pub(crate) fn finer(&self, cells: f64) -> Block {
        let sides = self.count.map(|n| n as f64 * self.cell);
        let cell = sides.into_iter().fold(0.0, f64::max) / cells;
        Block {
            origin: self.origin - nalgebra::Vector3::repeat(0.5 * (self.cell - cell)),
            cell,
            count: sides.map(|side| (side / cell).ceil() as usize),
        }
    }

    /// How many steps (six ways) each cell lies from the nearest that is so, `most` at most.
    pub(crate) fn steps_to(&self, such: &[bool], most: u8) -> Vec<u8> {
        let [nx, ny, nz] = self.count;
        let strides = [1, nx, nx * ny];
        let mut steps: Vec<u8> = such.iter().map(|s| if *s { 0 } else { most }).collect();
        for i in 0..steps.len() {
            let at = [i % nx, i / nx % ny, i / nx / ny];
            for a in (0..3).filter(|a| at[*a] > 0) {
                steps[i] = steps[i].min(steps[i - strides[a]].saturating_add(1));
            }
        }
        for i in (0..steps.len()).rev() {
            let at = [i % nx, i / nx % ny, i / nx / ny];
            for a in (0..3).filter(|a| at[*a] + 1 < [nx, ny, nz][*a]) {
                steps[i] = steps[i].min(steps[i + strides[a]].saturating_add(1));
            }
        }
        steps
    }

    /// Cells that have a neighbour (six) of the other kind take its kind.
    fn spread(&self, cells: &[bool], kind: bool) -> Vec<bool> {
        let [nx, ny, nz] = self.count;
        let strides = [1, nx, nx * ny];
        let one = |i: usize| {
            let at = [i % nx, i / nx % ny, i / nx / ny];
            let beside = (0..3).any(|a| {
                let below = at[a] > 0 && cells[i - strides[a]] == kind;
                below || at[a] + 1 < [nx, ny, nz][a] && cells[i + strides[a]] == kind
            });
            if beside { kind } else { cells[i] }
        };
        (0..cells.len()).map(one).collect()
    }
}

/// A mask with its photo and the camera at its size.
pub(crate) type View<'a> = (PhotoId, &'a Mask, Camera);

/// A block around the body, with how many masks say of each cell that it is none of it.
pub(crate) struct Together<'a> {
    pub(crate) views: Vec<View<'a>>,
    pub(crate) block: Block,
    /// Masks that dissent, [`DISSENT`] + 1 at most.
    pub(crate) against: Vec<usize>,
}

impl<'a> Together<'a> {
    /// `None` for less than six masks, or if they have nothing in common.
    pub(crate) fn of(masks: &'a [(PhotoId, Mask)], cameras: &Cameras) -> Option<Self> {
        let one = |(id, mask): &'a (PhotoId, Mask)| {
            let view = cameras.views.get(*id)?;
            let (width, height) = (mask.width as u32, mask.height as u32);
            Some((*id, mask, view.camera.resized(width, height)))
        };
        let views: Vec<View<'a>> = masks.iter().filter_map(one).collect();
        if views.len() < 6 {
            return None;
        }
        let shows = |x: &Point3<f64>| against(&views, x) <= DISSENT;
        let block = block(&views, cameras.ground_mm, &shows)?;
        let cells: usize = block.count.iter().product();
        let against: Vec<usize> = (0..cells)
            .into_par_iter()
            .map(|i| against(&views, &block.centre(i)))
            .collect();
        Some(Together {
            views,
            block,
            against,
        })
    }

    /// How many masks say that a point is none of the body, [`DISSENT`] + 1 at most.
    pub(crate) fn against(&self, x: &Point3<f64>) -> usize {
        against(&self.views, x)
    }

    /// What is certain of each pixel of each mask if so many photos may dissent.
    pub(crate) fn known(&self, dissent: usize) -> BTreeMap<PhotoId, Vec<Known>> {
        let block = &self.block;
        let solid: Vec<bool> = self.against.iter().map(|c| *c <= dissent).collect();
        let core = (0..PEEL).fold(solid.clone(), |cells, _| block.spread(&cells, false));
        let coat = (0..COAT).fold(solid, |cells, _| block.spread(&cells, true));
        let one =
            |(id, mask, camera): &View<'_>| (*id, projected(mask, camera, block, &core, &coat));
        let all: Vec<_> = self.views.par_iter().map(one).collect();
        all.into_iter().collect()
    }
}

/// How many masks say that a point is none of the body, at most one more than may.
fn against(views: &[View<'_>], x: &Point3<f64>) -> usize {
    let (mut seen, mut against) = (0, 0);
    for (_, mask, camera) in views {
        let Some(px) = camera.project(x).filter(|px| camera.holds(*px)) else {
            continue;
        };
        seen += 1;
        against += usize::from(!mask.shows(px));
        if against > DISSENT {
            return against;
        }
    }
    if seen * 2 >= views.len() {
        against
    } else {
        DISSENT + 1
    }
}

/// The block around all that is shown.
fn block(views: &[View<'_>], ground: f64, shows: &dyn Fn(&Point3<f64>) -> bool) -> Option<Block> {
    let away = views
        .iter()
        .map(|(_, _, c)| c.centre())
        .map(|c| libm::hypot(c.x, c.y));
    let reach = away.fold(f64::MAX, f64::min) * 0.8;
    let step = reach / 40.0;
    let (mut lo, mut hi) = ([f64::MAX; 3], [f64::MIN; 3]);
    for k in 0..120 {
        for (i, j) in (-40..=40).flat_map(|i| (-40..=40).map(move |j| (i, j))) {
            let x = [
                f64::from(i) * step,
                f64::from(j) * step,
                ground + (f64::from(k) + 0.5) * step,
            ];
            if libm::hypot(x[0], x[1]) < reach && shows(&Point3::from(x)) {
                (0..3).for_each(|a| {
                    (lo[a], hi[a]) = (lo[a].min(x[a] - step), hi[a].max(x[a] + step))
                });
            }
        }
    }
    if lo[0] > hi[0] {
        return None;
    }
    lo[2] = lo[2].max(ground);
    let cell = (0..3).map(|a| hi[a] - lo[a]).fold(0.0, f64::max) / CELLS;
    let margin = cell * (COAT + 1) as f64;
    let count = [0, 1, 2].map(|a| ((hi[a] - lo[a] + 2.0 * margin) / cell) as usize + 1);
    Some(Block {
        origin: Point3::new(lo[0] - margin, lo[1] - margin, lo[2]),
        cell,
        count,
    })
}

/// What the block says of the pixels of one photo.
fn projected(
    mask: &Mask,
    camera: &Camera,
    block: &Block,
    core: &[bool],
    coat: &[bool],
) -> Vec<Known> {
    let mut known = vec![Known::Background; mask.data.len()];
    let mut paint = |i: usize, size: f64, kind: Known| {
        let Some((px, depth)) = camera.project_with_depth(&block.centre(i)) else {
            return;
        };
        let r = (block.cell * size * camera.lens.focal[0] / depth).ceil() as i64;
        let (cx, cy) = (px.x.round() as i64, px.y.round() as i64);
        for y in (cy - r).max(0)..=(cy + r).min(mask.height as i64 - 1) {
            for x in (cx - r).max(0)..=(cx + r).min(mask.width as i64 - 1) {
                known[y as usize * mask.width + x as usize] = kind;
            }
        }
    };
    (0..coat.len())
        .filter(|i| coat[*i])
        .for_each(|i| paint(i, 0.8, Known::Unknown));
    (0..core.len())
        .filter(|i| core[*i])
        .for_each(|i| paint(i, 0.45, Known::Body));
    known
}
