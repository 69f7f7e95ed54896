//! The girth through picked points, as the report's page computes it: against the program's on the same surface,
//! and against `girths.json` of the same capture.

use super::chromium::Tab;
use super::server::Server;
use serde_json::Value;

/// So far page and program may be apart: the page keeps corners to a tenth of a millimetre. \[mm\]
const ROUNDED_MM: f64 = 0.3;
/// What the plane's settling on the surface's points may move the girth of a level section, as a share.
const SETTLED: f64 = 0.005;

/// Holds the girths of an open report of a capture.
pub(crate) fn live_girths(tab: &mut Tab, server: &Server, id: &str) {
    let file = |name: &str| {
        let path = format!("/captures/{id}/out/{name}");
        server.ask("GET", &path, &Value::Null).is(200).body
    };
    let file_json: Value = serde_json::from_slice(&file("girths.json")).unwrap();
    let body = shape::mesh_from_ply(&file("body.ply")).unwrap();
    tab.click("#pick");
    for name in ["WC", "HC", "TC_L", "CFC_R"] {
        let points = points(tab, name);
        let [tape, contour, spline] = through(tab, &points);
        let program = measure::picked(&body, &points).unwrap();
        for (page, program) in [
            (tape, program.tape_mm),
            (contour, program.contour_mm),
            (spline, program.spline_mm),
        ] {
            let off = (page - program).abs();
            assert!(off <= ROUNDED_MM, "{name}: {page} here, {program} there");
        }
        let girths = file_json["girths"].as_array().unwrap();
        let girth = girths.iter().find(|g| g["name"] == name).unwrap();
        let file_mm = 10.0 * girth["tape_cm"].as_f64().unwrap();
        let off = (tape / file_mm - 1.0).abs();
        println!(
            "{name}: page {tape:.2} {contour:.2} {spline:.2}, program {:.2} {:.2} {:.2}, girths.json {file_mm:.1} mm",
            program.tape_mm, program.contour_mm, program.spline_mm
        );
        // A thigh's own section is square to it, and so is that through its points.
        assert!(
            off <= SETTLED,
            "{name}: {tape} here, {file_mm} in girths.json"
        );
    }
}

/// Twelve points of a girth's section, as the page carries it. \[mm\]
fn points(tab: &mut Tab, name: &str) -> Vec<Vec<f64>> {
    let contour = tab.value(&format!(
        "JSON.parse(document.getElementById('scene').textContent).tapes.find((t) => t.name === '{name}').contour"
    ));
    let flat: Vec<f64> = serde_json::from_value(contour).unwrap();
    let all: Vec<Vec<f64>> = flat.chunks(3).map(<[f64]>::to_vec).collect();
    let picked = (0..12).map(|k| all[k * all.len() / 12].clone());
    picked.collect()
}

/// Tape, contour and spline through points that are put into the page. \[mm\]
fn through(tab: &mut Tab, points: &[Vec<f64>]) -> [f64; 3] {
    let points = serde_json::to_string(points).unwrap();
    let picked = tab.value(&format!(
        "(() => {{ const e = document.getElementById('points'); e.value = {points:?}; e.dispatchEvent(new Event('input'));
         const d = document.getElementById('picked').dataset; return [d.tape, d.contour, d.spline, document.getElementById('picked').textContent]; }})()"
    ));
    let number = |i: usize| {
        let text = picked[i].as_str().unwrap_or_default();
        text.parse().unwrap_or_else(|_| panic!("{picked}"))
    };
    [0, 1, 2].map(number)
}
