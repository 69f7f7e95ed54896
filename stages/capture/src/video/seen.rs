//! A frame of a video at a glance: what can be kept of each of thousands.

use crate::netpbm::Netpbm;

/// Small pictures are about so many pixels on the longer side (structural: size of a small picture). \[px\]
const ACROSS: usize = 96;
/// Sharpness is taken by cells of so many small pixels on a side (structural: samples). \[px\]
const CELL: usize = 4;

/// A frame at a glance.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Seen {
    /// Pixels across of the small picture.
    pub(crate) width: usize,
    /// Brightness, row by row, 0..=255.
    pub(crate) small: Vec<u8>,
    /// Mean square of the Laplacian of brightness in each cell, row by row. \[levels²\]
    pub(crate) edges: Vec<f32>,
}

/// Looks at a grey picture.
pub(crate) fn seen(picture: &Netpbm) -> Seen {
    let block = (picture.width.max(picture.height) / ACROSS).max(1);
    let (width, height) = (picture.width / block, picture.height / block);
    let at = |x: usize, y: usize| u32::from(picture.data[y * picture.width + x]);
    let mut small = Vec::with_capacity(width * height);
    for y in 0..height {
        for x in 0..width {
            let rows = y * block..(y + 1) * block;
            let sum: u32 = rows
                .map(|j| (x * block..(x + 1) * block).map(|i| at(i, j)).sum::<u32>())
                .sum();
            let count = (block * block) as u32;
            small.push(((sum + count / 2) / count) as u8);
        }
    }
    let (cells, side) = (cells(width, height), CELL * block);
    let mut sums = vec![(0u64, 0u64); cells[0] * cells[1]];
    for y in 1..picture.height.saturating_sub(1) {
        for x in 1..picture.width.saturating_sub(1) {
            let cell = (y / side).min(cells[1] - 1) * cells[0] + (x / side).min(cells[0] - 1);
            let around = at(x - 1, y) + at(x + 1, y) + at(x, y - 1) + at(x, y + 1);
            let laplacian = i64::from(around) - 4 * i64::from(at(x, y));
            sums[cell].0 += laplacian.unsigned_abs().pow(2);
            sums[cell].1 += 1;
        }
    }
    let mean = |(sum, count): (u64, u64)| sum as f32 / count.max(1) as f32;
    Seen {
        width,
        small,
        edges: sums.into_iter().map(mean).collect(),
    }
}

/// How many cells a small picture has, across and down.
fn cells(width: usize, height: usize) -> [usize; 2] {
    [width.div_ceil(CELL).max(1), height.div_ceil(CELL).max(1)]
}

/// How sharp a frame is where something moves (`moves`, by small pixel); everywhere where
/// nothing does.
pub(crate) fn sharp(seen: &Seen, moves: &[bool]) -> f64 {
    let width = seen.width.max(1);
    let [across, _] = cells(width, seen.small.len() / width);
    let mut count = vec![0u32; seen.edges.len()];
    for (i, _) in moves.iter().enumerate().filter(|(_, m)| **m) {
        count[(i / width / CELL) * across + (i % width) / CELL] += 1;
    }
    let anywhere = count.iter().any(|c| *c > 0);
    let weight = |c: u32| if anywhere { f64::from(c) } else { 1.0 };
    let cells = seen.edges.iter().zip(&count);
    let (sum, all) = cells.fold((0.0, 0.0), |(sum, all), (edges, c)| {
        (sum + f64::from(*edges) * weight(*c), all + weight(*c))
    });
    if all > 0.0 { sum / all } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Checks of two pixels in the left half, softer to the right.
    fn checks(soft: bool) -> Netpbm {
        let (width, height) = (192, 96);
        let value = |i: usize| {
            let (x, y) = (i % width, i / width);
            let check = u8::from((x / 2 + y / 2) % 2 == 0) * 100;
            if soft && x >= 96 { 50 } else { check }
        };
        Netpbm {
            width,
            height,
            depth: 1,
            data: (0..width * height).map(value).collect(),
        }
    }

    #[test]
    fn sharpness_is_taken_where_something_moves() {
        let (sharp_all, soft) = (seen(&checks(false)), seen(&checks(true)));
        assert_eq!((soft.width, soft.small.len()), (96, 96 * 48));
        assert!(soft.small[10 * 96 + 60] == 50);
        let moves =
            |right: bool| -> Vec<bool> { (0..96 * 48).map(|i| (i % 96 >= 50) == right).collect() };
        assert!(sharp(&soft, &moves(true)) < 0.01 * sharp(&sharp_all, &moves(true)));
        let left = sharp(&soft, &moves(false)) / sharp(&sharp_all, &moves(false));
        assert!((0.9..1.1).contains(&left), "{left}");
        assert!(sharp(&soft, &[false; 96 * 48]) > 0.0);
    }
}
