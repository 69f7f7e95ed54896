//! The stage that takes planes to measure at from another program.

use crate::features::limb::limbs;
use crate::features::standing::standing;
use crate::find_body::BodyError;
use crate::import::file::{FilePlane, FileUnit, ImportError, once, read, region, word};
use crate::planes::limbs::parts;
use serde::Deserialize;
use shape::{Cameras, GirthId, Landmark, Landmarks, Mesh, Part, PlaneSigma, Unit};
use stage::{Ctx, Files, Stage, Stop};
use std::sync::Arc;

stage::inputs! {
    /// Somebody's landmarks, and the surface that they are on.
    pub struct LandmarksFileInput {
        /// One `landmarks.json`, as `tailor show --as json` writes it: `unit` (`mm` or `relative`) and `landmarks`,
        /// each with `name`, `part`, `plane`, and where they are known `label`, `definition`, `sigma`. All else in it
        /// is passed over.
        files: Arc<Files>,
        /// The surface.
        mesh: Arc<Mesh>,
        /// Cameras: where the ground is given.
        cameras: Option<Arc<Cameras>>,
    }
}

/// `measure.import_landmarks`: files, mesh → landmarks.
pub struct ImportLandmarks;

#[derive(Deserialize)]
struct File {
    unit: FileUnit,
    landmarks: Vec<One>,
}

#[derive(Deserialize)]
struct One {
    name: String,
    label: Option<String>,
    definition: Option<String>,
    part: Part,
    plane: FilePlane,
    #[serde(default)]
    sigma: FileSigma,
}

/// How sure a plane is; what is not there is not known.
#[derive(Deserialize, Default)]
#[serde(default)]
struct FileSigma {
    level_mm: Option<f64>,
    level_rel: Option<f64>,
    tilt_deg: Option<f64>,
    repeat_mm: Option<f64>,
    repeat_rel: Option<f64>,
    hidden_mm: Option<f64>,
    hidden_rel: Option<f64>,
}

impl FileSigma {
    fn sigma(&self, unit: Unit) -> Result<PlaneSigma, &'static str> {
        let either = |mm: Option<f64>, rel: Option<f64>| match unit {
            Unit::Metric => mm,
            Unit::Relative => rel.map(|x| 1000.0 * x),
        };
        let sigma = PlaneSigma {
            level_mm: either(self.level_mm, self.level_rel),
            tilt_rad: self.tilt_deg.map(f64::to_radians),
            repeat_mm: either(self.repeat_mm, self.repeat_rel),
            hidden_mm: either(self.hidden_mm, self.hidden_rel),
        };
        let wrong = [
            (
                sigma.level_mm,
                "`level_mm` or `level_rel` of `sigma` is below 0: give a standard deviation, or leave it out",
            ),
            (
                sigma.tilt_rad,
                "`tilt_deg` of `sigma` is below 0: give a standard deviation, or leave it out",
            ),
            (
                sigma.repeat_mm,
                "`repeat_mm` or `repeat_rel` of `sigma` is below 0: give a standard deviation, or leave it out",
            ),
            (
                sigma.hidden_mm,
                "`hidden_mm` or `hidden_rel` of `sigma` is below 0: give how much longer the girth may be, or leave it out",
            ),
        ];
        match wrong
            .iter()
            .find(|(given, _)| given.is_some_and(|x| x < 0.0))
        {
            None => Ok(sigma),
            Some((_, why)) => Err(why),
        }
    }
}

impl Stage for ImportLandmarks {
    const NAME: &'static str = "measure.import_landmarks";
    const VERSION: u32 = 3;
    const ABOUT: &'static str = "Takes planes to measure at from a landmarks.json.";
    type Params = ();
    type Input = LandmarksFileInput;
    type Output = Landmarks;

    fn run(_: &(), input: LandmarksFileInput, ctx: &Ctx<'_>) -> Result<Landmarks, Stop> {
        let mesh = &input.mesh;
        let unit = input.cameras.as_ref().map_or(mesh.unit, |c| c.scale.unit());
        let (file, stated): (String, File) = read(&input.files, "landmarks.json")?;
        if stated.unit.unit() != unit {
            let (file_unit, unit) = (word(stated.unit.unit()), word(unit));
            let wrong = ImportError::Unit {
                file,
                file_unit,
                unit,
            };
            return Err(wrong.into());
        }
        once(&file, stated.landmarks.iter().map(|l| &l.name))?;
        let found = stated.landmarks.iter().map(|l| {
            landmark(l, unit).map_err(|why| ImportError::Entry {
                file: file.clone(),
                name: l.name.clone(),
                why,
            })
        });
        let found = found.collect::<Result<Vec<_>, _>>()?;
        let placed = standing(mesh, input.cameras.as_deref()).ok_or(BodyError::NoBody)?;
        let body = placed.body;
        let mut all = Landmarks {
            unit,
            found,
            parts: parts(mesh, &body, &limbs(mesh, &body)),
            ..Landmarks::default()
        };
        if body.is_measurable() {
            all.ground_mm = Some(body.ground);
            all.stature_mm = Some(body.stature);
            all.stature_sigma_mm = body.stature_sigma;
            placed.word.iter().for_each(|word| ctx.warn(word));
        }
        Ok(all)
    }
}

fn landmark(stated: &One, unit: Unit) -> Result<Landmark, &'static str> {
    let (plane, sigma) = (stated.plane.plane(unit)?, stated.sigma.sigma(unit)?);
    let id = GirthId::named(&stated.name).unwrap_or(GirthId::Own);
    let own = Landmark::new(id, plane, stated.part);
    Ok(Landmark {
        region: match id {
            GirthId::Own => region(stated.part),
            _ => own.region,
        },
        label: match (&stated.label, id) {
            (Some(label), _) => label.clone(),
            (None, GirthId::Own) => stated.name.replace('_', " "),
            (None, _) => own.label,
        },
        definition: match (&stated.definition, id) {
            (Some(text), _) => text.clone(),
            (None, GirthId::Own) => "as another program has it".into(),
            (None, _) => own.definition,
        },
        name: stated.name.clone(),
        sigma,
        ..own
    })
}
