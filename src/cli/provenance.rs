//! How a result was made, as HTML for the report.

use crate::engine::Outcome;
use crate::graph::Graph;
use engine::cli::text::short;
use shape::Girths;

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

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
}

/// What the stages warned of, without what the table says anyway.
pub(super) fn warnings(outcome: &Outcome, graph: &Graph, girths: Option<&Girths>) -> Vec<String> {
    let said: Vec<String> = girths
        .iter()
        .flat_map(|g| &g.missing)
        .map(|m| format!("{}: {}", m.name, m.why))
        .collect();
    let mut warnings = Vec::new();
    for (done, node) in outcome.nodes.iter().zip(&graph.nodes) {
        for warning in done.iter().flat_map(|done| &done.warnings) {
            if !said.contains(warning) {
                warnings.push(format!("{}: {warning}", node.name));
            }
        }
    }
    warnings
}

/// The report with what only the run knows: its warnings on top, how it was made at the end.
pub(crate) fn completed(page: &[u8], outcome: &Outcome, graph: &Graph) -> Vec<u8> {
    let girths = get::<Girths>(graph, outcome, "girths");
    let warnings = warnings(outcome, graph, girths.as_deref());
    let paragraph = |w: &String| format!("<p class=\"warn\">{}</p>", escaped(w));
    let warnings: String = warnings.iter().map(paragraph).collect();
    let page = String::from_utf8_lossy(page).replacen("<!--warnings-->", &warnings, 1);
    let made = table(outcome, graph);
    page.replacen("<!--provenance-->", &made, 1).into_bytes()
}

/// Every node with its stage, params and numbers; not how long it took, so that equal results give
/// equal pages (`run.json` has it).
fn table(outcome: &Outcome, graph: &Graph) -> String {
    let mut rows = String::new();
    for (done, node) in outcome.nodes.iter().zip(&graph.nodes) {
        let Some(done) = done else { continue };
        let params = node.params.values.iter();
        // Who is measured is nobody's matter whom the page is shown.
        let params = params.filter(|_| node.stage.name() != PERSONAL);
        let params: Vec<String> = params.map(|(k, v)| format!("{k} = {v}")).collect();
        let number = |m: &stage::Metric| {
            format!("{} {} {}", m.name, short(m.value), m.unit)
                .trim()
                .to_owned()
        };
        let numbers: Vec<String> = done.metrics.iter().map(number).collect();
        let key = done.key.map(|k| k.to_hex()[..12].to_owned());
        rows += &format!(
            "<tr><td><b>{}</b></td><td>{} v{}</td><td class=\"note\">{}</td>\
             <td class=\"note\">{}</td><td class=\"note\">{}</td></tr>",
            escaped(&node.name),
            node.stage.name(),
            node.stage.version(),
            escaped(&params.join(", ")),
            escaped(&numbers.join(", ")),
            key.unwrap_or_default(),
        );
    }
    format!(
        "<details><summary>tailor {}: {}</summary><table id=\"provenance\"><tr><th>node</th><th>stage</th>\
         <th>params</th><th>numbers</th><th>key</th></tr>{rows}</table></details>",
        env!("CARGO_PKG_VERSION"),
        escaped(&graph.about),
    )
}
