//! The stage that holds results against what is true by formula.

use crate::errors::{camera_errors, overlap, surface_errors};
use crate::frame::turn_between;
use nalgebra::Rotation3;
use serde_json::{Map, Value, json};
use shape::{Cameras, Document, Girths, Masks, Mesh, Solid};
use stage::{Ctx, Stage, Stop};
use std::sync::Arc;

stage::inputs! {
    /// Results, and the truth beside each.
    pub struct ScoreInput {
        /// Girths as measured.
        girths: Option<Arc<Girths>>,
        /// Girths by formula, at the same planes.
        formula: Option<Arc<Girths>>,
        /// Cameras as found.
        cameras: Option<Arc<Cameras>>,
        /// The true cameras.
        true_cameras: Option<Arc<Cameras>>,
        /// Silhouettes as found.
        masks: Option<Arc<Masks>>,
        /// The true silhouettes.
        true_masks: Option<Arc<Masks>>,
        /// A surface as found.
        mesh: Option<Arc<Mesh>>,
        /// The solid.
        solid: Option<Arc<Solid>>,
    }
}

/// `synth.score`: results, truth → a table of errors.
pub struct Score;

impl Stage for Score {
    const NAME: &'static str = "synth.score";
    const VERSION: u32 = 2;
    const ABOUT: &'static str = "Holds girths, cameras, silhouettes and a surface against what is true by formula; errors are metrics.";
    type Params = ();
    type Input = ScoreInput;
    type Output = Document;
    const METRICS: &'static [&'static str] = &[
        "girths mean error",
        "girths worst error",
        "girths measured",
        "girths * error",
        "cameras found",
        "cameras median centre error",
        "cameras worst centre error",
        "cameras scale error",
        "cameras focal error",
        "masks mean IoU",
        "masks worst IoU",
        "surface mean distance",
        "surface mean outward",
        "surface 95 of 100 within",
    ];

    fn run(_: &(), input: ScoreInput, ctx: &Ctx<'_>) -> Result<Document, Stop> {
        let mut reported = Map::new();
        let mut tell = |group: &str, name: &str, value: f64, unit: &str| {
            ctx.metric(&format!("{group} {name}"), value, unit);
            let group = reported.entry(group).or_insert_with(|| json!({}));
            let rounded = (value * 1e4).round() / 1e4;
            group[format!("{name} [{unit}]")] = json!(rounded);
        };
        let mut table = vec![];
        if let (Some(found), Some(formula)) = (&input.girths, &input.formula) {
            table = girth_rows(found, formula);
            let errors: Vec<f64> = table.iter().map(|r| r.error_percent).collect();
            if !errors.is_empty() {
                let mean = errors.iter().map(|e| e.abs()).sum::<f64>() / errors.len() as f64;
                let worst = errors.iter().map(|e| e.abs()).fold(0.0, f64::max);
                tell("girths", "mean error", mean, "%");
                tell("girths", "worst error", worst, "%");
            }
            tell("girths", "measured", errors.len() as f64, "");
            for row in &table {
                tell(
                    "girths",
                    &format!("{} error", row.name),
                    row.error_percent,
                    "%",
                );
            }
        }
        let turn = match (&input.cameras, &input.true_cameras) {
            (Some(found), Some(truth)) => {
                let errors = camera_errors(found, truth);
                tell("cameras", "found", errors.found as f64, "");
                tell("cameras", "median centre error", errors.median_mm, "mm");
                tell("cameras", "worst centre error", errors.worst_mm, "mm");
                tell("cameras", "scale error", 100.0 * errors.scale, "%");
                tell("cameras", "focal error", 100.0 * errors.focal, "%");
                turn_between(found, truth)
            }
            _ => Rotation3::identity(),
        };
        if let (Some(found), Some(truth)) = (&input.masks, &input.true_masks) {
            let overlaps: Vec<f64> = found
                .views
                .join(&truth.views)
                .map(|(_, a, b)| overlap(&a.pixels(), &b.pixels()))
                .collect();
            let mean = overlaps.iter().sum::<f64>() / overlaps.len().max(1) as f64;
            let worst = overlaps.iter().copied().fold(1.0, f64::min);
            tell("masks", "mean IoU", mean, "");
            tell("masks", "worst IoU", worst, "");
        }
        if let (Some(mesh), Some(solid)) = (&input.mesh, &input.solid) {
            let errors = surface_errors(mesh, solid, &turn);
            tell("surface", "mean distance", errors.mean_mm, "mm");
            tell("surface", "mean outward", errors.outward_mm, "mm");
            tell("surface", "95 of 100 within", errors.p95_mm, "mm");
        }
        let rows: Vec<Value> = table.iter().map(Row::json).collect();
        let missing = input.girths.iter().flat_map(|g| &g.missing);
        let missing: Vec<Value> = missing
            .map(|m| json!({ "name": m.name, "why": m.why.as_str() }))
            .collect();
        reported.insert("table".into(), json!(rows));
        reported.insert("missing".into(), json!(missing));
        let text = serde_json::to_string_pretty(&reported)?;
        Ok(Document {
            media: "application/json".into(),
            bytes: text.into_bytes(),
        })
    }
}

/// A girth beside its formula.
struct Row {
    name: String,
    measured_mm: f64,
    formula_mm: f64,
    interval_mm: Option<[f64; 2]>,
    error_percent: f64,
}

impl Row {
    fn json(&self) -> Value {
        let round = |x: f64| (x * 100.0).round() / 100.0;
        let holds = |[low, high]: [f64; 2]| (low..=high).contains(&self.formula_mm);
        json!({
            "name": self.name,
            "measured_mm": round(self.measured_mm),
            "formula_mm": round(self.formula_mm),
            "error_percent": (self.error_percent * 1e3).round() / 1e3,
            "interval_mm": self.interval_mm.map(|ends| ends.map(round)),
            "interval_holds": self.interval_mm.map(holds),
        })
    }
}

/// The tapes that both tell.
fn girth_rows(found: &Girths, formula: &Girths) -> Vec<Row> {
    let row = |g: &shape::Girth| {
        let truth = formula.get(&g.name)?;
        Some(Row {
            name: g.name.clone(),
            measured_mm: g.tape_mm,
            formula_mm: truth.tape_mm,
            interval_mm: g.interval_mm,
            error_percent: 100.0 * (g.tape_mm / truth.tape_mm - 1.0),
        })
    };
    found.girths.iter().filter_map(row).collect()
}
