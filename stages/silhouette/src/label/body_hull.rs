//! The hull of the bodies on all photos, in cells finer than those by which photos agree.

use crate::label::consensus::{Block, Together};
use nalgebra::{Point3, Vector3};
use rayon::prelude::*;
use shape::HullCells;
use std::ops::Range;

/// Cells along the body's height.
const CELLS: f64 = 200.0;

/// The hull of all photos of which one may dissent.
pub(crate) struct Hull {
    block: Block,
    solid: Vec<bool>,
    /// \[mm\]
    pub(crate) height: f64,
    middle: Point3<f64>,
}

impl From<&HullCells> for Hull {
    fn from(cells: &HullCells) -> Self {
        Hull {
            block: Block {
                origin: cells.origin_mm.into(),
                cell: cells.cell_mm,
                count: cells.count.map(|n| n as usize),
            },
            solid: cells.solid.clone(),
            height: cells.height_mm,
            middle: cells.middle_mm.into(),
        }
    }
}

impl Hull {
    /// As it is stored.
    pub(crate) fn cells(&self) -> HullCells {
        HullCells {
            origin_mm: self.block.origin.into(),
            cell_mm: self.block.cell,
            count: self.block.count.map(|n| n as u32),
            solid: self.solid.clone(),
            height_mm: self.height,
            middle_mm: self.middle.into(),
        }
    }

    /// `None` if nothing is left of it.
    pub(crate) fn of(all: &Together<'_>) -> Option<Self> {
        let rough = &all.block;
        let layer = rough.count[0] * rough.count[1];
        let solid = |i: &usize| all.against[*i] <= 1;
        let (mut lo, mut hi) = (Vector3::repeat(f64::MAX), Vector3::repeat(f64::MIN));
        let layers = tallest(rough.count[2], &|z| {
            (z * layer..(z + 1) * layer).any(|i| solid(&i))
        });
        for i in (layers.start * layer..layers.end * layer).filter(solid) {
            let at = rough.centre(i).coords;
            (lo, hi) = (lo.inf(&at), hi.sup(&at));
        }
        if lo.z > hi.z {
            return None;
        }
        let side = Vector3::repeat(rough.cell);
        let (lo, hi) = (lo - side, hi + side);
        let height = hi.z - lo.z - rough.cell;
        let cell = height / CELLS;
        let block = Block {
            origin: lo.into(),
            cell,
            count: [0, 1, 2].map(|a| ((hi[a] - lo[a]) / cell) as usize + 1),
        };
        let cells: usize = block.count.iter().product();
        let solid = (0..cells)
            .into_par_iter()
            .map(|i| all.against(&block.centre(i)) <= 1)
            .collect();
        Some(Hull {
            middle: nalgebra::center(&lo.into(), &hi.into()),
            block,
            solid,
            height,
        })
    }

    /// How far a ray passes through the hull, or at least a share of its height. \[mm\]
    pub(crate) fn along(&self, from: &Point3<f64>, ray: &Vector3<f64>, share: f64) -> f64 {
        let (block, step) = (&self.block, self.block.cell);
        let enough = (share * self.height / step) as usize + 1;
        let middle = (self.middle - from).dot(ray);
        let [x, y, _] = block.count;
        let reach = libm::hypot(x as f64, y as f64) as i64;
        let inside = |k: &i64| {
            let at = (from + ray * (middle + *k as f64 * step) - block.origin) / block.cell;
            let cell = [0, 1, 2].map(|a| at[a].round());
            let within = (0..3).all(|a| cell[a] >= 0.0 && cell[a] < block.count[a] as f64);
            let [x, y, z] = cell.map(|v| v as usize);
            within && self.solid[(z * block.count[1] + y) * block.count[0] + x]
        };
        (-reach..=reach).filter(inside).take(enough).count() as f64 * step
    }
}

/// The longest run of layers that hold something: what many photos cannot see may hold a cell by itself.
fn tallest(count: usize, holds: &dyn Fn(usize) -> bool) -> Range<usize> {
    let (mut best, mut start) = (0..0, 0);
    for z in 0..count {
        if !holds(z) {
            start = z + 1;
        } else if z + 1 - start > best.len() {
            best = start..z + 1;
        }
    }
    best
}
