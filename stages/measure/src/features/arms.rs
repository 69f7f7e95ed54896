//! Arms estimated from the trunk: where they are clear, their axes, and cuts where they do not.

use crate::features::body::Body;
use crate::geometry::slices::{Ring, Slice};
use nalgebra::{Point3, Vector3};

/// The ring of an arm in a slice, on a side (1 left, -1 right), where it is clear of the trunk.
pub fn arm_ring<'a>(body: &Body, rings: &'a [Ring], side: f64) -> Option<&'a Ring> {
    let trunk = rings.first()?;
    let out = |r: &Ring| (r.centre - trunk.centre).dot(&body.left) * side;
    rings[1..]
        .iter()
        .filter(|r| out(r) > 0.0 && small(r.area, trunk.area))
        .max_by(|a, b| out(a).total_cmp(&out(b)))
}

/// Whether the area of a section is an arm's beside a trunk's.
pub(crate) fn small(area: f64, trunk: f64) -> bool {
    area < 0.35 * trunk
}

/// How far a trunk's section jumps outward, as a share of stature, where an arm beside it becomes part of it; where the
/// arm ends, it does not. By hand: looked at two made bodies, at 0.7 and 1.4 of it: no tape changes.
const JUMP_SHARE: f64 = 0.012;
/// How far from a level that is looked for, as a share of stature. By hand: looked at three scans, at 0.7 and 1.4 of
/// it: no tape changes.
const NEAR_SHARE: f64 = 0.12;

/// Whether at a height the arm of a side is part of the trunk's section: it is clear nearest above
/// or below, and toward that height the trunk's section jumps outward by it.
pub fn merged(body: &Body, z: f64, side: f64) -> bool {
    let near = NEAR_SHARE * body.stature;
    let around: Vec<&Slice> = body.between(z - near, z + near).collect();
    let clear = |s: &&Slice| arm_ring(body, &s.rings, side).is_some();
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
    if clear(&around[here]) {
        return false;
    }
    let above = (here..around.len()).find(|i| clear(&around[*i]));
    let below = (0..here).rev().find(|i| clear(&around[*i]));
    let jumps = |clear: usize, next: usize| {
        out(around[next]) - out(around[clear]) > JUMP_SHARE * body.stature
    };
    above.is_some_and(|i| jumps(i, i - 1)) || below.is_some_and(|i| jumps(i, i + 1))
}

/// Slices that may be missing within one stretch of an arm. By hand: looked at three scans, at 0.7 and 1.4 of it: no
/// tape changes.
const MISSING_SLICES: usize = 2;

/// Middles of an arm's level sections above a height, from bottom to top: the longest stretch where it
/// is clear of the trunk. Shoulders of raised arms that rise above the slope of the neck are
/// rings of their own, too, but not this arm's. \[mm\]
pub fn clear(body: &Body, side: f64, above: f64) -> Vec<Point3<f64>> {
    let below_neck = |s: &&Slice| body.neck.is_none_or(|n| s.z < n);
    let slices = body.between(above, f64::MAX).take_while(below_neck);
    let (mut best, mut run, mut missing) = (Vec::new(), Vec::new(), 0);
    for slice in slices {
        match arm_ring(body, &slice.rings, side) {
            Some(ring) => {
                run.push(ring.centre);
                missing = 0;
            }
            None if missing < MISSING_SLICES => missing += 1,
            None if run.len() > best.len() => best = std::mem::take(&mut run),
            None => run.clear(),
        }
    }
    if run.len() > best.len() { run } else { best }
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

/// The axis of an upper arm from where it is clear of the trunk; `hip` is a height below which
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

#[cfg(test)]
mod tests {
    use super::*;

    fn ring(x: f64, z: f64, radius: f64) -> Ring {
        let area = std::f64::consts::PI * radius * radius;
        Ring {
            curve: Vec::new(),
            area,
            tape: 2.0 * area / radius,
            centre: Point3::new(x, 0.0, z),
        }
    }

    /// A trunk; an arm of the left up to 1400, but for one slice; a shoulder's top from 1500 on.
    fn raised() -> Body {
        let slices = (1000..1550).step_by(5).map(|z| {
            let z = f64::from(z);
            let arm = match z {
                1200.0 => None,
                ..1400.0 => Some(ring(400.0 - (z - 1000.0) / 2.0, z, 40.0)),
                ..1500.0 => None,
                _ => Some(ring(180.0, z, 40.0)),
            };
            let rings = [ring(0.0, z, 150.0)].into_iter().chain(arm).collect();
            Slice { z, rings }
        });
        let mut body = Body::of_slices(slices.collect());
        body.neck = Some(1550.0);
        body
    }

    #[test]
    fn the_top_of_a_raised_shoulder_is_no_part_of_the_arm_below_it() {
        let found = clear(&raised(), 1.0, 1000.0);
        assert_eq!(found.len(), 79);
        assert_eq!(found.last().unwrap().z, 1395.0);
        let axis = upper_arm_axis(&raised(), 1.0, 1000.0).unwrap();
        proof::near(-axis.down.x / axis.down.z, 0.5, 1e-9);
        assert!(clear(&raised(), -1.0, 1000.0).is_empty());
    }
}
