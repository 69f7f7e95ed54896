//! Where the trunk's girths are taken: hip from the surface, the other levels from the model.

use crate::features::body::Body;
use crate::features::marks::{Marks, hip};
use crate::features::readings::{Reading, Readings, readings};
use crate::geometry::slices::level;
use crate::model::file::LevelModel;
use crate::model::level::Level;
use crate::model::predict::{Cover, LevelEstimate};
use nalgebra::Point3;
use shape::{Plane, PlaneSigma, Refusal};

/// A level plane around the middle of the trunk.
pub(crate) fn across(body: &Body, z: f64) -> Plane {
    let middle = body.trunk(z).map_or(Point3::origin(), |r| r.centre);
    Plane {
        point_mm: [middle.x, middle.y, z],
        ..level(z)
    }
}

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
}

impl<'a> Trunk<'a> {
    /// Reads a body; `absolute` says that its lengths are millimetres.
    pub(crate) fn new(
        body: &'a Body,
        marks: &'a Marks,
        model: &'a LevelModel,
        absolute: bool,
    ) -> Self {
        let read = readings(body, marks, absolute);
        Trunk {
            body,
            marks,
            model,
            read,
        }
    }

    /// A level as the model tells it. `None` where the body's height is no stature.
    pub(crate) fn told(&self, level: Level) -> Option<LevelEstimate> {
        self.model
            .estimate(self.read.as_ref()?, self.body.stature, level)
    }

    /// How well the model knows the body.
    pub(crate) fn cover(&self) -> Option<Cover> {
        self.told(Level::Waist).map(|t| t.cover)
    }

    /// The plane of a level that the model tells.
    pub(crate) fn at(&self, level: Level) -> Option<Placed> {
        let told = self.told(level)?;
        Some(Placed {
            plane: across(self.body, self.body.ground + told.height_mm),
            sigma: PlaneSigma {
                level_mm: Some(told.sigma_mm),
                tilt_rad: None,
                repeat_mm: told.repeat_mm,
            },
        })
    }

    /// The level plane at a share of the way from the hip's level to the neck's narrowest.
    pub(crate) fn between_hip_and_neck(&self, at: f64) -> (Plane, PlaneSigma) {
        let (m, s) = (self.marks, self.body.stature);
        let z = self.body.ground + m.hip + at * (m.neck - m.hip);
        let ends = [Reading::Buttock, Reading::Neck].map(|r| self.model.reading(r, s));
        let level = match ends {
            [Some(hip), Some(neck)] => Some(libm::hypot((1.0 - at) * hip.0, at * neck.0)),
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
        narrowest(self.body, self.marks).map(|z| self.on_surface(z))
    }

    /// An extreme that shows: as sure as the hip is.
    fn on_surface(&self, z: f64) -> Placed {
        Placed {
            plane: across(self.body, z),
            sigma: self.hip_sigma().unwrap_or_default(),
        }
    }

    /// How sure the hip's level is.
    pub(crate) fn hip_sigma(&self) -> Option<PlaneSigma> {
        let (level, repeat) = self.model.reading(Reading::Buttock, self.body.stature)?;
        Some(PlaneSigma {
            level_mm: Some(level),
            tilt_rad: None,
            repeat_mm: repeat,
        })
    }
}

/// What is missing of an upright body.
pub(crate) fn unlike(body: &Body) -> Refusal {
    match (body.crotch, body.neck) {
        (None, _) => Refusal::NoLegs,
        (_, None) => Refusal::NoNeck,
        _ => Refusal::NotUpright,
    }
}

/// The plane of the hip: where the surface shows it.
pub(crate) fn hip_plane(body: &Body) -> Option<Plane> {
    let z = body.crotch.and_then(|crotch| hip(body, crotch))?;
    Some(across(body, z))
}

/// The plane of the longest tape near the hip's level.
pub(crate) fn longest_hip_plane(body: &Body) -> Option<Plane> {
    let z = body.crotch.and_then(|crotch| hip(body, crotch))?;
    longest(body, z).map(|z| across(body, z))
}

/// How far from the hip's level the greatest girth of the hips is looked for, as a share of stature.
const NEAR_HIP: f64 = 0.03;

/// The height near the hip's at which the tape around the trunk is longest.
fn longest(body: &Body, hip: f64) -> Option<f64> {
    let low = body.crotch?.max(hip - NEAR_HIP * body.stature);
    body.between(low, hip + NEAR_HIP * body.stature)
        .filter_map(|s| Some((s.z, s.rings.first()?.tape)))
        .max_by(|a, b| a.1.total_cmp(&b.1))
        .map(|(z, _)| z)
}

/// The height of a true minimum of the trunk's tape between hip and bust.
fn narrowest(body: &Body, m: &Marks) -> Option<f64> {
    let tapes: Vec<(f64, f64)> = body
        .between(body.ground + m.hip, body.ground + m.bust)
        .filter_map(|s| Some((s.z, s.rings.first()?.tape)))
        .collect();
    let least = tapes.iter().min_by(|a, b| a.1.total_cmp(&b.1))?;
    let ends = tapes.first()?.1.min(tapes.last()?.1);
    (least.1 < 0.99 * ends).then_some(least.0)
}
