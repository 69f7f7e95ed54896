//! The stage that takes girths that another program measured.

use crate::import::file::{FilePlane, FileUnit, ImportError, once, read};
use serde::Deserialize;
use shape::{Girth, GirthId, Girths, Landmark, Part, Region, Unit};
use stage::{Ctx, Files, Stage, Stop};
use std::sync::Arc;

stage::inputs! {
    /// Somebody's girths.
    pub struct GirthsFileInput {
        /// One `girths.json`, as `tailor show --as json` writes it: `unit` (`cm` or `relative`) and `girths`, each with
        /// `name`, `tape_cm` (or `tape_rel`), the `plane` that the tape lay in, and where they are known `cm`,
        /// `interval_cm`, `label`, `definition`; `stature_cm`. `AC`, the mean of both upper arms, follows from them. All else in it is passed over.
        files: Arc<Files>,
    }
}

/// `measure.import_girths`: files → girths.
pub struct ImportGirths;

#[derive(Deserialize)]
struct File {
    unit: FileUnit,
    girths: Vec<One>,
    stature_cm: Option<f64>,
    stature_rel: Option<f64>,
}

#[derive(Deserialize)]
struct One {
    name: String,
    label: Option<String>,
    definition: Option<String>,
    tape_cm: Option<f64>,
    tape_rel: Option<f64>,
    cm: Option<f64>,
    rel: Option<f64>,
    interval_cm: Option<[f64; 2]>,
    interval_rel: Option<[f64; 2]>,
    plane: Option<FilePlane>,
}

impl Stage for ImportGirths {
    const NAME: &'static str = "measure.import_girths";
    const VERSION: u32 = 1;
    const ABOUT: &'static str = "Takes girths that another program measured from a girths.json.";
    type Params = ();
    type Input = GirthsFileInput;
    type Output = Girths;

    fn run(_: &(), input: GirthsFileInput, _: &Ctx<'_>) -> Result<Girths, Stop> {
        let (file, stated): (String, File) = read(&input.files, "girths.json")?;
        once(&file, stated.girths.iter().map(|g| &g.name))?;
        let unit = stated.unit.unit();
        // The mean of both arms has no plane: it follows from them, and is written again with them.
        let follows = |g: &&One| GirthId::named(&g.name) == Some(GirthId::UpperArmMean);
        let taken = stated.girths.iter().filter(|g| !follows(g));
        let girths = taken.map(|g| {
            girth(g, unit).map_err(|why| ImportError::Entry {
                file: file.clone(),
                name: g.name.clone(),
                why,
            })
        });
        let girths: Vec<Girth> = girths.collect::<Result<_, _>>()?;
        let stature_mm = length(unit, stated.stature_cm, stated.stature_rel);
        Ok(Girths {
            unit,
            girths,
            stature_mm: stature_mm.filter(|mm| *mm > 0.0),
            ..Girths::default()
        })
    }
}

/// In millimetres, or thousandths of the relative unit.
fn length(unit: Unit, cm: Option<f64>, rel: Option<f64>) -> Option<f64> {
    match unit {
        Unit::Metric => cm.map(|x| 10.0 * x),
        Unit::Relative => rel.map(|x| 1000.0 * x),
    }
}

fn girth(stated: &One, unit: Unit) -> Result<Girth, &'static str> {
    let id = GirthId::named(&stated.name).unwrap_or(GirthId::Own);
    let tape = length(unit, stated.tape_cm, stated.tape_rel).ok_or(match unit {
        Unit::Metric => "it has no `tape_cm`",
        Unit::Relative => "it has no `tape_rel`",
    })?;
    if tape <= 0.0 {
        return Err("a tape is longer than nothing");
    }
    let ends = match unit {
        Unit::Metric => stated.interval_cm,
        Unit::Relative => stated.interval_rel,
    };
    let ends = ends.map(|ends| ends.map(|x| length(unit, Some(x), Some(x)).unwrap_or(x)));
    if ends.is_some_and(|[low, high]| !(low..=high).contains(&tape)) {
        return Err("its interval does not hold its tape");
    }
    let plane = stated.plane.as_ref().ok_or("missing field `plane`")?;
    let own = id == GirthId::Own;
    let mark = Landmark::new(id, plane.plane(unit)?, Part::Trunk);
    let label = stated.label.clone();
    let definition = stated.definition.clone();
    Ok(Girth {
        region: if own { Region::Anywhere } else { mark.region },
        name: stated.name.clone(),
        label: label.unwrap_or(if own {
            stated.name.replace('_', " ")
        } else {
            mark.label.clone()
        }),
        definition: definition.unwrap_or(if own {
            "as another program has it".into()
        } else {
            mark.definition.clone()
        }),
        contour_mm: length(unit, stated.cm, stated.rel)
            .filter(|x| *x > 0.0)
            .unwrap_or(tape),
        interval_mm: ends,
        ..Girth::at(&mark, tape)
    })
}
