//! Where each photo shows the body that stands still: how it deformed while it was photographed.

use crate::ByPhoto;
use crate::PhotoId;
use stage::{Artifact, Corrupt, Packer, Unpacker};

/// A smooth field of offsets over a photo, free of distortion: what should be seen at a pixel is
/// seen at the pixel plus the offset there.
#[derive(Debug, Clone, PartialEq)]
pub struct Warp {
    /// Distance of two nodes; the first lies on the first pixel. \[px\]
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
        let place = |x: f64, nodes: usize| {
            let x = (x / self.cell_px).clamp(0.0, nodes as f64 - 1.0);
            let cell = (x as usize).min(nodes.saturating_sub(2));
            (cell, x - cell as f64)
        };
        let ((i, u), (j, v)) = (place(at[0], self.columns), place(at[1], self.rows()));
        let k = j * self.columns + i;
        [
            (k, (1.0 - u) * (1.0 - v)),
            (k + 1, u * (1.0 - v)),
            (k + self.columns, (1.0 - u) * v),
            (k + self.columns + 1, u * v),
        ]
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
