//! Girths of made bodies end to end against their truth, as the table that coverage is tested on.
//!
//! ```sh
//! cargo run --release -p measure --features tables --example girth_errors -- MADE [hull] > models/tables/girths.csv
//! ```
//!
//! `hull` measures them as if they were carved from outlines that show nothing more.
//! `MADE` is the folder that `models/made/make_bodies.py` wrote. A row a girth: `tape`, its 90 %
//! interval and the truth (the template's tape at the true plane) in millimetres; or `refused` with the reason.
//! Waist and chest of bodies that the model was fitted on are in-sample: `[[held_out]]` of the model has those.

mod made_bodies;

use made_bodies::{Fault, read, written};
use measure::{FindLandmarks, GirthInput, LandmarkInput, Measure};
use stage::{Ctx, Stage};
use std::path::Path;
use std::sync::Arc;

/// Names of girths, and of the true planes.
const GIRTHS: [(&str, &str); 11] = [
    ("HC", "hip"),
    ("WC", "waist"),
    ("WC_navel", "navel"),
    ("CC", "chest"),
    ("NC", "neck"),
    ("AC_L", "upper_arm_l"),
    ("AC_R", "upper_arm_r"),
    ("TC_L", "thigh_l"),
    ("TC_R", "thigh_r"),
    ("CFC_L", "calf_l"),
    ("CFC_R", "calf_r"),
];

fn main() -> Result<(), Fault> {
    written(
        ["id", "girth", "refused", "tape", "low", "high", "truth"],
        body,
    )
}

/// The rows of one body.
fn body(path: &Path) -> Result<Vec<Vec<String>>, Fault> {
    let made = read(path)?;
    let stopped = |s: stage::Stop| match s {
        stage::Stop::Failed(e) => e.to_string(),
        stage::Stop::Cancelled => "cancelled".into(),
    };
    let features = Arc::new(made.features().map_err(stopped)?);
    let input = LandmarkInput {
        mesh: made.mesh.clone(),
        features: features.clone(),
        levels: None,
    };
    let landmarks =
        FindLandmarks::run(&Default::default(), input, &Ctx::alone()).map_err(stopped)?;
    let hull = std::env::args().nth(2).is_some_and(|word| word == "hull");
    let input = GirthInput {
        mesh: made.mesh.clone(),
        features,
        landmarks: Arc::new(landmarks),
        cameras: None,
        photos: None,
        masks: hull.then(Default::default),
        person: None,
        lost_parts: None,
    };
    let girths = Measure::run(&Default::default(), input, &Ctx::alone()).map_err(stopped)?;
    let number = |v: Option<f64>| v.map_or(String::new(), |v| format!("{v:.1}"));
    let row = |(name, plane): (&str, &str)| {
        let truth = made.truth["planes"][plane]["tape_clean"].as_f64()?;
        let mut row = vec![made.id.clone(), name.to_owned()];
        match girths.get(name) {
            Some(g) => {
                row.push(String::new());
                row.extend([
                    number(Some(g.tape_mm)),
                    number(g.interval_mm.map(|i| i[0])),
                    number(g.interval_mm.map(|i| i[1])),
                ]);
            }
            None => {
                let missing = girths.missing.iter().find(|m| m.name == name)?;
                row.push(
                    serde_json::to_value(missing.reason)
                        .ok()?
                        .as_str()
                        .unwrap_or_default()
                        .into(),
                );
                row.extend(vec![String::new(); 3]);
            }
        }
        row.push(number(Some(truth)));
        Some(row)
    };
    Ok(GIRTHS.into_iter().filter_map(row).collect())
}
