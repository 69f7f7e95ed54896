//! How sure a girth is, from what it was made of.

use crate::features::body::Body;
use crate::sections::one::SectionMeasurement;
use crate::sections::taken::taken;
use crate::uncertainty::places::{Changes, FAR, along, over};
use nalgebra::{Point3, Rotation3, Unit, Vector3};
use shape::{GirthId, Landmark, Mesh, NINE_IN_TEN, Part, Plane, PlaneRule, Refusal, Sigmas};

/// How much a tape changes by where it is taken. \[mm\]
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Level {
    /// One standard deviation of the plane's place against its definition; `None` where that is
    /// unknown, or no section beside tells.
    pub(crate) against_definition: Option<f64>,
    /// How much shorter and longer the tape is within nine in ten of these places, where sections that far away were taken; else as
    /// many deviations to either side.
    pub(crate) ends: Option<[f64; 2]>,
    /// One standard deviation when the same person is measured again.
    pub(crate) again: Option<f64>,
}

/// How much a tape changes by where it is taken, over where its level may be, and of its tilt to either side. Of a neck the tilt must
/// be known; that of other planes, where nobody tells it, is in their levels' scatter.
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
    let again = sigma.repeat_mm.and_then(|mm| beside.moved(mm));
    let of = |all: Option<Changes>| Level {
        against_definition: all.map(|c| c.sigma.min(MOST * here.tape_mm)),
        ends: all.map(|c| c.ends),
        again,
    };
    if landmark.by.definition().plane == PlaneRule::AcrossNeck {
        let both = sigma.level_mm.zip(sigma.tilt_rad);
        return of(both.and_then(|(mm, rad)| over(|x, y| beside.across_neck(x * mm, y * rad))));
    }
    if landmark.part == Part::Trunk && sigma.tilt_rad.is_none() {
        return of((sigma.level_mm).and_then(|mm| along(|x| beside.along_normal(x * mm))));
    }
    let level = sigma.level_mm.and_then(|mm| beside.moved(mm));
    let tilt = match sigma.tilt_rad {
        Some(rad) => beside.leaning(rad),
        None => Some(0.0),
    };
    Level {
        against_definition: level.zip(tilt).map(|(l, t)| libm::hypot(l, t)),
        ends: None,
        again,
    }
}

/// A tape's deviation is no more of it (structural: beyond any interval that is given).
const MOST: f64 = 0.2;

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
        (!known.is_empty()).then(|| square.sqrt().min(MOST * self.here.tape_mm))
    }

    /// How much longer the tape is farther along the normal.
    fn along_normal(&self, mm: f64) -> Option<f64> {
        self.change(self.shifted(mm))
    }

    /// The plane so far along its normal.
    fn shifted(&self, mm: f64) -> Plane {
        let plane = self.landmark.plane;
        let by = Vector3::from(plane.normal) * mm;
        Plane {
            point_mm: (Point3::from(plane.point_mm) + by).into(),
            ..plane
        }
    }

    /// Along the normal, to either side; of a thigh, whose upper end is no thigh's any more, by its slope down the leg alone.
    fn moved(&self, mm: f64) -> Option<f64> {
        match (self.landmark.part, self.landmark.id) {
            (Part::Trunk, _) => self.outer(mm),
            // Deviations of limbs and neck were fitted with a step of one.
            (_, GirthId::Thigh(_)) => {
                let slope = |mm: f64| self.pair([self.shifted(mm), self.shifted(mm)]);
                slope(mm).or_else(|| slope(-mm))
            }
            _ => self.pair([self.shifted(-mm), self.shifted(mm)]),
        }
    }

    /// The same deviation as of all places [`along`] the normal, by the outermost of them alone.
    fn outer(&self, mm: f64) -> Option<f64> {
        let side = |way: f64| {
            let at = |share: f64| self.along_normal(share * FAR * way * mm);
            at(1.0).or_else(|| Some(2.0 * at(0.5)?))
        };
        Some(self.mean_square([side(-1.0), side(1.0)])? / FAR)
    }

    /// About the body's left, either way.
    fn leaning(&self, rad: f64) -> Option<f64> {
        let middle = Point3::from(self.landmark.plane.point_mm);
        self.pair([-rad, rad].map(|rad| self.turned(&middle, rad)))
    }

    /// The plane turned about the body's left through a point.
    fn turned(&self, about: &Point3<f64>, rad: f64) -> Plane {
        let plane = self.landmark.plane;
        let turn = Rotation3::from_axis_angle(&Unit::new_normalize(self.body.left), rad);
        Plane {
            point_mm: (about + turn * (Point3::from(plane.point_mm) - about)).into(),
            normal: (turn * Vector3::from(plane.normal)).into(),
        }
    }

    /// How much longer the tape of a neck is farther along its axis, turned about the throat, for there its level is known.
    fn across_neck(&self, mm: f64, rad: f64) -> Option<f64> {
        let ahead = |p: &&Point3<f64>| p.coords.dot(&self.body.front);
        let front = (self.here.contour.iter()).max_by(|a, b| ahead(a).total_cmp(&ahead(b)))?;
        let plane = self.turned(front, rad);
        let by = Vector3::from(self.landmark.plane.normal) * mm;
        self.change(Plane {
            point_mm: (Point3::from(plane.point_mm) + by).into(),
            ..plane
        })
    }
}

/// Whether an interval reaches farther from its tape than a share of it, or to zero.
fn too_far(tape: f64, [low, high]: [f64; 2], widest: f64) -> bool {
    !(low > 0.0 && tape - low <= widest * tape && high - tape <= widest * tape)
}

/// Whether an interval is wider than one that reaches to either side by a share of its tape, or reaches to zero.
fn too_wide(tape: f64, [low, high]: [f64; 2], widest: f64) -> bool {
    !(low > 0.0 && high - low <= 2.0 * widest * tape)
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
/// reaches down and up; a length of corners that no outline confirms may be missing from it. It holds the mesh's
/// tape. \[mm\]
fn interval(mesh: f64, mean: f64, [down, up]: [f64; 2], open: f64) -> [f64; 2] {
    let below = libm::hypot(down, NINE_IN_TEN * open);
    [(mean - below).min(mesh), (mean + up).max(mesh)]
}

/// The interval of a tape: none where a part of it is unknown, a refusal where it is too wide. `mean`
/// is what mesh and outlines tell together; `level` is how far down and up the tape reaches by where it is taken, if not as far either
/// way; by what is hidden of a thigh it may be longer, whatever else is unsure. \[mm\]
pub(crate) fn reported(
    (tape, mean): (f64, f64),
    sigmas: &Sigmas,
    level: Option<[f64; 2]>,
    (hidden, widest): (f64, f64),
) -> Result<Option<[f64; 2]>, Refusal> {
    if !sigmas.unknown().is_empty() {
        return Ok(None);
    }
    let within = |reach| interval(tape, mean, reach, sigmas.cover_mm.unwrap_or(0.0));
    let (ends, refused) = match level {
        None => {
            let ends = within([reach(sigmas); 2]);
            (ends, too_far(tape, ends, widest))
        }
        Some(ends) => {
            let rest = reach(&Sigmas {
                level_mm: Some(0.0),
                ..*sigmas
            });
            let (all, rest) = (ends.map(|end| libm::hypot(end, rest)), within([rest; 2]));
            let all = within(all);
            (
                all,
                too_wide(tape, all, widest) || too_far(tape, rest, widest),
            )
        }
    };
    let up = [ends[0], tape + libm::hypot(ends[1] - tape, hidden)];
    match refused {
        true => Err(Refusal::TooUncertain),
        false if hidden > 0.0 && too_far(tape, up, widest) => Err(Refusal::ThighsOne),
        false => Ok(Some(up)),
    }
}

/// How far an interval reaches by all that lengthens and shortens a tape alike. \[mm\]
pub(crate) fn reach(sigmas: &Sigmas) -> f64 {
    NINE_IN_TEN * sigmas.variance().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_interval_holds_its_tape_and_reaches_down_where_no_outline_confirms_it() {
        let outlines = together((1000.0, 4.0), Some((980.0, 0.5)));
        assert!(outlines.0 + 5.0 < 1000.0);
        let [low, high] = interval(1000.0, outlines.0, [5.0; 2], 0.0);
        assert!(low < 980.0 && high == 1000.0);
        assert_eq!(interval(1000.0, 1000.0, [5.0, 7.0], 0.0), [995.0, 1007.0]);
        let [low, high] = interval(1000.0, 1000.0, [5.0; 2], 20.0);
        assert!(low < 968.0 && high == 1005.0);
    }

    #[test]
    fn an_interval_that_tells_nothing_is_too_wide() {
        assert!(!too_far(1000.0, [750.0, 1250.0], 0.25));
        for wide in [[749.0, 1100.0], [900.0, 1251.0], [f64::NAN, 1100.0]] {
            assert!(too_far(1000.0, wide, 0.25), "{wide:?}");
        }
        assert!(too_far(0.0, [0.0, 0.0], 0.25));
        // Up alone by where it is taken, an interval that tells as much.
        assert!(!too_wide(1000.0, [990.0, 1300.0], 0.25));
        assert!(too_wide(1000.0, [800.0, 1301.0], 0.25));
        assert!(too_wide(1000.0, [0.0, 400.0], 0.25));
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
