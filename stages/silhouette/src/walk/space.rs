//! The space in which the subject of a walk is looked for.

use crate::scene::still_and_disk::Shot;
use crate::walk::features::Spot;
use nalgebra::{Point3, Vector3};

/// What was photographed.
pub(crate) struct Scene<'a> {
    /// Reduced photos with cameras.
    pub(crate) shots: &'a [Shot],
    /// Features in space.
    pub(crate) spots: &'a [Spot],
    /// Where the subject may be.
    pub(crate) space: Space,
}

/// The space in which the subject is looked for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Space {
    /// Radius of what nearly all photos see about the axis. \[mm\]
    pub(crate) reach: f64,
    /// Least and greatest height. \[mm\]
    pub(crate) heights: [f64; 2],
    /// Height at which cameras look. \[mm\]
    pub(crate) middle: f64,
    /// Height of the floor, where one is known: it is below where cameras look. \[mm\]
    pub(crate) floor: Option<f64>,
}

/// Least share of the photos that see the space sideways, and up and down, as each cell.
/// By hand: looked at a walk (asclepius), at 0.7 of it: no result, for a fault that is mended since.
pub(crate) const SEEN_SHARES: [f64; 2] = [0.95, 0.3];
/// A floor is at least so much of the reach below where cameras look.
/// By hand: looked at a walk (asclepius), at 0.7 and 1.4 of it: nothing changes.
const BELOW_SHARE: f64 = 0.05;
/// What is within so much of the reach is likely the subject's.
/// By hand: looked at a walk (asclepius), at 0.7 and 1.4 of it: mean IoU −0.1526 and −0.0064.
const AMID_SHARE: f64 = 0.5;
/// Points around the axis that are looked at (structural: samples).
const AROUND_POINTS: usize = 16;

impl Space {
    /// The space about the z axis, above the ground. \[mm\] `None` where too few photos see it.
    pub(crate) fn of(shots: &[Shot], ground: f64) -> Option<Space> {
        let out = |s: &Shot| s.camera.centre().coords.xy().norm();
        let nearest = shots.iter().map(out).fold(f64::MAX, f64::min);
        let middle = looked_at(shots)?;
        let sees =
            |s: &&Shot, x: &Point3<f64>| s.camera.project(x).is_some_and(|px| s.camera.holds(px));
        let share = |at: &dyn Fn(f64) -> Point3<f64>| {
            let turn =
                (0..AROUND_POINTS).map(|k| k as f64 * std::f64::consts::TAU / AROUND_POINTS as f64);
            let seen: usize = turn
                .map(at)
                .map(|x| shots.iter().filter(|s| sees(s, &x)).count())
                .sum();
            seen as f64 / (AROUND_POINTS * shots.len()) as f64
        };
        let steps = (1..60).map(|k| f64::from(k) * nearest * 0.01);
        let reach = steps
            .take_while(|r| {
                share(&|a| Point3::new(r * libm::cos(a), r * libm::sin(a), middle))
                    >= SEEN_SHARES[0]
            })
            .last()?;
        let on_axis = |sign: f64| {
            let steps = (1..200).map(|k| middle + f64::from(k) * nearest * 0.01 * sign);
            steps
                .take_while(|z| share(&|_| Point3::new(0.0, 0.0, *z)) >= SEEN_SHARES[1])
                .last()
        };
        let (low, high) = (on_axis(-1.0)?, on_axis(1.0)?);
        let floor = Some(ground).filter(|g| *g < middle - BELOW_SHARE * reach);
        Some(Space {
            reach,
            heights: [floor.map_or(low, |f| f.max(low)), high],
            middle,
            floor,
        })
    }

    /// Whether a point is amid the cameras, clearly above the floor: it is likely the subject's.
    pub(crate) fn amid(&self, x: &Point3<f64>) -> bool {
        let [_, high] = self.heights;
        x.coords.xy().norm() < AMID_SHARE * self.reach && !self.low(x) && x.z < high
    }

    /// Whether a point is on the floor or hardly above it.
    pub(crate) fn low(&self, x: &Point3<f64>) -> bool {
        self.floor
            .is_some_and(|f| x.z < f + BELOW_SHARE * self.reach)
    }

    /// Whether a point is too far aside, or under the floor.
    pub(crate) fn without(&self, x: &Point3<f64>) -> bool {
        x.coords.xy().norm() > self.reach || self.floor.is_some_and(|f| x.z < f)
    }
}

/// The height on the axis that cameras look at, in the middle of them. \[mm\]
fn looked_at(shots: &[Shot]) -> Option<f64> {
    let height = |s: &Shot| {
        let (c, d) = (
            s.camera.centre(),
            s.camera.pose.rotation.inverse() * Vector3::z(),
        );
        let along = -(c.x * d.x + c.y * d.y) / d.xy().norm_squared();
        (along.is_finite() && along > 0.0).then_some(c.z + along * d.z)
    };
    let mut all: Vec<f64> = shots.iter().filter_map(height).collect();
    all.sort_by(f64::total_cmp);
    (2 * all.len() > shots.len()).then(|| all[all.len() / 2])
}
