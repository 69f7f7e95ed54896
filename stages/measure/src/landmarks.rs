//! The stage that finds where to measure, without a statistical body model.

mod limbs;
mod neck;

use crate::body::{Body, body};
use crate::slices::{Ring, Slice, level, rings, without_arms};
use limbs::{legs, parts, upper_arm};
use nalgebra::{Point3, Vector3};
use neck::neck_plane;
use shape::{Cameras, Landmark, Landmarks, Mesh, Missing, Part, Plane};
use stage::{Ctx, Stage, Stop};
use std::sync::Arc;

stage::choice! {
    /// Where the waist is; four definitions are in use.
    pub enum Waist {
        /// The natural waist, between lowest rib and hip bone (ISO 8559-1 5.3.10).
        Natural = "natural",
        /// The narrowest of the trunk (ISAK).
        Narrowest = "narrowest",
        /// The navel (MESA).
        Navel = "navel",
        /// The top of the hip bone (NIH).
        HipBone = "hip_bone",
    }
}

stage::params! {
    /// Which definitions are used.
    pub struct LandmarkParams {
        /// Which waist is called WC.
        waist: Waist = Waist::Natural,
        /// How far the neck leans forward.
        #[range(0.0..=45.0)]
        neck_lean_deg: f64 = 20.0,
    }
}

stage::inputs! {
    /// A surface, upright in the turntable frame.
    pub struct LandmarkInput {
        /// The surface.
        mesh: Arc<Mesh>,
        /// Cameras: where the ground is.
        cameras: Option<Arc<Cameras>>,
    }
}

/// A mesh that is no body.
#[derive(Debug, thiserror::Error)]
#[error("the surface is empty or lies below the ground, so there is no body to measure")]
pub struct NoBody;

/// `measure.landmarks`: mesh → landmarks.
pub struct FindLandmarks;

/// Heights of levels that no shape marks on every body, as shares of the height of the narrowest of
/// the neck, which hardly depend on age and build: infant, heavy man and slim woman agree to 0.01.
const WAIST: f64 = 0.695;
const CHEST: f64 = 0.849;
const UPPER_ARM: f64 = 0.844;

impl Stage for FindLandmarks {
    const NAME: &'static str = "measure.landmarks";
    const VERSION: u32 = 1;
    const ABOUT: &'static str = "Finds neck, chest, waist, hip, arms and legs by how slices join and split, and by proportion.";
    type Params = LandmarkParams;
    type Input = LandmarkInput;
    type Output = Landmarks;

    fn run(p: &LandmarkParams, input: LandmarkInput, ctx: &Ctx<'_>) -> Result<Landmarks, Stop> {
        let mesh = &input.mesh;
        let lowest = mesh.bounds().map_or(0.0, |b| b.0.z);
        let ground = input.cameras.as_ref().map_or(lowest, |c| c.ground_mm);
        let body = body(mesh, ground).ok_or(NoBody)?;
        let mut found = Landmarks {
            stature_mm: body.stature,
            ..Landmarks::default()
        };
        found
            .points
            .push(("crown".into(), [0.0, 0.0, ground + body.stature]));
        if let Some(z) = body.crotch {
            found.points.push(("crotch".into(), [0.0, 0.0, z]));
        }
        let front = ("front".to_owned(), body.front.into());
        found.points.push(front);
        hip(&body, &mut found);
        match body.neck {
            Some(neck) => above(p, mesh, &body, neck - ground, &mut found),
            None => {
                for name in ["NC", "CC", "WC", "AC_L", "AC_R"] {
                    let why = "no neck was found between head and shoulders, and heights are told from it";
                    found.missing.push(Missing {
                        name: name.into(),
                        why: why.into(),
                    });
                }
            }
        }
        legs(&body, &mut found);
        found.parts = parts(mesh, &body);
        found
            .missing
            .iter()
            .for_each(|m| ctx.warn(format!("{}: {}", m.name, m.why)));
        Ok(found)
    }
}

fn landmark(name: &str, label: &str, definition: &str, plane: Plane, part: Part) -> Landmark {
    let (name, label, definition) = (name.into(), label.into(), definition.into());
    Landmark {
        name,
        label,
        definition,
        plane,
        part,
    }
}

/// A level plane amid the ring of the trunk.
fn across(body: &Body, z: f64) -> Plane {
    let amid = body.trunk(z).map_or(Point3::origin(), |r| r.centre);
    Plane {
        point_mm: [amid.x, amid.y, z],
        ..level(z)
    }
}

/// The hip: where the buttocks reach farthest back, above the crotch.
fn hip(body: &Body, found: &mut Landmarks) {
    let Some(crotch) = body.crotch else {
        let why = "no two legs were found, so nothing tells where the hip is".into();
        found.missing.push(Missing {
            name: "HC".into(),
            why,
        });
        return;
    };
    let back = |s: &Slice| {
        let points = &s.rings.first()?.curve;
        points
            .iter()
            .map(|p| -p.coords.dot(&body.front))
            .reduce(f64::max)
    };
    let range = body.between(crotch - 0.01 * body.stature, crotch + 0.16 * body.stature);
    let reach: Vec<(f64, f64)> = range.filter_map(|s| Some((s.z, back(s)?))).collect();
    // Smoothed over five slices: a hull's facets jump.
    let smooth = |i: usize| {
        let near = &reach[i.saturating_sub(2)..(i + 3).min(reach.len())];
        near.iter().map(|r| r.1).sum::<f64>() / near.len() as f64
    };
    let most = (0..reach.len()).max_by(|a, b| smooth(*a).total_cmp(&smooth(*b)));
    let Some(most) = most else { return };
    let text = "hip: horizontal, at the greatest prominence of the buttocks (ISO 8559-1 5.3.13)";
    found.found.push(landmark(
        "HC",
        "hip",
        text,
        across(body, reach[most].0),
        Part::Trunk,
    ));
}

/// Waist, chest, neck and upper arms, whose heights follow from the neck's.
fn above(p: &LandmarkParams, mesh: &Mesh, body: &Body, neck: f64, found: &mut Landmarks) {
    let at = |share: f64| body.ground + share * neck;
    let narrowest = narrowest(body, at(WAIST - 0.06), at(WAIST + 0.05));
    let (z, text) = match p.waist {
        Waist::Natural => (
            at(WAIST),
            "waist: horizontal, natural waist between lowest rib and hip bone (ISO 8559-1 5.3.10)",
        ),
        Waist::Narrowest => (
            narrowest.unwrap_or(at(WAIST)),
            "waist: horizontal, the narrowest of the trunk (ISAK)",
        ),
        Waist::Navel => (
            at(WAIST - 0.02),
            "waist: horizontal, at the navel's height (MESA)",
        ),
        Waist::HipBone => (
            at(WAIST - 0.035),
            "waist: horizontal, top of the hip bone (NIH)",
        ),
    };
    found
        .found
        .push(landmark("WC", "waist", text, across(body, z), Part::Trunk));
    let z = at(CHEST);
    let arms_off = body.trunk(z).is_some_and(|r| {
        let own = |v: Vector3<f64>| [v.x, v.y];
        !merged(body, z) || without_arms(r, own(body.left), own(body.front)).is_some()
    });
    if arms_off {
        let text = "chest: horizontal at the nipples' height, trunk only (ISO 8559-1 5.3.4)";
        found
            .found
            .push(landmark("CC", "chest", text, across(body, z), Part::Trunk));
    } else {
        let why = "arms and trunk are one on the surface there, without folds to part them: hold the arms farther away";
        found.missing.push(Missing {
            name: "CC".into(),
            why: why.into(),
        });
    }
    neck_plane(p, mesh, body, found);
    for (name, label, side, part) in [
        ("AC_L", "upper arm, left", 1.0, Part::ArmLeft),
        ("AC_R", "upper arm, right", -1.0, Part::ArmRight),
    ] {
        let text = "upper arm: across the arm, amid shoulder and elbow (ISO 8559-1 5.3.16)";
        match upper_arm(mesh, body, side, at(UPPER_ARM)) {
            Some(plane) => found.found.push(landmark(name, label, text, plane, part)),
            None => {
                let why = "this arm does not stand clear of the trunk on the surface: hold it farther away";
                found.missing.push(Missing {
                    name: name.into(),
                    why: why.into(),
                });
            }
        }
    }
}

/// Whether trunk and arms are one ring at a height: no smaller rings stand beside it.
pub(crate) fn merged(body: &Body, z: f64) -> bool {
    let Some(slice) = body.slice(z) else {
        return false;
    };
    let Some(trunk) = slice.rings.first() else {
        return false;
    };
    let beside = |side: f64| {
        slice.rings[1..]
            .iter()
            .any(|r| (r.centre - trunk.centre).dot(&body.left) * side > 0.0)
    };
    !(beside(1.0) && beside(-1.0))
}

/// The height of a true minimum of the trunk's tape between two heights.
fn narrowest(body: &Body, low: f64, high: f64) -> Option<f64> {
    let tapes: Vec<(f64, f64)> = body
        .between(low, high)
        .filter_map(|s| Some((s.z, s.rings.first()?.tape)))
        .collect();
    let least = tapes.iter().min_by(|a, b| a.1.total_cmp(&b.1))?;
    let ends = tapes.first()?.1.min(tapes.last()?.1);
    (least.1 < 0.99 * ends).then_some(least.0)
}

/// The ring of a landmark on a mesh: for the trunk the largest, else the one whose middle is the
/// plane's point; of several there, the largest.
pub(crate) fn ring_of(mesh: &Mesh, landmark: &Landmark) -> Option<Ring> {
    let all = rings(mesh, &landmark.plane);
    if landmark.part == Part::Trunk {
        return all.into_iter().next();
    }
    let p = Point3::from(landmark.plane.point_mm);
    let far = |r: &Ring| (r.centre - p).norm();
    let least = all.iter().map(far).fold(f64::MAX, f64::min);
    all.into_iter().find(|r| far(r) <= least + 3.0)
}
