//! The reference of a stage, generated from what the stage itself says.

use serde_json::{Value, json};
use stage::AnyStage;
use std::fmt::Write;

/// For people.
pub fn text(stage: &dyn AnyStage) -> String {
    let mut text = format!(
        "{} v{} → {}\n  {}\n",
        stage.name(),
        stage.version(),
        stage.yields(),
        stage.about()
    );
    for port in stage.ports() {
        let optional = if port.optional {
            " (may stay open)"
        } else {
            ""
        };
        let _ = writeln!(
            text,
            "  from {}: {}{optional}. {}",
            port.name, port.kind, port.doc
        );
    }
    for param in stage.params() {
        let range = param
            .range
            .map_or(String::new(), |(lo, hi)| format!(", {lo}..={hi}"));
        let kind = match param.choices {
            [] => param.type_name.to_owned(),
            words => words.join(" | "),
        };
        let _ = writeln!(
            text,
            "  with {} = {}  ({kind}{range}). {}",
            param.name, param.default, param.doc
        );
    }
    text + "\n"
}

/// For other programs.
pub fn json(stage: &dyn AnyStage) -> Value {
    let port = |p: &stage::PortSpec| json!({ "name": p.name, "kind": p.kind, "optional": p.optional, "doc": p.doc });
    let param = |p: &stage::ParamSpec| {
        json!({
            "name": p.name, "doc": p.doc, "type": p.type_name, "choices": p.choices,
            "default": p.default.to_string(), "range": p.range,
        })
    };
    json!({
        "name": stage.name(), "version": stage.version(), "about": stage.about(),
        "makes": stage.yields(),
        "ports": stage.ports().iter().map(port).collect::<Vec<_>>(),
        "params": stage.params().iter().map(param).collect::<Vec<_>>(),
    })
}
