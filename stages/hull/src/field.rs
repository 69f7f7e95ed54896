//! A solid's distance field, evaluated only where its surface runs.
//!
//! Space is cut into bricks of 16³ cells. A brick whose centre is farther from the surface than
//! its corners can be is not looked into; a brick is looked into, too, when the surface leaves a
//! neighbour towards it. So cost follows the surface, not the volume.

use nalgebra::Point3;
use rayon::prelude::*;

/// Cells along a brick's side (structural: speed alone).
pub const BRICK: usize = 16;
/// Corners along a brick's side (structural).
pub const SIDE: usize = BRICK + 1;

/// A lattice of cubes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lattice {
    /// The first corner. \[mm\]
    pub origin: Point3<f64>,
    /// Edge of a cell. \[mm\]
    pub cell_mm: f64,
    /// Bricks along x, y, z.
    pub bricks: [usize; 3],
}

impl Lattice {
    /// The lattice over a box, with a margin of a brick at least.
    pub fn over(lo: Point3<f64>, hi: Point3<f64>, cell_mm: f64) -> Self {
        let side = cell_mm * BRICK as f64;
        let count = |i: usize| ((hi[i] - lo[i]) / side).ceil().max(0.0) as usize + 2;
        // Corners are at whole multiples of the cell, so that equal solids get equal lattices.
        let first = |i: usize| ((lo[i] / side).floor() - 1.0) * side;
        Lattice {
            origin: Point3::new(first(0), first(1), first(2)),
            cell_mm,
            bricks: [count(0) + 1, count(1) + 1, count(2) + 1],
        }
    }

    /// A corner. \[mm\]
    pub fn corner(&self, x: usize, y: usize, z: usize) -> Point3<f64> {
        self.origin + nalgebra::Vector3::new(x as f64, y as f64, z as f64) * self.cell_mm
    }

    /// How many bricks.
    pub fn count(&self) -> usize {
        self.bricks.iter().product()
    }

    /// A brick's place from its number.
    pub fn place(&self, brick: usize) -> [usize; 3] {
        let [nx, ny, _] = self.bricks;
        [brick % nx, brick / nx % ny, brick / (nx * ny)]
    }
}

/// The corners of the bricks that were looked into: `SIDE`³ values each, x fastest; above 0 is solid.
pub type Bricks = Vec<Option<Vec<f32>>>;

/// How far a cube's corners are from its centre, in halves of its side: √3 (derived), and a part more. The distance to
/// a silhouette's border shrinks slower than space does, but depth and lens distortion bend it a little (structural: a
/// larger one only looks into more blocks).
const STEEP: f64 = 1.732_050_8 * 1.15;
/// Cells along the side of a block, the smallest cube that is looked into or passed over (structural: speed alone).
const BLOCK: usize = 4;

/// The corners of a brick. Where all cubes of [`BLOCK`] cells around a corner are far from the surface
/// it takes the value within one of them, which depends on where the corner is and not on the brick: the
/// neighbours come to the same.
fn filled(
    lattice: &Lattice,
    place: [usize; 3],
    value: &(impl Fn(&Point3<f64>) -> f32 + Sync),
) -> Vec<f32> {
    // The brick's own blocks, and those around it (structural: a brick's own blocks and the next ones).
    const AROUND: usize = BRICK / BLOCK + 2;
    let base = place.map(|b| b * BRICK);
    let half = lattice.cell_mm * BLOCK as f64 / 2.0;
    let reach = (half * STEEP) as f32;
    let mut middles = Vec::with_capacity(AROUND * AROUND * AROUND);
    for i in 0..AROUND * AROUND * AROUND {
        let [u, v, w] = [i % AROUND, i / AROUND % AROUND, i / AROUND / AROUND];
        // Counted in cells from the lattice's first corner, so that equal blocks have equal middles.
        let cells = |b: usize, base: usize| (base + b * BLOCK) as f64 - BLOCK as f64 / 2.0;
        let at = nalgebra::Vector3::new(cells(u, base[0]), cells(v, base[1]), cells(w, base[2]));
        middles.push(value(&(lattice.origin + at * lattice.cell_mm)));
    }
    // The one or two blocks along an axis that a corner belongs to.
    let blocks = |c: usize| [c.div_ceil(BLOCK), c / BLOCK + 1];
    let mut values = Vec::with_capacity(SIDE * SIDE * SIDE);
    for z in 0..SIDE {
        for y in 0..SIDE {
            for x in 0..SIDE {
                let [us, vs, ws] = [blocks(x), blocks(y), blocks(z)];
                let near = (0..8).any(|i| {
                    let at = (ws[i >> 2] * AROUND + vs[i >> 1 & 1]) * AROUND + us[i & 1];
                    middles[at].abs() <= reach
                });
                values.push(match near {
                    true => value(&lattice.corner(base[0] + x, base[1] + y, base[2] + z)),
                    false => middles[(ws[0] * AROUND + vs[0]) * AROUND + us[0]],
                });
            }
        }
    }
    values
}

/// Evaluates `value` \[mm, 1-Lipschitz or nearly so\] where its zero runs. `tick` is called for each
/// layer of bricks and may end the work.
///
/// # Errors
///
/// What `tick` answers: the user asked to stop.
pub fn evaluate<E: Send>(
    lattice: &Lattice,
    value: &(impl Fn(&Point3<f64>) -> f32 + Sync),
    tick: &(impl Fn() -> Result<(), E> + Sync),
) -> Result<Bricks, E> {
    let [nx, ny, nz] = lattice.bricks;
    let half = lattice.cell_mm * BRICK as f64 / 2.0;
    let reach = (half * STEEP) as f32;
    let fill = |brick: usize| filled(lattice, lattice.place(brick), value);
    let layer = |z: usize| -> Result<Vec<Option<Vec<f32>>>, E> {
        tick()?;
        let one = |i: usize| {
            let brick = z * nx * ny + i;
            let [bx, by, bz] = lattice.place(brick).map(|b| b * BRICK);
            let centre = lattice.corner(bx, by, bz) + nalgebra::Vector3::repeat(half);
            (value(&centre).abs() <= reach).then(|| fill(brick))
        };
        Ok((0..nx * ny).map(one).collect())
    };
    let layers: Vec<_> = (0..nz)
        .into_par_iter()
        .map(layer)
        .collect::<Result<_, E>>()?;
    let mut bricks: Bricks = layers.into_iter().flatten().collect();
    let mut open: Vec<usize> = (0..bricks.len()).filter(|b| bricks[*b].is_some()).collect();
    while let Some(brick) = open.pop() {
        for next in left_towards(lattice, brick, &bricks) {
            bricks[next] = Some(fill(next));
            open.push(next);
        }
    }
    Ok(bricks)
}

/// The neighbours that the surface enters from a brick and that nobody looked into.
fn left_towards(lattice: &Lattice, brick: usize, bricks: &Bricks) -> Vec<usize> {
    let Some(values) = &bricks[brick] else {
        return vec![];
    };
    let (place, [nx, ny, _]) = (lattice.place(brick), lattice.bricks);
    let strides = [1, nx, nx * ny];
    let mut entered = Vec::new();
    for axis in 0..3 {
        for (end, at) in [(0usize, 0usize), (1, BRICK)] {
            let outside = if end == 0 {
                place[axis] == 0
            } else {
                place[axis] + 1 == lattice.bricks[axis]
            };
            if outside {
                continue;
            }
            let next = if end == 0 {
                brick - strides[axis]
            } else {
                brick + strides[axis]
            };
            if bricks[next].is_some() {
                continue;
            }
            let (mut solid, mut empty) = (false, false);
            for i in 0..SIDE * SIDE {
                let (u, v) = (i % SIDE, i / SIDE);
                let [x, y, z] = match axis {
                    0 => [at, u, v],
                    1 => [u, at, v],
                    _ => [u, v, at],
                };
                let s = values[(z * SIDE + y) * SIDE + x] > 0.0;
                (solid, empty) = (solid | s, empty | !s);
            }
            if solid && empty {
                entered.push(next);
            }
        }
    }
    entered
}
