//! A solid's surface as a closed mesh: dual marching cubes (Nielson 2004), vertices moved onto the surface.

use crate::field::{Field, STEEP};
use nalgebra::{Point3, Vector3};
use rayon::prelude::*;
use shape::{Mesh, Solid};

/// Cells a block has along each side (structural: speed alone).
const BLOCK: usize = 8;
/// A cell that the surface passes.
struct Cell {
    key: u64,
    /// Which corners are inside; bit x + 2 y + 4 z.
    inside: u8,
    /// The patch of each edge that crosses the surface; see [`edge`].
    patch: [u8; 12],
    /// One vertex a patch.
    at: Vec<Point3<f64>>,
}

/// Cells along x, y, z.
struct Grid {
    low: Point3<f64>,
    cell_mm: f64,
    blocks: [usize; 3],
}

impl Grid {
    fn key(&self, c: [usize; 3]) -> u64 {
        let [nx, ny, _] = self.blocks.map(|b| b * BLOCK);
        ((c[2] * ny + c[1]) * nx + c[0]) as u64
    }

    fn corner(&self, c: [usize; 3]) -> Point3<f64> {
        self.low + Vector3::new(c[0] as f64, c[1] as f64, c[2] as f64) * self.cell_mm
    }
}

/// The surface of a solid between two corners, in cells of a size. \[mm\] Faces look outward.
pub fn surface(solid: &Solid, low: Point3<f64>, high: Point3<f64>, cell_mm: f64) -> Mesh {
    let field = Field::new(solid);
    let margin = Vector3::from_element(2.5 * cell_mm);
    let low = low - margin;
    let span = high + margin - low;
    let blocks =
        [span.x, span.y, span.z].map(|s| (s / (cell_mm * BLOCK as f64)).ceil().max(1.0) as usize);
    let grid = Grid {
        low,
        cell_mm,
        blocks,
    };
    let count = blocks[0] * blocks[1] * blocks[2];
    let found: Vec<Vec<Cell>> = (0..count)
        .into_par_iter()
        .map(|b| block_cells(&field, &grid, b))
        .collect();
    let mut cells: Vec<Cell> = found.into_iter().flatten().collect();
    cells.par_sort_unstable_by_key(|c| c.key);
    let points: Vec<Point3<f64>> = cells.iter().flat_map(|c| c.at.iter().copied()).collect();
    let faces = faces(&grid, &cells, &points);
    let positions = points.iter().map(|p| p.coords.map(|x| x as f32).into());
    Mesh {
        positions: positions.collect(),
        faces,
        ..Mesh::default()
    }
}

/// The cells of one block that the surface passes.
fn block_cells(field: &Field<'_>, grid: &Grid, block: usize) -> Vec<Cell> {
    let [bx, by, _] = grid.blocks;
    let first = [block % bx, block / bx % by, block / (bx * by)].map(|b| b * BLOCK);
    let mut block = Block {
        field,
        grid,
        first,
        values: vec![f64::NAN; SIDE * SIDE * SIDE],
        cells: Vec::new(),
    };
    block.look([0; 3], BLOCK);
    block.cells
}

/// Corners along a block (structural: a block's corners).
const SIDE: usize = BLOCK + 1;

/// A block that is looked through.
struct Block<'a> {
    field: &'a Field<'a>,
    grid: &'a Grid,
    /// Its first cell.
    first: [usize; 3],
    /// At its corners, as far as they were asked for, and no number elsewhere.
    values: Vec<f64>,
    cells: Vec<Cell>,
}

impl Block<'_> {
    /// The field at a corner of the block.
    fn value(&mut self, [x, y, z]: [usize; 3]) -> f64 {
        let at = (z * SIDE + y) * SIDE + x;
        if self.values[at].is_nan() {
            let [i, j, k] = self.first;
            self.values[at] = self.field.value(&self.grid.corner([i + x, j + y, k + z]));
        }
        self.values[at]
    }

    /// Looks for cells in a cube of the block, halved until no surface can be in it.
    fn look(&mut self, low: [usize; 3], side: usize) {
        let half = side / 2;
        let reach = STEEP * self.grid.cell_mm * half as f64 * 3f64.sqrt();
        if self.value(low.map(|c| c + half)).abs() > reach {
            return;
        }
        for part in 0..8 {
            let low = std::array::from_fn(|axis| low[axis] + half * (part >> axis & 1));
            match half {
                1 => self.take(low),
                _ => self.look(low, half),
            }
        }
    }

    /// Takes a cell, if the surface passes it.
    fn take(&mut self, low: [usize; 3]) {
        let corners: [f64; 8] = std::array::from_fn(|i| {
            self.value(std::array::from_fn(|axis| low[axis] + (i >> axis & 1)))
        });
        let inside = (0..8).fold(0u8, |bits, i| bits | u8::from(corners[i] < 0.0) << i);
        if inside == 0 || inside == 255 {
            return;
        }
        let c = std::array::from_fn(|axis| self.first[axis] + low[axis]);
        let (patch, starts) = patches(inside, &|i| corners[i]);
        let start = self.grid.corner(c);
        let onto = |off: &Vector3<f64>| self.field.onto(&(start + off * self.grid.cell_mm));
        self.cells.push(Cell {
            key: self.grid.key(c),
            inside,
            patch,
            at: starts.iter().map(onto).collect(),
        });
    }
}

/// The number of the edge along an axis from a corner whose bit of that axis is 0.
fn edge(axis: usize, from: usize) -> usize {
    axis * 4 + (from >> ((axis + 1) % 3) & 1) + 2 * (from >> ((axis + 2) % 3) & 1)
}

/// The patches of the surface in a cell: which patch each crossing edge belongs to, and the mean of
/// each patch's crossings, in cells from the low corner. Crossings of a face belong together in
/// pairs; of four, those around a corner that is inside.
fn patches(inside: u8, corner: &dyn Fn(usize) -> f64) -> ([u8; 12], Vec<Vector3<f64>>) {
    let is_in = |c: usize| inside >> c & 1 == 1;
    let mut group: [u8; 12] = std::array::from_fn(|i| i as u8);
    let mut join = |a: usize, b: usize| {
        let (low, high) = (group[a].min(group[b]), group[a].max(group[b]));
        group
            .iter_mut()
            .filter(|g| **g == high)
            .for_each(|g| *g = low);
    };
    for axis in 0..3 {
        let (u, v) = (1usize << ((axis + 1) % 3), 1usize << ((axis + 2) % 3));
        for base in [0, 1 << axis] {
            let around = [base, base + u, base + u + v, base + v];
            let between = |i: usize| {
                let (a, b) = (around[i % 4], around[(i + 1) % 4]);
                let along = (a ^ b).trailing_zeros() as usize;
                (edge(along, a & b), is_in(a) != is_in(b))
            };
            let crossing: Vec<usize> = (0..4)
                .map(between)
                .filter(|(_, c)| *c)
                .map(|(e, _)| e)
                .collect();
            if crossing.len() == 2 {
                join(crossing[0], crossing[1]);
            } else if crossing.len() == 4 {
                for i in (0..4).filter(|i| is_in(around[*i])) {
                    join(between(i).0, between(i + 3).0);
                }
            }
        }
    }
    let (mut names, mut sums) = (vec![], vec![]);
    let mut patch = [0; 12];
    for axis in 0..3 {
        for a in (0..8usize).filter(|a| a >> axis & 1 == 0) {
            let b = a | 1 << axis;
            if is_in(a) == is_in(b) {
                continue;
            }
            let own = group[edge(axis, a)];
            let at = names.iter().position(|n| *n == own).unwrap_or_else(|| {
                names.push(own);
                sums.push((Vector3::zeros(), 0.0));
                names.len() - 1
            });
            patch[edge(axis, a)] = at as u8;
            let mut place = Vector3::from_fn(|i, _| (a >> i & 1) as f64);
            place[axis] = corner(a) / (corner(a) - corner(b));
            sums[at].0 += place;
            sums[at].1 += 1.0;
        }
    }
    (patch, sums.into_iter().map(|(sum, n)| sum / n).collect())
}

/// Two triangles for each grid edge that crosses the surface: between the four cells around it.
fn faces(grid: &Grid, cells: &[Cell], points: &[Point3<f64>]) -> Vec<[u32; 3]> {
    let [nx, ny, _] = grid.blocks.map(|b| (b * BLOCK) as u64);
    let stride = [1, nx, nx * ny];
    let mut first = vec![0u32];
    cells
        .iter()
        .for_each(|c| first.push(first[first.len() - 1] + c.at.len() as u32));
    let vertex = |key: u64, edge: usize| {
        let cell = cells.binary_search_by_key(&key, |c| c.key).ok()?;
        Some(first[cell] + u32::from(cells[cell].patch[edge]))
    };
    let mut faces = Vec::new();
    for cell in cells {
        for axis in 0..3 {
            let (low, high) = (cell.inside & 1 != 0, cell.inside >> (1 << axis) & 1 != 0);
            if low == high {
                continue;
            }
            let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
            let (u, v) = (stride[i], stride[j]);
            // At the grid's low sides there are no four cells; a surface that leaves it ends there.
            let place = [cell.key % nx, cell.key / nx % ny, cell.key / (nx * ny)];
            if place[i] == 0 || place[j] == 0 {
                continue;
            }
            let (bu, bv) = (1 << i, 1 << j);
            let around = [(0, 0), (u, bu), (u + v, bu | bv), (v, bv)].map(|(back, from)| {
                let key = cell.key.checked_sub(back)?;
                vertex(key, edge(axis, from))
            });
            let [Some(a), Some(b), Some(c), Some(d)] = around else {
                continue;
            };
            // The shorter diagonal gives the better triangles.
            let long = |i: u32, j: u32| (points[i as usize] - points[j as usize]).norm();
            let two = if long(a, c) <= long(b, d) {
                [[a, b, c], [a, c, d]]
            } else {
                [[a, b, d], [b, c, d]]
            };
            // With the low end inside, the surface looks along the axis.
            faces.extend(two.map(|[i, j, k]| if low { [i, j, k] } else { [i, k, j] }));
        }
    }
    faces
}
