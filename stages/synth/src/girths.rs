//! The stage that tells girths by formula.

use crate::contour::{contour, length, taut};
use crate::frame::turn_between;
use nalgebra::{Point3, Rotation3, Vector3};
use shape::{
    Cameras, Girth, GirthId, Girths, Landmark, Landmarks, Missing, Part, Plane, Refusal, Sigmas,
    Solid,
};
use stage::{Ctx, Stage, Stop};
use std::sync::Arc;

stage::inputs! {
    /// A solid, and where to measure it.
    pub struct FormulaInput {
        /// The solid.
        solid: Arc<Solid>,
        /// Where; else at the solid's own planes.
        landmarks: Option<Arc<Landmarks>>,
        /// The cameras in whose frame the landmarks are.
        cameras: Option<Arc<Cameras>>,
        /// The cameras in whose frame the solid is.
        truth: Option<Arc<Cameras>>,
    }
}

/// `synth.girths`: solid → girths.
pub struct FormulaGirths;

impl Stage for FormulaGirths {
    const NAME: &'static str = "synth.girths";
    const VERSION: u32 = 4;
    const ABOUT: &'static str =
        "Gives a solid's girths by its formula, at landmarks or at its own planes.";
    type Params = ();
    type Input = FormulaInput;
    type Output = Girths;
    const METRICS: &'static [&'static str] = &["*"];

    fn run(_: &(), input: FormulaInput, ctx: &Ctx<'_>) -> Result<Girths, Stop> {
        let turn = match (&input.cameras, &input.truth) {
            (Some(found), Some(truth)) => turn_between(found, truth),
            _ => Rotation3::identity(),
        };
        let own = |(name, point_mm, normal): &(String, [f64; 3], [f64; 3])| {
            let plane = Plane {
                point_mm: *point_mm,
                normal: *normal,
            };
            let id = GirthId::named(name).unwrap_or(GirthId::Own);
            Landmark {
                name: name.clone(),
                label: name.clone(),
                ..Landmark::new(id, plane, Part::Trunk)
            }
        };
        let wanted: Vec<Landmark> = match &input.landmarks {
            Some(marks) => marks.found.clone(),
            None => input.solid.planes.iter().map(own).collect(),
        };
        let mut girths = Girths::default();
        for mark in wanted {
            ctx.check()?;
            let plane = mark.plane;
            let there = Plane {
                point_mm: (turn * Point3::from(plane.point_mm)).into(),
                normal: (turn * Vector3::from(plane.normal)).into(),
            };
            match contour(&input.solid, &there) {
                Some(curve) => girths.girths.push(girth(&mark, &there, &curve)),
                None => girths.missing.push(Missing {
                    id: Some(mark.id),
                    name: mark.name,
                    reason: Refusal::NoSection,
                    why: "the plane's point is not within the solid".into(),
                }),
            }
        }
        for girth in &girths.girths {
            ctx.metric(&girth.name, girth.tape_mm, "mm");
        }
        Ok(girths)
    }
}

fn girth(mark: &Landmark, plane: &Plane, curve: &[Point3<f64>]) -> Girth {
    let (contour_mm, tape_mm) = (length(curve), length(&taut(curve, plane)));
    let single = |p: &Point3<f64>| p.coords.map(|x| x as f32).into();
    Girth {
        definition: "by formula".into(),
        contour_mm,
        spline_mm: contour_mm,
        interval_mm: Some([tape_mm; 2]),
        sigmas: Sigmas::EXACT,
        repeat_mm: Some(0.0),
        plane: *plane,
        contour: curve.iter().step_by(16).map(single).collect(),
        ..Girth::at(mark, tape_mm)
    }
}
