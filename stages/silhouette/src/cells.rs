//! A block of cells about the subject, what of it photos see, and how it looks on a photo.

use crate::scene::still_and_disk::Shot;
use nalgebra::{Point3, Vector3};
use rayon::prelude::*;
use shape::{Camera, Image};

/// A block of cells, x fastest.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Block {
    /// The corner with the least coordinates. \[mm\]
    pub(crate) corner: Point3<f64>,
    /// Edge of a cell. \[mm\]
    pub(crate) cell: f64,
    /// How many cells along x, y and z.
    pub(crate) count: [usize; 3],
}

impl Block {
    /// A block between two corners, with so many cells along its greatest side.
    pub(crate) fn between(lo: [f64; 3], hi: [f64; 3], cells: usize) -> Block {
        let greatest = (0..3).map(|a| hi[a] - lo[a]).fold(0.0, f64::max);
        let cell = greatest / cells.max(1) as f64;
        let count = [0, 1, 2].map(|a| (((hi[a] - lo[a]) / cell - 1e-9).ceil() as usize).max(1));
        Block {
            corner: lo.into(),
            cell,
            count,
        }
    }

    /// How many cells.
    pub(crate) fn len(&self) -> usize {
        self.count.iter().product()
    }

    /// Place of a cell along x, y and z.
    pub(crate) fn at(&self, i: usize) -> [usize; 3] {
        let [nx, ny, _] = self.count;
        [i % nx, i / nx % ny, i / nx / ny]
    }

    /// Centre of a cell. \[mm\]
    pub(crate) fn centre(&self, i: usize) -> Point3<f64> {
        let at = self.at(i).map(|n| n as f64 + 0.5);
        self.corner + Vector3::from(at) * self.cell
    }

    /// The cell that holds a point.
    pub(crate) fn cell_of(&self, x: &Point3<f64>) -> Option<usize> {
        let at = (x - self.corner) / self.cell;
        let inside = (0..3).all(|a| at[a] >= 0.0 && at[a] < self.count[a] as f64);
        let [nx, ny, _] = self.count;
        inside.then(|| (at.z as usize * ny + at.y as usize) * nx + at.x as usize)
    }

    /// The six cells beside one that are in the block, by axis and direction.
    pub(crate) fn beside(&self, i: usize) -> impl Iterator<Item = usize> {
        let [nx, ny, nz] = self.count;
        let at = self.at(i);
        let strides = [1, nx, nx * ny];
        (0..3).flat_map(move |a| {
            let below = (at[a] > 0).then(|| i - strides[a]);
            let above = (at[a] + 1 < [nx, ny, nz][a]).then(|| i + strides[a]);
            [below, above].into_iter().flatten()
        })
    }

    /// How many photos hold each cell.
    pub(crate) fn seen(&self, shots: &[Shot]) -> Vec<u16> {
        let count = |i: usize| {
            let x = self.centre(i);
            let holds = |s: &&Shot| s.camera.project(&x).is_some_and(|px| s.camera.holds(px));
            shots.iter().filter(holds).count() as u16
        };
        (0..self.len()).into_par_iter().map(count).collect()
    }

    /// The pixels of a photo that cells cover.
    pub(crate) fn shown(
        &self,
        solid: &[bool],
        camera: &Camera,
        width: usize,
        height: usize,
    ) -> Image<bool> {
        let mut shown = Image::filled(width, height, false);
        // A cell with the subject all around shows nothing that its neighbours don't.
        let bare = |i: &usize| {
            let mut beside = 0;
            let covered = self.beside(*i).all(|j| {
                beside += 1;
                solid[j]
            });
            solid[*i] && !(covered && beside == 6)
        };
        for i in (0..self.len()).filter(bare) {
            let Some((px, depth)) = camera.project_with_depth(&self.centre(i)) else {
                continue;
            };
            // A cube's outline reaches a little further than half of its edge.
            let r = 0.6 * self.cell * camera.lens.focal[0] / depth;
            let range = |c: f64, size: usize| {
                let within = |at: f64| at.clamp(0.0, size as f64) as usize;
                let (from, to) = (within((c - r).ceil()), within((c + r).floor() + 1.0));
                from..to.max(from)
            };
            for y in range(px.y, height) {
                shown.data[y * width..][range(px.x, width)].fill(true);
            }
        }
        filled(shown)
    }

    /// Cells and those beside them.
    pub(crate) fn grown(&self, solid: &[bool]) -> Vec<bool> {
        let one = |i: usize| solid[i] || self.beside(i).any(|j| solid[j]);
        (0..solid.len()).into_par_iter().map(one).collect()
    }

    /// The greatest part of cells that no gap of more than two cells parts: a neck may be lost where
    /// cells are coarse.
    pub(crate) fn largest(&self, solid: &[bool]) -> Vec<bool> {
        let all = self.connected(&self.grown(solid));
        all.iter().zip(solid).map(|(a, b)| *a && *b).collect()
    }

    /// The greatest connected part (six neighbours) of cells.
    fn connected(&self, solid: &[bool]) -> Vec<bool> {
        let mut part = vec![u32::MAX; solid.len()];
        let mut sizes: Vec<usize> = Vec::new();
        for start in 0..solid.len() {
            if !solid[start] || part[start] != u32::MAX {
                continue;
            }
            let number = sizes.len() as u32;
            let (mut open, mut size) = (vec![start], 0);
            part[start] = number;
            while let Some(i) = open.pop() {
                size += 1;
                for j in self.beside(i) {
                    if solid[j] && part[j] == u32::MAX {
                        part[j] = number;
                        open.push(j);
                    }
                }
            }
            sizes.push(size);
        }
        let best = (0..sizes.len()).max_by_key(|p| (sizes[*p], usize::MAX - p));
        part.iter()
            .map(|p| best.is_some_and(|b| *p == b as u32))
            .collect()
    }

    /// The box around cells, wider by some cells, as its two corners. \[mm\]
    pub(crate) fn around(&self, solid: &[bool], more: f64) -> Option<([f64; 3], [f64; 3])> {
        let (mut lo, mut hi) = ([f64::MAX; 3], [f64::MIN; 3]);
        for i in (0..solid.len()).filter(|i| solid[*i]) {
            let x = self.centre(i);
            let reach = (0.5 + more) * self.cell;
            for a in 0..3 {
                (lo[a], hi[a]) = (lo[a].min(x[a] - reach), hi[a].max(x[a] + reach));
            }
        }
        (lo[0] < hi[0]).then_some((lo, hi))
    }
}

/// Without gaps of one pixel, which are between the squares of cells.
fn filled(shown: Image<bool>) -> Image<bool> {
    let (w, h) = (shown.width, shown.height);
    let mut all = shown.clone();
    for y in 1..h.saturating_sub(1) {
        for x in 1..w.saturating_sub(1) {
            let beside = shown.at(x - 1, y) && shown.at(x + 1, y);
            let above = shown.at(x, y - 1) && shown.at(x, y + 1);
            *all.at_mut(x, y) |= beside || above;
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use shape::Intrinsics;

    #[test]
    fn a_cell_beside_a_photos_last_row_shows_nothing() {
        let from = Point3::new(0.0, -1000.0, 0.0);
        let lens = Intrinsics::simple(40, 30, 100.0);
        let camera = Camera::looking(lens, from, Point3::origin());
        let shown = |x: f64| {
            let block = Block {
                corner: Point3::new(x, 0.0, -150.0),
                cell: 20.0,
                count: [1; 3],
            };
            let all = block.shown(&[true], &camera, 40, 30).data;
            all.into_iter().filter(|pixel| *pixel).count()
        };
        assert!(shown(0.0) > 0 && shown(190.0) > 0);
        assert_eq!([shown(300.0), shown(-300.0)], [0, 0]);
    }
}
