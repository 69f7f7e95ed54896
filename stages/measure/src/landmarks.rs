//! The stage that finds where to measure, without a statistical body model.

use crate::body::{Body, arm, body, nearest_ring};
use crate::slices::{level, rings, without_arms};
use nalgebra::{Point3, Vector3};
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
const WAIST: f64 = 0.679;
const CHEST: f64 = 0.832;
const UPPER_ARM: f64 = 0.824;

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
    let back = |s: &crate::slices::Slice| {
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
    let narrowest = narrowest(body, at(WAIST - 0.045), at(WAIST + 0.045));
    let (z, text) = match p.waist {
        Waist::Natural => (
            narrowest.unwrap_or(at(WAIST)),
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
        let why = "arms and trunk are one there, without folds to part them: hold the arms away";
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
                let why = "this arm does not stand clear of the trunk: hold it away";
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
    (least.1 < 0.985 * ends).then_some(least.0)
}

/// The neck: the narrowest across its axis, which leans forward.
fn neck_plane(p: &LandmarkParams, mesh: &Mesh, body: &Body, found: &mut Landmarks) {
    let Some(z) = body.neck else { return };
    let lean = p.neck_lean_deg.to_radians();
    let axis = Vector3::z() * lean.cos() + body.front * lean.sin();
    let Some(ring) = body.trunk(z) else { return };
    let tape = |offset: f64| {
        let plane = Plane {
            point_mm: (ring.centre + axis * offset).into(),
            normal: axis.into(),
        };
        Some((nearest_ring(mesh, &plane)?.tape, plane))
    };
    let reach = 0.025 * body.stature;
    let tried = (-10..=10).filter_map(|k| tape(f64::from(k) * reach / 10.0));
    if let Some((_, plane)) = tried.min_by(|a, b| a.0.total_cmp(&b.0)) {
        let text = "neck: across its axis, at its narrowest (ISO 8559-1 5.3.2)";
        found
            .found
            .push(landmark("NC", "neck", text, plane, Part::Head));
    }
}

/// The plane across an upper arm; moved down the arm, by a quarter of it at most, until the arm
/// stands clear.
fn upper_arm(mesh: &Mesh, body: &Body, side: f64, z: f64) -> Option<Plane> {
    let found = arm(mesh, body, side, z)?;
    let step = 0.004 * body.stature;
    let ring_at = |k: i32| {
        let point = Point3::from(found.plane.point_mm) + found.axis * (f64::from(k) * step);
        let plane = Plane {
            point_mm: point.into(),
            normal: found.axis.into(),
        };
        nearest_ring(mesh, &plane).map(|r| (plane, r))
    };
    // Well below the armpit the arm is surely clear: a clear ring is not much larger than there.
    let (_, below) = ring_at(16)?;
    let clear = (0..12).filter_map(ring_at).find(|(plane, ring)| {
        let near = (ring.centre - Point3::from(plane.point_mm)).norm();
        ring.area < 1.8 * below.area && near < 0.05 * body.stature
    })?;
    Some(Plane {
        point_mm: clear.1.centre.into(),
        ..clear.0
    })
}

/// Thigh and calf of both legs.
fn legs(body: &Body, found: &mut Landmarks) {
    let Some(crotch) = body.crotch else { return };
    let inside = crotch - body.ground;
    for (side, part, suffix, word) in [
        (1.0, Part::LegLeft, "L", "left"),
        (-1.0, Part::LegRight, "R", "right"),
    ] {
        let leg = |s: &crate::slices::Slice| {
            let two = s.rings.get(..2)?;
            let out = |r: &crate::slices::Ring| r.centre.coords.dot(&body.left) * side;
            let ring = if out(&two[0]) > out(&two[1]) {
                &two[0]
            } else {
                &two[1]
            };
            Some((s.z, ring.tape, ring.centre))
        };
        let widest = |low: f64, high: f64| {
            let range = body.between(body.ground + low * inside, body.ground + high * inside);
            range.filter_map(leg).max_by(|a, b| a.1.total_cmp(&b.1))
        };
        let mut add = |name: &str, label: &str, text: &str, at: Option<(f64, f64, Point3<f64>)>| {
            let Some((z, _, c)) = at else { return };
            let plane = Plane {
                point_mm: [c.x, c.y, z],
                ..level(z)
            };
            let (name, label) = (format!("{name}_{suffix}"), format!("{label}, {word}"));
            found.found.push(landmark(&name, &label, text, plane, part));
        };
        add(
            "TC",
            "thigh",
            "thigh: horizontal, fullest below the crotch (ISO 8559-1 5.3.20)",
            widest(0.8, 0.99),
        );
        add(
            "CFC",
            "calf",
            "calf: horizontal, greatest (ISO 8559-1 5.3.24)",
            widest(0.3, 0.58),
        );
    }
}

/// The part of each vertex: head above the neck, legs below the crotch, arms beyond the trunk.
fn parts(mesh: &Mesh, body: &Body) -> Vec<u8> {
    let neck = body.neck.unwrap_or(f64::MAX);
    let crotch = body.crotch.unwrap_or(f64::MIN);
    let half = body
        .trunk(crotch.max(body.ground) + 0.05 * body.stature)
        .map_or(f64::MAX, |r| {
            let reach = r.curve.iter().map(|p| (p - r.centre).dot(&body.left).abs());
            reach.fold(0.0, f64::max)
        });
    let part = |v: u32| {
        let p = mesh.point(v);
        let out = p.coords.dot(&body.left);
        let (arm, leg) = match out > 0.0 {
            true => (Part::ArmLeft, Part::LegLeft),
            false => (Part::ArmRight, Part::LegRight),
        };
        match p.z {
            z if z > neck => Part::Head,
            _ if out.abs() > 1.15 * half => arm,
            z if z < crotch => leg,
            _ => Part::Trunk,
        }
    };
    (0..mesh.positions.len() as u32)
        .map(|v| part(v) as u8)
        .collect()
}

/// The ring of a landmark on a mesh: for the trunk the largest, else the nearest.
pub(crate) fn ring_of(mesh: &Mesh, landmark: &Landmark) -> Option<crate::slices::Ring> {
    match landmark.part {
        Part::Trunk => rings(mesh, &landmark.plane).into_iter().next(),
        _ => nearest_ring(mesh, &landmark.plane),
    }
}
