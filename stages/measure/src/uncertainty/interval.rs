//! How sure a girth is, from what it was made of.

use crate::features::body::Body;
use crate::sections::one::SectionMeasurement;
use crate::sections::taken::taken;
use nalgebra::{Point3, Rotation3, Unit, Vector3};
use shape::{GirthId, Landmark, Mesh, NINE_IN_TEN, Part, Plane, PlaneRule};

/// How much a tape changes by where it is taken. \[mm\]
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Level {
    /// One standard deviation of the plane's place against its definition; `None` where that is
    /// unknown, or no section beside tells.
    pub(crate) against_definition: Option<f64>,
    /// The same, when the same person is measured again.
    pub(crate) again: Option<f64>,
}

/// How much a tape changes by where it is taken: root mean square over where its level may be, and of
/// its tilt to either side. Of a neck the tilt must be known; that of other
/// planes, where nobody tells it, is in their levels' scatter.
pub(crate) fn level_spread(
    mesh: &Mesh,
    body: &Body,
    landmark: &Landmark,
    here: &SectionMeasurement,
) -> Level {
    let beside = Beside {
        mesh,
        body,
        landmark,
        here,
    };
    let sigma = landmark.sigma;
    let level = sigma.level_mm.and_then(|mm| beside.moved(mm));
    let tilt = match sigma.tilt_rad {
        Some(rad) => beside.leaning(rad),
        None if landmark.by.definition().plane == PlaneRule::AcrossNeck => None,
        None => Some(0.0),
    };
    Level {
        against_definition: level.zip(tilt).map(|(l, t)| libm::hypot(l, t)),
        again: sigma.repeat_mm.and_then(|mm| beside.moved(mm)),
    }
}

/// Sections beside the one that was taken.
struct Beside<'a> {
    mesh: &'a Mesh,
    body: &'a Body,
    landmark: &'a Landmark,
    here: &'a SectionMeasurement,
}

impl Beside<'_> {
    /// How much longer the tape is in another plane, however limbs are parted there.
    fn change(&self, plane: Plane) -> Option<f64> {
        let moved = Landmark {
            plane,
            ..self.landmark.clone()
        };
        let there = taken(self.mesh, Some(self.body), &moved).ok()?;
        Some(there.tape_mm - self.here.tape_mm)
    }

    /// Root mean square of the changes to two planes.
    fn pair(&self, planes: [Plane; 2]) -> Option<f64> {
        self.mean_square(planes.map(|p| self.change(p)))
    }

    /// Root mean square of two changes; of one where the other is none.
    fn mean_square(&self, changes: [Option<f64>; 2]) -> Option<f64> {
        let known: Vec<f64> = changes.into_iter().flatten().collect();
        let square = known.iter().map(|c| c * c).sum::<f64>() / known.len() as f64;
        (!known.is_empty()).then(|| square.sqrt().min(0.2 * self.here.tape_mm))
    }

    /// Root mean square over a normal distribution of levels, so many deviations away: by three nodes of Gauss and Hermite, right where a
    /// tape is straight in them or a parabola. To a side without a section there a single deviation counts.
    fn over_levels(&self, at: impl Fn(f64) -> Plane) -> Option<f64> {
        let far = 3f64.sqrt();
        let side = |x: f64| {
            let change = self.change(at(x * far)).map(|c| c / far);
            change.or_else(|| self.change(at(x)))
        };
        self.mean_square([side(-1.0), side(1.0)])
    }

    /// Along the normal, to either side; of a thigh, whose upper end is no thigh's any more, by its slope down the leg alone.
    fn moved(&self, mm: f64) -> Option<f64> {
        let plane = self.landmark.plane;
        let n = Vector3::from(plane.normal);
        let by = |mm: f64| Plane {
            point_mm: (Point3::from(plane.point_mm) + n * mm).into(),
            ..plane
        };
        match (self.landmark.part, self.landmark.id) {
            (Part::Trunk, _) => self.over_levels(|x| by(x * mm)),
            // Deviations of limbs and neck were fitted with a step of one.
            (_, GirthId::Thigh(_)) => self.pair([by(mm), by(mm)]),
            _ => self.pair([by(-mm), by(mm)]),
        }
    }

    /// About the body's left, either way.
    fn leaning(&self, rad: f64) -> Option<f64> {
        let plane = self.landmark.plane;
        let n = Vector3::from(plane.normal);
        let by = |rad: f64| {
            let turn = Rotation3::from_axis_angle(&Unit::new_normalize(self.body.left), rad);
            Plane {
                normal: (turn * n).into(),
                ..plane
            }
        };
        self.pair([by(-rad), by(rad)])
    }
}

/// Whether an interval reaches farther from its tape than a share of it, or to zero.
pub(crate) fn too_wide(tape: f64, [low, high]: [f64; 2], widest: f64) -> bool {
    !(low > 0.0 && tape - low <= widest * tape && high - tape <= widest * tape)
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
    let below = libm::hypot(reach, NINE_IN_TEN * open);
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

    #[test]
    fn an_interval_that_tells_nothing_is_too_wide() {
        assert!(!too_wide(1000.0, [750.0, 1250.0], 0.25));
        for wide in [[749.0, 1100.0], [900.0, 1251.0], [f64::NAN, 1100.0]] {
            assert!(too_wide(1000.0, wide, 0.25), "{wide:?}");
        }
        assert!(too_wide(0.0, [0.0, 0.0], 0.25));
    }

    #[test]
    fn an_interval_may_be_no_wider_than_people_differ() {
        let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
        let mut table =
            csv::Reader::from_path(folder.join("../../models/tables/ansur2.csv")).unwrap();
        let head = table.headers().unwrap().clone();
        let rows: Vec<csv::StringRecord> = table.records().map(Result::unwrap).collect();
        let reach = |girth: &str, sex: &str| {
            let at = head.iter().position(|name| name == girth).unwrap();
            let own = rows.iter().filter(|row| &row[0] == sex);
            let mut all: Vec<f64> = own.map(|row| row[at].parse().unwrap()).collect();
            all.sort_by(f64::total_cmp);
            let share = |p: f64| all[(p * (all.len() - 1) as f64).round() as usize];
            50.0 * (share(0.95) - share(0.05)) / share(0.5)
        };
        let of = |girth: &str| (reach(girth, "f") + reach(girth, "m")) / 2.0;
        let waist = of("waistcircumference");
        proof::near(crate::GirthParams::default().widest_pct, waist, 0.05);
        for name in head.iter().filter(|name| name.ends_with("circumference")) {
            assert!(of(name) <= waist, "{name} differs more");
        }
    }
}
