//! Where each photo shows the body at rest: how it deformed while it was photographed.

use crate::ByPhoto;
use crate::PhotoId;
use stage::{Artifact, Corrupt, Packer, Unpacker};
use std::ops::Range;

/// A smooth field of offsets over a photo, free of distortion: what should be seen at a pixel is
/// seen at the pixel plus the offset there.
#[derive(Debug, Clone, PartialEq)]
pub struct Warp {
    /// Distance of two nodes; the first is on the first pixel. \[px\]
    pub cell_px: f64,
    /// Nodes in a row.
    pub columns: usize,
    /// Nodes row by row: column, row. \[px\]
    pub offsets: Vec<[f32; 2]>,
}

impl Warp {
    /// Nodes enough for a photo, no offset anywhere.
    pub fn none(width: usize, height: usize, cell_px: f64) -> Self {
        let nodes = |n: usize| (n.saturating_sub(1) as f64 / cell_px).ceil() as usize + 1;
        Warp {
            cell_px,
            columns: nodes(width).max(2),
            offsets: vec![[0.0; 2]; nodes(width).max(2) * nodes(height).max(2)],
        }
    }

    /// Nodes in a column.
    pub fn rows(&self) -> usize {
        self.offsets.len() / self.columns.max(1)
    }

    /// The four nodes around a pixel, and how much each counts.
    #[inline]
    pub fn around(&self, at: [f64; 2]) -> [(usize, f64); 4] {
        let ((i, u), (j, v)) = (
            self.place(at[0], self.columns),
            self.place(at[1], self.rows()),
        );
        let k = j * self.columns + i;
        let nodes = [k, k + 1, k + self.columns, k + self.columns + 1];
        let shares = shares(u, v);
        [0, 1, 2, 3].map(|n| (nodes[n], shares[n]))
    }

    /// The node before a pixel along one side with so many nodes, and how far it is past that.
    #[inline]
    fn place(&self, x: f64, nodes: usize) -> (usize, f64) {
        let x = (x / self.cell_px).clamp(0.0, nodes as f64 - 1.0);
        let cell = (x as usize).min(nodes.saturating_sub(2));
        (cell, x - cell as f64)
    }

    /// The offset at a pixel, bilinear. \[px\]
    #[inline]
    pub fn at(&self, at: [f64; 2]) -> [f64; 2] {
        let mut sum = [0.0; 2];
        for (node, share) in self.around(at) {
            let offset = self.offsets[node];
            sum[0] += share * f64::from(offset[0]);
            sum[1] += share * f64::from(offset[1]);
        }
        sum
    }

    /// The offsets row by row, at the same columns in each. \[px\]
    pub fn rows_at(&self, columns: &[f64]) -> WarpRows<'_> {
        let places = columns.iter().map(|x| self.place(*x, self.columns));
        let (cells, across): (Vec<usize>, Vec<f64>) = places.unzip();
        let mut runs: Vec<(usize, Range<usize>)> = vec![];
        for run in cells.chunk_by(|a, b| a == b) {
            let from = runs.last().map_or(0, |r| r.1.end);
            runs.push((run[0], from..from + run.len()));
        }
        WarpRows {
            warp: self,
            runs,
            across,
        }
    }
}

/// A warp at the same columns in every row: [`Warp::at`], byte for byte, without looking nodes up at each pixel.
pub struct WarpRows<'a> {
    warp: &'a Warp,
    /// Runs of columns between the same two nodes: the node before, the columns.
    runs: Vec<(usize, Range<usize>)>,
    /// How far each column is past that node, 0..=1.
    across: Vec<f64>,
}

impl WarpRows<'_> {
    /// Hands the offset at each column of a row to `to`. \[px\]
    #[inline(always)]
    pub fn offsets(&self, row: f64, mut to: impl FnMut(usize, [f64; 2])) {
        let (j, v) = self.warp.place(row, self.warp.rows());
        for (i, columns) in &self.runs {
            let k = j * self.warp.columns + i;
            let nodes = [k, k + 1, k + self.warp.columns, k + self.warp.columns + 1];
            let nodes = nodes.map(|n| self.warp.offsets[n].map(f64::from));
            for x in columns.clone() {
                let shares = shares(self.across[x], v);
                let mut sum = [0.0; 2];
                for n in 0..4 {
                    sum[0] += shares[n] * nodes[n][0];
                    sum[1] += shares[n] * nodes[n][1];
                }
                to(x, sum);
            }
        }
    }
}

/// How much the four nodes around a place between them count.
#[inline(always)]
fn shares(u: f64, v: f64) -> [f64; 4] {
    [(1.0 - u) * (1.0 - v), u * (1.0 - v), (1.0 - u) * v, u * v]
}

/// One warp a photo.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Warps {
    /// The photos that have one.
    pub views: ByPhoto<Warp>,
}

impl Artifact for Warps {
    const KIND: &'static str = "warps";
    const FORMAT: u32 = 1;

    fn pack(&self, to: &mut Packer) {
        let views = self.views.iter();
        let sizes: Vec<(u32, f64, u32)> = views
            .map(|(id, w)| (id.0, w.cell_px, w.columns as u32))
            .collect();
        to.meta(&sizes);
        for (id, warp) in self.views.iter() {
            to.section(format!("warp {}", id.0), &warp.offsets);
        }
    }

    fn unpack(from: &Unpacker<'_>) -> Result<Self, Corrupt> {
        let sizes: Vec<(u32, f64, u32)> = from.meta()?;
        let warp = |(id, cell_px, columns): (u32, f64, u32)| {
            let offsets: Vec<[f32; 2]> = from.section(&format!("warp {id}"))?;
            let columns = columns as usize;
            let whole = columns >= 2 && offsets.len() >= 2 * columns;
            let even = columns > 0 && offsets.len().is_multiple_of(columns);
            if !whole || !even || cell_px.is_nan() || cell_px <= 0.0 {
                return Err(Corrupt(format!("warp {id} has no whole rows")));
            }
            let warp = Warp {
                cell_px,
                columns,
                offsets,
            };
            Ok((PhotoId(id), warp))
        };
        let views = sizes
            .into_iter()
            .map(warp)
            .collect::<Result<_, Corrupt>>()?;
        Ok(Warps { views })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_linear_field_is_kept_and_a_file_gives_it_back() {
        let mut warp = Warp::none(100, 60, 16.0);
        assert_eq!((warp.columns, warp.rows()), (8, 5));
        for (k, o) in warp.offsets.iter_mut().enumerate() {
            let (x, y) = ((k % 8) as f32 * 16.0, (k / 8) as f32 * 16.0);
            *o = [0.1 * x - 0.2 * y, 3.0];
        }
        let at = warp.at([37.5, 21.0]);
        assert!((at[0] - (3.75 - 4.2)).abs() < 1e-5 && (at[1] - 3.0).abs() < 1e-6);
        assert_eq!(warp.at([-50.0, -50.0]), warp.at([0.0, 0.0]));
        let all = Warps {
            views: [(PhotoId(2), warp)].into_iter().collect(),
        };
        let bytes = stage::to_bytes(&all);
        assert_eq!(stage::from_bytes::<Warps>(&bytes).unwrap(), all);
    }
}
