//! How a result was made, as HTML for the report.

use crate::catalog::titled;
use crate::engine::Outcome;
use crate::graph::Graph;
use crate::words::alike::joined;
use command::Ran;
use command::text::short;
use serde_json::Value;
use shape::Girths;
use stage::Message;
use std::path::Path;

/// The stage whose params are facts of a person.
const PERSONAL: &str = "capture.person";

/// A node's result, if it is of this kind.
pub(super) fn get<A: stage::Artifact>(
    graph: &Graph,
    outcome: &Outcome,
    name: &str,
) -> Option<std::sync::Arc<A>> {
    outcome.artifact(graph, graph.node(name)?)?.downcast()
}

/// What a capture is called, after its folder; a video without its ending.
pub(super) fn called(capture: &Path) -> String {
    let name = match capture.is_file() {
        true => capture.file_stem(),
        false => capture.file_name(),
    };
    let name = name.unwrap_or("turn".as_ref());
    name.to_string_lossy().into_owned()
}

/// The folder with the photos of a run.
pub(super) fn folder<'a>(ran: &'a Ran<'_>) -> Option<&'a Path> {
    let mut folders = ran.folders.iter();
    let photos = folders.find(|(name, _)| name == "photos");
    photos.map(|(_, folder)| folder.as_path())
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
}

/// What the stages warned of, without what the table has anyway.
pub(super) fn warnings(ran: &Ran<'_>, girths: Option<&Girths>) -> Vec<Message> {
    let all = by_node(ran, girths).into_iter();
    all.map(|(node, warning)| warning.from_where(&node))
        .collect()
}

/// The same without the nodes, which mean nothing to people who know none of them.
pub(super) fn sentences(ran: &Ran<'_>, girths: &Girths) -> Vec<Message> {
    let all = by_node(ran, Some(girths)).into_iter();
    all.map(|(_, warning)| warning).collect()
}

fn by_node(ran: &Ran<'_>, girths: Option<&Girths>) -> Vec<(String, Message)> {
    let missing = girths.iter().flat_map(|g| &g.missing);
    let whys: Vec<String> = missing.map(|m| m.why.to_string()).collect();
    let warnings = ran.warnings().into_iter();
    let why = |w: &Message| w.fields().get("why").map(ToString::to_string);
    let in_table = |w: &Message| why(w).is_some_and(|why| whys.contains(&why));
    let new = warnings.filter(|(_, warning)| !in_table(warning));
    joined(new.collect())
}

/// The report with what only the run knows: what its capture is called, its warnings on top, how it was made at the end.
pub(crate) fn completed(page: &[u8], ran: &Ran<'_>) -> Vec<u8> {
    completed_as(page, ran, folder(ran).map(called).as_deref())
}

/// The same of a capture called so.
pub(super) fn completed_as(page: &[u8], ran: &Ran<'_>, name: Option<&str>) -> Vec<u8> {
    let girths = ran.last::<Girths>();
    let warnings = by_node(ran, girths.as_deref()).into_iter();
    let paragraph = |(_, w): (_, Message)| format!("<p class=\"warn\">{}</p>", escaped(&w));
    let warnings: String = warnings.map(paragraph).collect();
    let page = String::from_utf8_lossy(page).replacen("<!--warnings-->", &warnings, 1);
    let page = match name {
        Some(name) => titled(&page, name),
        None => page,
    };
    let made = table(&ran.record());
    page.replacen("<!--provenance-->", &made, 1).into_bytes()
}

/// Every node with its stage, params and numbers; not how long it took, so that equal results give
/// equal pages (`run.json` has it).
fn table(record: &Value) -> String {
    let mut rows = String::new();
    let text = |value: &Value| value.as_str().unwrap_or_default().to_owned();
    let list = |value: &Value| value.as_array().cloned().unwrap_or_default();
    for node in list(&record["nodes"]) {
        let stage = text(&node["stage"]);
        let lines = list(&node["provenance"]).into_iter();
        // Who is measured is nobody's matter whom the page is shown.
        let lines = lines.filter(|_| stage != PERSONAL);
        let param = |line: Value| {
            let name = text(&line[0]).strip_prefix("with ")?.to_owned();
            Some(format!("{name} = {}", text(&line[1])))
        };
        let params: Vec<String> = lines.filter_map(param).collect();
        let number = |m: Value| {
            let value = m["value"].as_f64().unwrap_or(f64::NAN);
            format!("{} {} {}", text(&m["name"]), short(value), text(&m["unit"]))
                .trim()
                .to_owned()
        };
        let numbers: Vec<String> = list(&node["metrics"]).into_iter().map(number).collect();
        let key: String = text(&node["key"]).chars().take(12).collect();
        rows += &format!(
            "<tr><td><b>{}</b></td><td>{stage} v{}</td><td class=\"note\">{}</td>\
             <td class=\"note\">{}</td><td class=\"note\">{key}</td></tr>",
            escaped(&text(&node["node"])),
            node["version"],
            escaped(&params.join(", ")),
            escaped(&numbers.join(", ")),
        );
    }
    format!(
        "<details><summary>tailor {}: {}</summary><table id=\"provenance\"><tr><th>node</th><th>stage</th>\
         <th>params</th><th>numbers</th><th>key</th></tr>{rows}</table></details>",
        env!("CARGO_PKG_VERSION"),
        escaped(&text(&record["about"])),
    )
}
