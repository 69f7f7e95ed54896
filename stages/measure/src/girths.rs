//! The stage that measures: contour, tape and the paper's spline at each landmark.

use crate::body::{Body, body};
use crate::derive::{derive, profile};
use crate::interval::{NINE_IN_TEN, Spread, carried_spread, level_spread};
use crate::taken::taken;
use shape::{Cameras, Girth, Girths, Landmark, Landmarks, Mesh, Missing, Photos};
use stage::{Ctx, Stage, Stop};
use std::sync::Arc;

stage::params! {
    /// How sure the surface is.
    pub struct GirthParams {
        /// Standard deviation of the surface along its normal, even all over a section, where
        /// neither cameras nor silhouettes say more.
        #[range(0.0..=50.0)]
        surface_mm: f64 = 0.6,
    }
}

stage::inputs! {
    /// A surface and where to measure it.
    pub struct GirthInput {
        /// The surface.
        mesh: Arc<Mesh>,
        /// Where.
        landmarks: Arc<Landmarks>,
        /// Cameras: how sure the scale is, and where the ground is.
        cameras: Option<Arc<Cameras>>,
        /// Photos: what the user said of stature and weight.
        photos: Option<Arc<Photos>>,
    }
}

/// `measure.girths`: mesh, landmarks → girths.
pub struct Measure;

/// How much longer than its tape the skin around a waist may be: more points to a hole.
const WAIST_FOLDS: f64 = 1.05;

impl Stage for Measure {
    const NAME: &'static str = "measure.girths";
    const VERSION: u32 = 4;
    const ABOUT: &'static str = "Measures girths at landmarks: along the skin, as a tape, and as the paper's closed spline (eq. 8).";
    type Params = GirthParams;
    type Input = GirthInput;
    type Output = Girths;

    fn run(p: &GirthParams, input: GirthInput, ctx: &Ctx<'_>) -> Result<Girths, Stop> {
        let (mesh, landmarks) = (&input.mesh, &input.landmarks);
        let ground = input.cameras.as_ref().map_or(0.0, |c| c.ground_mm);
        let scale_sigma = input.cameras.as_ref().map_or(0.0, |c| c.scale_sigma);
        let body = body(mesh, ground);
        let mut girths = Girths {
            missing: landmarks.missing.clone(),
            ..Girths::default()
        };
        let steps = ctx.steps("girths", landmarks.found.len());
        for landmark in &landmarks.found {
            match girth(p, mesh, landmark, body.as_ref(), scale_sigma) {
                Ok(girth) => girths.girths.push(girth),
                Err(why) => {
                    ctx.warn(format!("{}: {why}", landmark.name));
                    girths.missing.push(Missing {
                        name: landmark.name.clone(),
                        why: why.into(),
                    });
                }
            }
            steps.tick()?;
        }
        if let Some(waist) = girths.get("WC")
            && waist.contour_mm > WAIST_FOLDS * waist.tape_mm
        {
            ctx.warn(format!(
                "WC: the skin around the waist is {:.0} % longer than a tape, which points to a hole in the surface or to \
                 an arm that touches it: look at the section",
                100.0 * (waist.contour_mm / waist.tape_mm - 1.0)
            ));
        }
        let rig = input
            .photos
            .as_ref()
            .map(|photos| photos.rig.clone())
            .unwrap_or_default();
        let (stature, kg) = (rig.stature_mm, rig.weight_kg);
        derive(&mut girths, mesh, landmarks.stature_mm, stature, kg);
        if let Some(body) = &body {
            girths.profile = profile(body, &girths);
        }
        Ok(girths)
    }
}

fn girth(
    p: &GirthParams,
    mesh: &Mesh,
    landmark: &Landmark,
    body: Option<&Body>,
    scale_sigma: f64,
) -> Result<Girth, &'static str> {
    let here = taken(mesh, body, landmark)?;
    let spread = Spread {
        level: body.map_or(0.0, |b| level_spread(mesh, b, landmark, here.tape_mm)),
        surface: std::f64::consts::TAU * p.surface_mm,
        carried: carried_spread(here.carried, here.tape_mm),
        scale: scale_sigma * here.tape_mm,
    };
    let reach = NINE_IN_TEN * spread.total();
    let note = match here.carried > 0.0 {
        true => format!(
            "; arm and trunk are one there on the surface: {:.0} % of the way around is carried over from where they are apart",
            100.0 * here.carried
        ),
        false => String::new(),
    };
    Ok(Girth {
        name: landmark.name.clone(),
        label: landmark.label.clone(),
        definition: format!("{}{note}", landmark.definition),
        contour_mm: here.contour_mm,
        tape_mm: here.tape_mm,
        spline_mm: here.spline_mm,
        silhouette_mm: None,
        interval_mm: [here.tape_mm - reach, here.tape_mm + reach],
        plane: landmark.plane,
        contour: here
            .contour
            .iter()
            .map(|p| [p.x as f32, p.y as f32, p.z as f32])
            .collect(),
    })
}
