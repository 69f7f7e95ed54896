//! How far an upright body reaches back, forward and across at shares of the way from hip to neck.

use crate::features::body::Body;
use crate::features::extent::{breadth, depth, extent};

/// How far a level section reaches, in some directions. \[mm\]
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Row<const N: usize> {
    /// Height.
    pub z: f64,
    /// One for each direction.
    pub reach: [f64; N],
}

/// Reaches at a height, straight between those of the rows about it, which rise; beyond them the last.
/// Noughts without rows.
pub(crate) fn between<const N: usize>(rows: &[Row<N>], z: f64) -> [f64; N] {
    let above = rows.partition_point(|r| r.z < z);
    let (Some(a), Some(b)) = (
        rows.get(above.saturating_sub(1)),
        rows.get(above).or(rows.last()),
    ) else {
        return [0.0; N];
    };
    let t = match b.z > a.z {
        true => ((z - a.z) / (b.z - a.z)).clamp(0.0, 1.0),
        false => 0.0,
    };
    std::array::from_fn(|k| a.reach[k] + t * (b.reach[k] - a.reach[k]))
}

/// Reaches of a body's outline, at shares of the way from the hip's level (0) to the neck's (1).
///
/// Forward and back are from the middle of the hip's own section. \[mm\]
#[derive(Debug, Clone, PartialEq, Default)]
pub struct BodyExtents {
    hip: f64,
    long: f64,
    /// Back, front, the trunk's breadth, the full breadth.
    levels: Vec<Row<4>>,
}

/// Reads the reaches between a little below the hip and a little above the neck; heights in the
/// body's frame. `None` where there is no trunk.
pub fn reach(body: &Body, hip: f64, neck: f64) -> Option<BodyExtents> {
    let long = neck - hip;
    let mut levels = Vec::new();
    for slice in body.between(hip - 0.05 * long, neck + 0.05 * long) {
        let Some(ring) = slice.rings.first() else {
            continue;
        };
        let (back, front) = depth(body, ring)?;
        let (low, high) = extent(ring, &body.left)?;
        levels.push(Row {
            z: slice.z,
            reach: [back, front, high - low, breadth(slice, &body.left)?],
        });
    }
    let mut reach = BodyExtents { hip, long, levels };
    let [back, front, ..] = reach.at(0.0);
    for level in &mut reach.levels {
        level.reach[0] -= (back + front) / 2.0;
        level.reach[1] -= (back + front) / 2.0;
    }
    (reach.levels.len() > 20).then_some(reach)
}

impl BodyExtents {
    fn at(&self, share: f64) -> [f64; 4] {
        between(&self.levels, self.hip + share * self.long)
    }

    /// How far the back is before the middle of the hip: less than nought for all that is behind it.
    pub fn back(&self, share: f64) -> f64 {
        self.at(share)[0]
    }

    /// How far the front is before the middle of the hip.
    pub fn front(&self, share: f64) -> f64 {
        self.at(share)[1]
    }

    /// Breadth of the trunk alone, where arms are clear of it.
    pub fn trunk(&self, share: f64) -> f64 {
        self.at(share)[2]
    }

    /// Breadth from the outermost of the left to the outermost of the right, arms and all.
    pub fn full(&self, share: f64) -> f64 {
        self.at(share)[3]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reaches_between_rows_are_straight_and_those_beyond_are_the_last() {
        let row = |z: f64, v: f64| Row { z, reach: [v; 3] };
        let rows = [row(10.0, 1.0), row(20.0, 3.0)];
        assert_eq!(between(&rows, 15.0), [2.0; 3]);
        assert_eq!(between(&rows, 5.0), [1.0; 3]);
        assert_eq!(between(&rows, 25.0), [3.0; 3]);
        assert_eq!(between::<3>(&[], 25.0), [0.0; 3]);
    }
}
