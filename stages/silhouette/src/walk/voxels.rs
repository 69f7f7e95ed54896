//! Which cells are the subject: the evidence of every photo for each, and a least cut through the block.

use crate::cells::Block;
use crate::cut::least_cut::UNIT;
use crate::cut::maxflow::Grid;
use crate::scene::still_and_disk::Shot;
use rayon::prelude::*;
use shape::Image;

/// How sure one photo is, and how many rays that miss a cell hit the subject elsewhere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Belief {
    /// How often the colours of a pixel mislead.
    pub(crate) misled: f32,
    /// How often a ray past a free cell shows the subject all the same.
    pub(crate) behind: f32,
}

impl Belief {
    /// ln p(pixel | cell is body) − ln p(pixel | cell is free), by the pixel's colour:
    /// background seen there frees the cell, a subject seen there may be before or behind it.
    pub(crate) fn reported(&self, favour: f32) -> f32 {
        let r = libm::expf(favour.clamp(-12.0, 12.0));
        let body = (1.0 - self.misled) * r + self.misled;
        let free = self.behind * r + 1.0 - self.behind;
        libm::logf(body / free)
    }
}

/// The evidence of all photos for each cell; cells that `closed` names have none.
pub(crate) fn evidence(
    block: &Block,
    shots: &[Shot],
    reported: &[Image<f32>],
    closed: &[bool],
) -> Vec<f32> {
    let one = |i: usize| {
        if closed[i] {
            return f32::NEG_INFINITY;
        }
        let x = block.centre(i);
        let (mut sum, mut seen) = (0.0, 0);
        for (shot, reported) in shots.iter().zip(reported) {
            let px = shot.camera.project(&x).filter(|px| shot.camera.holds(*px));
            if let Some(px) = px {
                let (c, r) = (
                    px.x.round().max(0.0) as usize,
                    px.y.round().max(0.0) as usize,
                );
                sum += reported.at(c.min(reported.width - 1), r.min(reported.height - 1));
                seen += 1;
            }
        }
        // As if as many photos as there are had seen it.
        sum * shots.len() as f32 / seen.max(1) as f32
    };
    (0..block.len()).into_par_iter().map(one).collect()
}

/// No evidence counts for more. By hand: looked at a walk (asclepius), at 0.7 and 1.4 of it: nothing changes. \[nats\]
const MOST_NATS: f32 = 40.0;

/// The cells that are the subject: least sum of the evidence against each and of what it
/// costs to part neighbours.
pub(crate) fn solid(block: &Block, evidence: &[f32], smooth: f32) -> Vec<bool> {
    let mut grid = Grid::block(block.count);
    let part = (smooth * UNIT as f32) as i32;
    for (i, e) in evidence.iter().enumerate() {
        let cost = (e.clamp(-MOST_NATS, MOST_NATS) * UNIT as f32) as i32;
        grid.add_cell_terminal(i, cost.max(0), (-cost).max(0));
        let at = block.at(i);
        for axis in 0..3 {
            if at[axis] + 1 < block.count[axis] {
                grid.set_cell_arc(i, axis, part);
            }
        }
    }
    grid.cut();
    (0..block.len())
        .map(|i| grid.cell_on_source_side(i))
        .collect()
}
