//! A comparison as one page, with the surfaces to turn around: coloured by how far apart they are.

use super::Comparison;
use super::surfaces::{distances, thinned};
use super::words::{Table, change_table, cost_table, girth_table, sentences, surface_table};
use crate::page;
use serde_json::{Value, json};
use shape::Mesh;

const SCRIPT: &str = include_str!("view.js");

/// Most faces of a surface on the page; those of the numbers are not thinned.
const MOST_FACES: usize = 60_000;

const VIEW: &str = r#"<section><h2>Surfaces</h2><p id="no3d" hidden>This browser shows no WebGL; the numbers below hold all the same.</p>
<div class="bar"><label>left <select id="left"></select></label><label>right <select id="right"></select></label>
<span><button data-mode="wipe" aria-pressed="true">wipe</button> <button data-mode="beside" aria-pressed="false">side by side</button></span>
<label>split <input id="split" type="range" min="0" max="1" step="0.001" value="0.5"></label>
<label><input id="colored" type="checkbox" checked> colour by distance, full at <input id="full" type="range" min="0.2" max="20" step="0.1" value="3"> <output id="shown"></output> mm</label>
<span><button id="front">front</button> <button id="side">side</button> <button id="back">back</button></span></div>
<div class="view"><canvas id="view" tabindex="0"></canvas></div>
<p class="soft">Orange lies outside of the other surface, blue inside; the first is held against the second, all others against the first. Drag to turn, wheel to come nearer, shift and drag to move.</p></section>"#;

/// The page.
pub fn page(c: &Comparison) -> String {
    let names: Vec<&str> = c.sides.iter().map(|s| s.name.as_str()).collect();
    let title = names.join(" against ");
    let meshes = meshes(c);
    let mut body = format!("<h1>{}</h1>\n", page::escaped(&title));
    for sentence in sentences(c) {
        body += &format!("<p>{}</p>\n", marked(&page::escaped(&sentence)));
    }
    if meshes.len() > 1 {
        body += VIEW;
    }
    for (title, table) in [
        ("Girths by tape", girth_table(c)),
        ("Surfaces, from the first", surface_table(c)),
        ("Said otherwise", change_table(c)),
        ("Time and size", cost_table(c)),
    ] {
        body += &section(title, &table);
    }
    page::page(&title, &body, &json!({ "meshes": meshes }), SCRIPT)
}

/// Names between backticks as code.
fn marked(html: &str) -> String {
    let part = |(i, part): (usize, &str)| match i % 2 {
        0 => part.to_owned(),
        _ => format!("<code>{part}</code>"),
    };
    html.split('`').enumerate().map(part).collect()
}

fn section(title: &str, table: &Table) -> String {
    if table.len() < 2 {
        return String::new();
    }
    let html = page::table("", &table[0], &table[1..]);
    format!("<section><h2>{title}</h2>{html}</section>\n")
}

/// The surfaces for the view: the first with its distance to the second, the others to the first.
fn meshes(c: &Comparison) -> Vec<Value> {
    let there: Vec<(&str, &Mesh)> = c
        .sides
        .iter()
        .filter_map(|s| Some((s.name.as_str(), s.mesh.as_ref()?)))
        .collect();
    let mut all = Vec::new();
    for (i, (name, mesh)) in there.iter().enumerate() {
        let Some((_, other)) = there.get(if i == 0 { 1 } else { 0 }) else {
            continue;
        };
        let thin = thinned(mesh, MOST_FACES);
        let whole = |x: f64, step: f64| (x / step).round() as i64;
        let positions = thin.positions.iter().flatten();
        all.push(json!({
            "name": name,
            // In tenths and hundredths of a millimetre.
            "positions": positions.map(|x| whole(f64::from(*x), 0.1)).collect::<Vec<_>>(),
            "distances": distances(&thin, other).iter().map(|d| whole(*d, 0.01)).collect::<Vec<_>>(),
            "faces": thin.faces.iter().flatten().collect::<Vec<_>>(),
        }));
    }
    all
}
