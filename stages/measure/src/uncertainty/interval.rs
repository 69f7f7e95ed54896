//! How sure a girth is, from what it was made of.

use crate::features::body::Body;
use crate::planes::levels::scatter;
use crate::sections::taken::{Taken, taken};
use nalgebra::{Point3, Rotation3, Unit, Vector3};
use shape::{Landmark, Mesh, Plane};

/// Nine times in ten, in standard deviations.
pub(crate) const NINE_IN_TEN: f64 = 1.645;
/// Scatter of the lean of necks about what head and shoulders tell. \[rad\]
const LEAN: f64 = 2.6 * std::f64::consts::PI / 180.0;

/// Standard deviations of a tape. \[mm\]
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Spread {
    /// Where the girth is taken: the level's scatter, and the neck's lean.
    pub(crate) level: f64,
    /// The surface: its even error along the normal is 2π as much of girth.
    pub(crate) surface: f64,
    /// What another limb hides or was parted from.
    pub(crate) carried: f64,
    /// The unit of length.
    pub(crate) scale: f64,
}

impl Spread {
    /// All together.
    pub(crate) fn total(&self) -> f64 {
        [self.level, self.surface, self.carried, self.scale]
            .iter()
            .map(|s| s * s)
            .sum::<f64>()
            .sqrt()
    }
}

/// How much a tape changes by where it is taken: root mean square of a standard deviation's step to
/// either side along the normal, and for a neck of its lean. A step to where limbs are parted
/// otherwise than here tells of the parting, not of the level. \[mm\]
pub(crate) fn level_spread(mesh: &Mesh, body: &Body, landmark: &Landmark, here: &Taken) -> f64 {
    let tape_mm = here.tape_mm;
    let far = scatter(&landmark.name) * body.stature;
    let n = Vector3::from(landmark.plane.normal);
    let at = |plane: Plane| {
        let moved = Landmark {
            plane,
            ..landmark.clone()
        };
        let there = taken(mesh, Some(body), &moved).ok()?;
        let change = there.tape_mm - tape_mm;
        let alike = (there.carried > 0.0) == (here.carried > 0.0);
        (alike || change.abs() < 0.05 * tape_mm).then_some(change)
    };
    let moved = |by: f64| {
        let point = Point3::from(landmark.plane.point_mm) + n * by;
        at(Plane {
            point_mm: point.into(),
            ..landmark.plane
        })
    };
    let leaning = |by: f64| {
        let turn = Rotation3::from_axis_angle(&Unit::new_normalize(body.left), by);
        at(Plane {
            normal: (turn * n).into(),
            ..landmark.plane
        })
    };
    let pair = |changes: [Option<f64>; 2]| {
        let known: Vec<f64> = changes.into_iter().flatten().collect();
        let square = known.iter().map(|c| c * c).sum::<f64>() / known.len().max(1) as f64;
        square.sqrt().min(0.2 * tape_mm)
    };
    let level = pair([moved(-far), moved(far)]);
    match landmark.name == "NC" {
        true => level.hypot(pair([leaning(-LEAN), leaning(LEAN)])),
        false => level,
    }
}

/// A tape and its standard deviation, by the mesh and by silhouettes, as one: weighted by their
/// variances, and as wide again as the two disagree. \[mm\]
pub(crate) fn together(mesh: (f64, f64), silhouettes: Option<(f64, f64)>) -> (f64, f64) {
    let Some(other) = silhouettes else {
        return mesh;
    };
    let weights = [mesh.1.powi(-2), other.1.powi(-2)];
    let sum = weights[0] + weights[1];
    let mean = (weights[0] * mesh.0 + weights[1] * other.0) / sum;
    let apart = (mesh.0 - other.0) / 2.0;
    (mean, (1.0 / sum + apart * apart).sqrt())
}

/// The interval of a tape of the mesh, of what mesh and outlines give together, and how far that
/// reaches; a length of corners that no outline confirms may be missing from it. It holds the mesh's
/// tape. \[mm\]
pub(crate) fn interval(mesh: f64, mean: f64, reach: f64, open: f64) -> [f64; 2] {
    let below = reach.hypot(NINE_IN_TEN * open);
    [(mean - below).min(mesh), (mean + reach).max(mesh)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_interval_holds_its_tape_and_reaches_down_where_no_outline_confirms_it() {
        let outlines = together((1000.0, 4.0), Some((980.0, 0.5)));
        assert!(outlines.0 + 5.0 < 1000.0);
        let [low, high] = interval(1000.0, outlines.0, 5.0, 0.0);
        assert!(low < 980.0 && high == 1000.0);
        assert_eq!(interval(1000.0, 1000.0, 5.0, 0.0), [995.0, 1005.0]);
        let [low, high] = interval(1000.0, 1000.0, 5.0, 20.0);
        assert!(low < 968.0 && high == 1005.0);
    }
}
