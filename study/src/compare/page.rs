//! A comparison as one page, with the surfaces to turn around: coloured by how far apart they are.

use super::Comparison;
use super::pictures::{Surface, pictures};
use super::surfaces::distances;
use super::words::{
    COST, GIRTHS, LEGEND, SETTINGS, SURFACES, change_table, cost_table, girth_table, sentences,
    surface_table,
};
use crate::reader::English;
use crate::table::Table;
use serde_json::{Value, json};
use shape::{Mesh, thinned};
use tables::html;

const SCRIPT: &str = concat!(include_str!("view.js"), include_str!("pictures.js"));

/// Most faces of a surface on the page; those of the numbers are not thinned.
const MOST_FACES: usize = 60_000;

const VIEW: &str = r#"<section><h2>Surfaces</h2><p id="no3d" hidden>This browser shows no WebGL; the numbers below hold all the same.</p>
<div class="bar"><label>left <select id="left"></select></label><label>right <select id="right"></select></label>
<span><button data-mode="wipe" aria-pressed="true">wipe</button> <button data-mode="beside" aria-pressed="false">side by side</button></span>
<label>split <input id="split" type="range" min="0" max="1" step="0.001" value="0.5"></label>
<label><input id="colored" type="checkbox" checked> colour by distance, full at <input id="full" type="range" min="0.2" max="20" step="0.1" value="3"> <output id="shown"></output> mm</label>
<span><button id="front">front</button> <button id="side">side</button> <button id="back">back</button></span></div>
<div class="view"><canvas id="view" tabindex="0"></canvas></div>
<p class="soft">Orange is outside of the other surface, blue inside; the first is compared with the second, each further one with the first. Drag to turn, wheel to come nearer, shift and drag to move.</p></section>"#;

const IMAGES: &str = r#"<section><h2>Images</h2>
<div class="bar"><label>photo <select id="photo"></select></label><span><button id="before" aria-label="the photo before">◀</button> <button id="after" aria-label="the next photo">▶</button></span></div>
<div id="pictures"></div>
<p class="soft">What is outside of the first side's is orange, what is inside blue.</p></section>"#;

/// Distance at which a surface is coloured fully until the slider is moved. \[mm\]
const FULL_MM: f64 = 3.0;

/// The page; photos are on it only if they may be.
pub fn page(c: &Comparison, show_photos: bool) -> String {
    let names: Vec<&str> = c.sides.iter().map(|s| s.name.as_str()).collect();
    let title = names.join(" against ");
    let shown = surfaces(c, true);
    // Cameras see surfaces where they are.
    let unmoved = match c.laid.iter().any(Option::is_some) {
        true => &surfaces(c, false),
        false => &shown,
    };
    let pictures = pictures(&c.sides, unmoved, show_photos, FULL_MM);
    let mut body = format!("<h1>{}</h1>\n", html::escaped(&title));
    for sentence in sentences(c, &English) {
        body += &format!("<p>{}</p>\n", marked(&html::escaped(&sentence)));
    }
    if shown.len() > 1 {
        body += VIEW;
    }
    if pictures["uris"]
        .as_array()
        .is_some_and(|all| !all.is_empty())
    {
        body += IMAGES;
    }
    for (title, table) in [
        (GIRTHS, girth_table(c, &English)),
        (SURFACES, surface_table(c, &English)),
        (SETTINGS, change_table(c, &English)),
        (COST, cost_table(c, &English)),
    ] {
        body += &section(title.english, &table);
    }
    let meshes: Vec<Value> = shown.iter().map(packed).collect();
    let data = json!({ "meshes": meshes, "pictures": pictures });
    html::page(&title, &body, &data, SCRIPT)
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
    let html = html::table("", &table[0], &table[1..]);
    let legend = match title == GIRTHS.english {
        true => format!("<p class=\"soft\">{}</p>", LEGEND.english),
        false => String::new(),
    };
    format!("<section><h2>{title}</h2>{html}{legend}</section>\n")
}

/// The surfaces for the view: the first with its distance to the second, the other ones to the first.
/// What is placed differently is shown aligned to the first, or where it is.
fn surfaces(c: &Comparison, laid: bool) -> Vec<Surface<'_>> {
    let moved = |l: &'_ Option<super::Laid>| l.as_ref().filter(|_| laid).map(|l| l.mesh.clone());
    let moved: Vec<Option<Mesh>> = c.laid.iter().map(moved).collect();
    let moved = std::iter::once(&None).chain(&moved);
    let there: Vec<(&str, &Mesh)> = c
        .sides
        .iter()
        .zip(moved)
        .filter_map(|(s, moved)| Some((s.name.as_str(), moved.as_ref().or(s.mesh.as_ref())?)))
        .collect();
    let mut all = Vec::new();
    for (i, (side, mesh)) in there.iter().enumerate() {
        let other = there.get(if i == 0 { 1 } else { 0 });
        let mut mesh = thinned(mesh, MOST_FACES);
        mesh.colors = vec![];
        let distances = match other {
            Some((_, other)) => distances(&mesh, other),
            None => vec![0.0; mesh.positions.len()],
        };
        all.push(Surface {
            side,
            mesh,
            distances,
        });
    }
    all
}

/// A surface for the script, in tenths and hundredths of a millimetre.
fn packed(surface: &Surface<'_>) -> Value {
    let whole = |x: f64, step: f64| (x / step).round() as i64;
    let positions = surface.mesh.positions.iter().flatten();
    let distances = surface.distances.iter();
    json!({
        "name": surface.side,
        "positions": positions.map(|x| whole(f64::from(*x), 0.1)).collect::<Vec<_>>(),
        "distances": distances.map(|d| whole(*d, 0.01)).collect::<Vec<_>>(),
        "faces": surface.mesh.faces.iter().flatten().collect::<Vec<_>>(),
    })
}
