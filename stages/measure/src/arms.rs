//! Arms told from the trunk: where they stand clear, their axes, and cuts where they do not.

use crate::body::Body;
use crate::slices::{Ring, Slice};
use nalgebra::{Point3, Vector3};

/// The ring of an arm in a slice, on a side (1 left, -1 right), where it stands clear of the trunk.
pub fn arm_ring<'a>(body: &Body, rings: &'a [Ring], side: f64) -> Option<&'a Ring> {
    let trunk = rings.first()?;
    let out = |r: &Ring| (r.centre - trunk.centre).dot(&body.left) * side;
    rings[1..]
        .iter()
        .filter(|r| out(r) > 0.0 && r.area < 0.35 * trunk.area)
        .max_by(|a, b| out(a).total_cmp(&out(b)))
}

/// How far a trunk's section jumps outward, as a share of stature, where an arm beside it becomes part
/// of it; where the arm ends, it does not.
const JUMP: f64 = 0.012;
/// How far from a level that is looked for, as a share of stature.
const NEAR: f64 = 0.12;

/// Whether at a height the arm of a side is part of the trunk's section: it stands clear nearest above
/// or below, and toward that height the trunk's section jumps outward by it.
pub(crate) fn merged(body: &Body, z: f64, side: f64) -> bool {
    let near = NEAR * body.stature;
    let around: Vec<&Slice> = body.between(z - near, z + near).collect();
    let stands = |s: &&Slice| arm_ring(body, &s.rings, side).is_some();
    let out = |s: &Slice| {
        let points = s.rings.first().map_or(&[][..], |r| &r.curve);
        let reach = points.iter().map(|p| p.coords.dot(&body.left) * side);
        reach.fold(f64::MIN, f64::max)
    };
    let Some(here) = (0..around.len()).min_by(|a, b| {
        let off = |i: &usize| (around[*i].z - z).abs();
        off(a).total_cmp(&off(b))
    }) else {
        return false;
    };
    if stands(&around[here]) {
        return false;
    }
    let above = (here..around.len()).find(|i| stands(&around[*i]));
    let below = (0..here).rev().find(|i| stands(&around[*i]));
    let jumps =
        |clear: usize, next: usize| out(around[next]) - out(around[clear]) > JUMP * body.stature;
    above.is_some_and(|i| jumps(i, i - 1)) || below.is_some_and(|i| jumps(i, i + 1))
}

/// Middles of an arm's level sections above a height, where it stands clear of the trunk. \[mm\]
pub fn clear(body: &Body, side: f64, above: f64) -> Vec<Point3<f64>> {
    body.between(above, f64::MAX)
        .take_while(|s| body.neck.is_none_or(|n| s.z < n))
        .filter_map(|s| arm_ring(body, &s.rings, side).map(|r| r.centre))
        .collect()
}

/// A straight line: a point and a unit direction, here down a limb.
#[derive(Debug, Clone, Copy)]
pub struct Axis {
    /// A point of it. \[mm\]
    pub point: Point3<f64>,
    /// Its direction, unit, downward.
    pub down: Vector3<f64>,
}

impl Axis {
    /// Where it is at a height.
    pub fn at(&self, z: f64) -> Point3<f64> {
        self.point + self.down * ((z - self.point.z) / self.down.z)
    }
}

/// How far above the elbow's usual height an upper arm still tells its own axis, below its middle, as
/// a share of stature.
const STRAIGHT: f64 = 0.05;

/// The axis of an upper arm whose middle is at a height: from what is above its elbow, where enough
/// of that stands clear, else as [`upper_arm_axis`].
pub(crate) fn axis_about(body: &Body, side: f64, middle: f64, hip: f64) -> Option<Axis> {
    let elbow = middle - STRAIGHT * body.stature;
    upper_arm_axis(body, side, elbow.max(hip)).or_else(|| upper_arm_axis(body, side, hip))
}

/// The axis of an upper arm from where it stands clear of the trunk; `hip` is a height below which
/// no upper arm is.
pub fn upper_arm_axis(body: &Body, side: f64, hip: f64) -> Option<Axis> {
    let all = clear(body, side, hip);
    let top = all.iter().map(|p| p.z).reduce(f64::max)?;
    // The forearm may be bent: only what is well above the elbow tells the axis. Nor does what is
    // nearest to the armpit, where a fold is filled.
    let near =
        |p: &&Point3<f64>| (top - 0.06 * body.stature..top - 0.006 * body.stature).contains(&p.z);
    let upper: Vec<&Point3<f64>> = all.iter().filter(near).collect();
    if upper.len() < 6 {
        return None;
    }
    let mean = upper.iter().map(|p| p.coords).sum::<Vector3<f64>>() / upper.len() as f64;
    let slope = upper
        .iter()
        .map(|p| (p.coords - mean) * (p.z - mean.z))
        .sum::<Vector3<f64>>();
    Some(Axis {
        point: mean.into(),
        down: -(slope / slope.z).normalize(),
    })
}
