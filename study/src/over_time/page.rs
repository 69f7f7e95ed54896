//! A person over time as one page, without a network and without a script.

use super::change::Followed;
use super::curve::curve_svg;
use super::pictures::{FULL_MM, colored, picture};
use super::series::Series;
use super::words::{BY_CAPTURES, LEGEND, girth_table, heads, volume_table};
use shape::mesh_to_ply;
use tables::html;

/// A drawing within a page, which needs no name space.
fn inline(svg: &str) -> String {
    svg.replace(" xmlns=\"http://www.w3.org/2000/svg\"", "")
}

/// The page, and a coloured surface (PLY) for each capture but the first, by its name.
pub fn page(followed: &Followed, series: &Series) -> (String, Vec<(String, Vec<u8>)>) {
    let mut body = format!("<h1>{}</h1>\n", html::escaped(&followed.person));
    for warning in &followed.warnings {
        body += &format!("<p><strong>{}.</strong></p>\n", html::escaped(warning));
    }
    let table = |title: &str, table: &crate::table::Table, legend: &str| {
        let html = html::table("", &table[0], &table[1..]);
        format!(
            "<section><h2>{title}</h2>{html}<p class=\"soft\">{}</p></section>\n",
            html::escaped(legend)
        )
    };
    body += &table("Girths", &girth_table(followed), LEGEND);
    if followed.by_captures {
        body += &format!("<p class=\"soft\">{}</p>\n", html::escaped(BY_CAPTURES));
    }
    body += "<section><h2>Girths over time</h2>\n";
    followed
        .lines
        .iter()
        .for_each(|line| body += &inline(&curve_svg(followed, line)));
    body += "<p class=\"soft\">The grey band is what repetition alone gives about the first capture; filled points exceed it. Bars hold the true change nine times in ten.</p></section>\n<section><h2>What grew and what shrank</h2>\n";
    let first = &series.visits[0];
    let mut surfaces = Vec::new();
    for ((growth, head), visit) in followed
        .growth
        .iter()
        .zip(heads(followed).iter().skip(1))
        .zip(&series.visits[1..])
    {
        let head = html::escaped(head);
        body += &format!(
            "<figure><img alt=\"the first body from the front and from behind, orange where {head} is outside of it, blue inside\" src=\"{}\"><figcaption>{head}</figcaption></figure>\n",
            picture(first, growth)
        );
        let name = format!("growth-{}.ply", visit.capture.name);
        surfaces.push((name, mesh_to_ply(&colored(&first.mesh, growth))));
    }
    body += &format!(
        "<p class=\"soft\">On the first body: orange grew, blue shrank, fully coloured from {FULL_MM:.0} mm on; limbs are laid on each other first.</p></section>\n"
    );
    body += &table(
        "Volume by part",
        &volume_table(followed),
        "Parts meet where the first body's do, carried to the other captures. What a part lost, its neighbour may have got: heads and limbs are parted from the trunk on the surface alone.",
    );
    (
        html::page(&followed.person, &body, &serde_json::Value::Null, ""),
        surfaces,
    )
}
