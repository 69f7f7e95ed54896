//! How far an upright body reaches back, forward and across at shares of the way from hip to neck.

use crate::body::Body;
use crate::marks::{breadth, extent};

/// Reaches of a body's outline, told at shares of the way from the hip's level (0) to the neck's (1).
///
/// Forward and back are from the middle of the hip's own section. \[mm\]
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Reach {
    hip: f64,
    long: f64,
    levels: Vec<At>,
}

/// One level.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct At {
    z: f64,
    back: f64,
    front: f64,
    trunk: f64,
    full: f64,
}

/// Reads the reaches between a little below the hip and a little above the neck; heights in the
/// body's frame. `None` where there is no trunk.
pub fn reach(body: &Body, hip: f64, neck: f64) -> Option<Reach> {
    let long = neck - hip;
    let mut levels = Vec::new();
    for slice in body.between(hip - 0.05 * long, neck + 0.05 * long) {
        let Some(ring) = slice.rings.first() else {
            continue;
        };
        let (back, front) = extent(ring, &body.front)?;
        let (low, high) = extent(ring, &body.left)?;
        levels.push(At {
            z: slice.z,
            back,
            front,
            trunk: high - low,
            full: breadth(slice, &body.left)?,
        });
    }
    let mut reach = Reach { hip, long, levels };
    let middle = (reach.at(0.0, |l| l.back) + reach.at(0.0, |l| l.front)) / 2.0;
    for level in &mut reach.levels {
        level.back -= middle;
        level.front -= middle;
    }
    (reach.levels.len() > 20).then_some(reach)
}

impl Reach {
    fn at(&self, share: f64, value: impl Fn(&At) -> f64) -> f64 {
        let z = self.hip + share * self.long;
        let above = self.levels.partition_point(|l| l.z < z);
        let (Some(a), Some(b)) = (
            self.levels.get(above.saturating_sub(1)),
            self.levels.get(above).or(self.levels.last()),
        ) else {
            return 0.0;
        };
        let t = match b.z > a.z {
            true => ((z - a.z) / (b.z - a.z)).clamp(0.0, 1.0),
            false => 0.0,
        };
        value(a) + t * (value(b) - value(a))
    }

    /// How far the back lies before the middle of the hip: less than nought for all that is behind it.
    pub fn back(&self, share: f64) -> f64 {
        self.at(share, |l| l.back)
    }

    /// How far the front lies before the middle of the hip.
    pub fn front(&self, share: f64) -> f64 {
        self.at(share, |l| l.front)
    }

    /// Breadth of the trunk alone, where arms stand clear of it.
    pub fn trunk(&self, share: f64) -> f64 {
        self.at(share, |l| l.trunk)
    }

    /// Breadth from the outermost of the left to the outermost of the right, arms and all.
    pub fn full(&self, share: f64) -> f64 {
        self.at(share, |l| l.full)
    }
}
