//! A study of repeatability as one page, with its plots.

use super::plot::bland_altman_svg;
use super::study::Study;
use super::words::{LEGEND, girth_table, known_table, people};
use tables::html;

/// A drawing within a page needs no name space.
const XMLNS: &str = " xmlns=\"http://www.w3.org/2000/svg\"";

/// The page: it works without a network and without a script.
pub fn page(study: &Study) -> String {
    let mut body = String::from("<h1>Repeatability</h1>\n<ul>");
    for person in people(study) {
        body += &format!("<li>{}</li>", html::escaped(&person));
    }
    body += "</ul>\n";
    for warning in &study.warnings {
        body += &format!("<p>{}.</p>\n", html::escaped(warning));
    }
    let table = girth_table(study);
    body += &format!(
        "<section><h2>Girths</h2>{}<p class=\"soft\">{}</p></section>\n<section><h2>Bland–Altman plots</h2>\n",
        html::table("", &table[0], &table[1..]),
        html::escaped(LEGEND)
    );
    study
        .girths
        .iter()
        .for_each(|g| body += &bland_altman_svg(g).replace(XMLNS, ""));
    let table = known_table();
    body += &format!(
        "</section>\n<section><h2>What other studies report</h2>{}</section>\n",
        html::table("", &table[0], &table[1..])
    );
    html::page("Repeatability", &body, &serde_json::Value::Null, "")
}
