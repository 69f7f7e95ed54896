//! A point against ground truth: what it wrote is scored in a folder that goes again.

use crate::engine::Outcome;
use crate::graph::Graph;
use crate::{delivery, score};
use stage::Metric;
use std::path::Path;

/// What a folder of truth may have; it needs one of them.
const TRUTH: [&str; 3] = ["cameras.json", "measurements.json", "mesh.ply"];

/// Errors of a point: `error.WC` by tape \[mm\], `error.WC.contour` \[%\], cameras and surface.
pub(crate) fn errors(
    graph: &Graph,
    outcome: &Outcome,
    truth: &Path,
) -> Result<Vec<Metric>, String> {
    if !TRUTH.iter().any(|file| truth.join(file).is_file()) {
        return Err(format!(
            "{} has no truth: none of {}",
            truth.display(),
            TRUTH.join(", ")
        ));
    }
    let folder = tempfile::tempdir().map_err(|e| e.to_string())?;
    for (kind, file, format) in [
        ("cameras", "cameras.json", "json"),
        ("girths", "girths.json", "json"),
        ("mesh", "body.ply", "ply"),
    ] {
        let Some(artifact) = body(graph, outcome, kind) else {
            continue;
        };
        let files = io::files(artifact, format, None);
        let files = files.map_err(|e| e.to_string())?;
        delivery::write(&folder.path().join(file), &files).map_err(|e| e.to_string())?;
    }
    let score = score::score(folder.path(), truth).map_err(|e| e.to_string())?;
    match another(&score) {
        Some(of) => Err(format!(
            "{} is the truth of other photos: none of its {of} cameras is called as a photo of this capture",
            truth.display()
        )),
        None => Ok(metrics(&score)),
    }
}

/// How many cameras a truth has of which none is one of the result's.
fn another(score: &score::Score) -> Option<usize> {
    let cameras = score.cameras.as_ref()?;
    (cameras.registered == 0 && cameras.of > 0).then_some(cameras.of)
}

/// The result of a kind: the last one in the pipeline; for a surface, the one that is measured.
fn body(graph: &Graph, outcome: &Outcome, kind: &str) -> Option<stage::AnyArtifact> {
    let at = match kind {
        "mesh" => crate::measured::measured(graph),
        kind => (0..graph.nodes.len())
            .rev()
            .find(|i| graph.nodes[*i].stage.yields() == kind),
    };
    outcome.artifact(graph, at?)
}

fn metrics(score: &score::Score) -> Vec<Metric> {
    let metric = |name: String, value: f64, unit: &str| Metric {
        name,
        value,
        unit: unit.into(),
    };
    let mut all = Vec::new();
    for (name, girth) in &score.girths {
        let Some(girth) = girth else { continue };
        let tape = girth.tape_error_mm;
        all.extend(tape.map(|v| metric(name.clone(), v, "mm tape")));
        let contour = girth.error_pct;
        all.extend(contour.map(|v| metric(format!("{name}.contour"), v, "%")));
    }
    if let Some(cameras) = &score.cameras {
        all.extend(
            cameras
                .centre_mm_median
                .map(|v| metric("cameras".into(), v, "mm")),
        );
        all.extend(
            cameras
                .scale_error_pct
                .map(|v| metric("scale".into(), v, "%")),
        );
    }
    if let Some(mesh) = &score.mesh {
        all.push(metric("surface".into(), mesh.all.accuracy_mean_mm, "mm"));
        all.push(metric("surface.bias".into(), mesh.all.bias_mm, "mm"));
    }
    all
}
