//! The cells around the body, and how many photos show each of them as background.

use crate::cells::Block;
use nalgebra::Point3;
use rayon::prelude::*;
use shape::{Camera, Cameras, Mask, PhotoId};

/// Cells along the greatest side of the block that is carved. By hand: not on record.
const CELLS_ALONG: f64 = 210.0;
/// Photos that may dissent: one is the photo in question, one more may be wrong. By hand: not on record.
pub(crate) const DISSENT: usize = 2;
/// Cells around all that is shown (structural).
const MARGIN: f64 = 4.0;

impl Block {
    /// How many steps (six ways) each cell is from the nearest that is so, `most` at most.
    pub(crate) fn steps_to(&self, such: &[bool], most: u8) -> Vec<u8> {
        let [nx, ny, nz] = self.count;
        let rows = ny * nz;
        let mut steps: Vec<u8> = such.iter().map(|s| if *s { 0 } else { most }).collect();
        // Onward, then back: by the rows beside that were gone through, then along the row.
        for row in 0..rows {
            let (before, here) = steps.split_at_mut(row * nx);
            let here = &mut here[..nx];
            if row % ny > 0 {
                nearer(here, &before[(row - 1) * nx..]);
            }
            if row >= ny {
                nearer(here, &before[(row - ny) * nx..]);
            }
            along(here.iter_mut());
        }
        for row in (0..rows).rev() {
            let (here, beyond) = steps.split_at_mut((row + 1) * nx);
            let here = &mut here[row * nx..];
            if row % ny + 1 < ny {
                nearer(here, beyond);
            }
            if row + ny < rows {
                nearer(here, &beyond[(ny - 1) * nx..]);
            }
            along(here.iter_mut().rev());
        }
        steps
    }
}

/// A step more than beside, where that is nearer.
fn nearer(here: &mut [u8], beside: &[u8]) {
    let both = here.iter_mut().zip(beside);
    both.for_each(|(here, beside)| *here = (*here).min(beside.saturating_add(1)));
}

/// The same from each to the next.
fn along<'a>(row: impl Iterator<Item = &'a mut u8>) {
    let mut last = u8::MAX;
    for here in row {
        *here = (*here).min(last.saturating_add(1));
        last = *here;
    }
}

/// A mask with its photo and the camera at its size.
pub(crate) type View<'a> = (PhotoId, &'a Mask, Camera);

/// A block around the body, with how many masks have each cell outside.
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
        let against: Vec<usize> = (0..block.len())
            .into_par_iter()
            .map(|i| against(&views, &block.centre(i)))
            .collect();
        Some(Together {
            views,
            block,
            against,
        })
    }
}

/// How many masks have a point outside, at most one more than may.
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
    let cell = (0..3).map(|a| hi[a] - lo[a]).fold(0.0, f64::max) / CELLS_ALONG;
    let margin = cell * MARGIN;
    let count = [0, 1, 2].map(|a| ((hi[a] - lo[a] + 2.0 * margin) / cell) as usize + 1);
    // The lowest cells are cut through by the ground.
    let half = cell / 2.0;
    Some(Block {
        corner: Point3::new(lo[0] - margin - half, lo[1] - margin - half, lo[2] - half),
        cell,
        count,
    })
}
