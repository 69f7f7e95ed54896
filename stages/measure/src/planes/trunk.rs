//! Where the trunk's girths are taken: hip from the surface, the other levels from the model.

use crate::features::body::Body;
use crate::features::extent::across;
use crate::features::marks::{Marks, hip};
use crate::features::readings::{Reading, Readings, readings};
use crate::features::whole::no_stature;
use crate::geometry::peak::farthest;
use crate::model::file::LevelModel;
use crate::model::level::Level;
use crate::model::predict::{Cover, LevelEstimate, SIZES};
use shape::{HipAt, Plane, PlaneSigma, Refusal};

/// A plane and how sure its place is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Placed {
    /// The plane.
    pub plane: Plane,
    /// How sure.
    pub sigma: PlaneSigma,
}

/// The trunk's levels of one body.
pub(crate) struct Trunk<'a> {
    body: &'a Body,
    marks: &'a Marks,
    model: &'a LevelModel,
    read: Option<Readings>,
    narrow: Option<f64>,
}

impl<'a> Trunk<'a> {
    /// Reads a body; `absolute` is whether its lengths are millimetres, `narrow` the height at which it is narrowest between hip and bust.
    pub(crate) fn new(
        body: &'a Body,
        marks: &'a Marks,
        model: &'a LevelModel,
        absolute: bool,
        narrow: Option<f64>,
    ) -> Self {
        let read = readings(body, marks, absolute);
        Trunk {
            body,
            marks,
            model,
            read,
            narrow,
        }
    }

    /// A level as the model tells it. `None` where the body's height is no stature.
    pub(crate) fn reported(&self, level: Level) -> Option<LevelEstimate> {
        self.model
            .estimate(self.read.as_ref()?, self.body.stature, level)
    }

    /// How well the model knows the body.
    pub(crate) fn cover(&self) -> Option<Cover> {
        self.reported(Level::Waist).map(|t| t.cover)
    }

    /// The plane of a level that the model tells.
    pub(crate) fn at(&self, level: Level) -> Option<Placed> {
        let reported = self.reported(level)?;
        Some(Placed {
            plane: across(self.body, self.body.ground + reported.height_mm),
            sigma: PlaneSigma {
                level_mm: Some(reported.sigma_mm),
                tilt_rad: None,
                repeat_mm: reported.repeat_mm,
                hidden_mm: None,
            },
        })
    }

    /// The level plane at a share of the way from the hip's level to the neck's narrowest.
    pub(crate) fn between_hip_and_neck(&self, at: f64) -> (Plane, PlaneSigma) {
        let (m, s) = (self.marks, self.body.stature);
        let z = self.body.ground + m.hip + at * (m.neck - m.hip);
        let ends = (
            self.hip_sigma().level_mm,
            self.model.reading(Reading::Neck, s),
        );
        let level = match ends {
            (Some(hip), Some(neck)) => Some(libm::hypot((1.0 - at) * hip, at * neck.0)),
            _ => None,
        };
        let sigma = PlaneSigma {
            level_mm: level,
            ..PlaneSigma::default()
        };
        (across(self.body, z), sigma)
    }

    /// A true minimum of the trunk's tape between hip and bust.
    pub(crate) fn narrowest(&self) -> Option<Placed> {
        self.narrow.map(|z| Placed {
            plane: across(self.body, z),
            sigma: self.shown(),
        })
    }

    /// How sure the hip's level is: where it shows, no surer than the heights are alike at which the back reaches as far.
    pub(crate) fn hip_sigma(&self) -> PlaneSigma {
        let shown = self.shown();
        match self.body.hip {
            Some(HipAt::Hidden(_, mm)) => PlaneSigma {
                level_mm: Some(mm),
                repeat_mm: None,
                ..shown
            },
            _ => PlaneSigma {
                level_mm: shown.level_mm.map(|mm| mm.max(self.marks.hip_spread)),
                ..shown
            },
        }
    }

    /// How sure a level is that shows, as buttocks mostly do.
    pub(crate) fn shown(&self) -> PlaneSigma {
        let read = self.model.reading(Reading::Buttock, self.body.stature);
        PlaneSigma {
            level_mm: read.map(|r| r.0),
            tilt_rad: None,
            repeat_mm: read.and_then(|r| r.1),
            hidden_mm: None,
        }
    }
}

/// What is missing of an upright body.
pub(crate) fn unlike(body: &Body) -> Refusal {
    no_stature(body).map_or(Refusal::NotUpright, |(why, _)| why)
}

/// The plane of the hip: where the surface shows it, else where the rest of a whole body tells it.
pub(crate) fn hip_plane(body: &Body) -> Option<Plane> {
    let z = hip(body).filter(|_| body.whole && !widens(body))?;
    Some(across(body, z))
}

/// Whether a hip that does not show is under a skirt: the tape grows downward all through where it may be.
fn widens(body: &Body) -> bool {
    let Some(HipAt::Hidden(z, sigma)) = body.hip else {
        return false;
    };
    let tapes = body.between(z - SIZES * sigma, z + SIZES * sigma);
    let tapes: Vec<f64> = tapes.filter_map(|s| Some(s.rings.first()?.tape)).collect();
    tapes.is_sorted_by(|low, high| low >= high)
}

/// The plane of the longest tape near the hip's level.
pub(crate) fn longest_hip_plane(body: &Body) -> Option<Plane> {
    let shows = matches!(body.hip, Some(HipAt::Between(..)));
    let z = hip(body).filter(|_| body.whole && shows)?;
    longest(body, z).map(|z| across(body, z))
}

/// How far from the hip's level the greatest girth of the hips is looked for, as a share of stature. By hand: looked at
/// three scans, at 0.7 and 1.4 of it: no tape changes.
const NEAR_HIP: f64 = 0.03;

/// The height near the hip's at which the tape around the trunk is longest.
fn longest(body: &Body, hip: f64) -> Option<f64> {
    let crotch = body.crotch.unwrap_or(body.ground);
    let low = crotch.max(hip - NEAR_HIP * body.stature);
    let near = body.between(low, hip + NEAR_HIP * body.stature);
    let tapes: Vec<(f64, f64)> = near
        .filter_map(|s| Some((s.z, s.rings.first()?.tape)))
        .collect();
    farthest(&tapes).map(|(_, z)| z)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hip_is_no_surer_than_its_back_is_flat() {
        let model = LevelModel::built_in();
        let mut body = Body::of_slices(Vec::new());
        body.hip = Some(HipAt::Between(800.0, 1000.0));
        let sure = |hip_spread: f64| {
            let marks = Marks {
                hip: 900.0,
                hip_shows: true,
                hip_spread,
                neck: 1500.0,
                bust: 1250.0,
                apex: None,
                arm_is_clear: true,
                chest_depth: 200.0,
            };
            Trunk::new(&body, &marks, &model, true, None).hip_sigma()
        };
        let usual = model.reading(Reading::Buttock, body.stature).unwrap().0;
        assert_eq!(sure(usual / 2.0).level_mm, Some(usual));
        assert_eq!(sure(usual * 2.0).level_mm, Some(usual * 2.0));
    }
}
