//! The reference of a stage, generated from the stage's own declaration.

use serde_json::{Value, json};
use stage::{AnyStage, ParamSpec};
use std::fmt::Write;
use tables::aligned::{lines, table};

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
        let _ = writeln!(text, "  with {}", line(&param));
        for field in param.entry.iter().flatten() {
            let _ = writeln!(text, "    in [{}.NAME] {}", param.name, line(field));
        }
    }
    if !stage.metrics().is_empty() {
        let _ = writeln!(text, "  reports {}", stage.metrics().join(", "));
    }
    text + "\n"
}

/// One param: name and default (or that it is required), what fits, what it does.
fn line(param: &ParamSpec) -> String {
    let range = param
        .range
        .map_or(String::new(), |(lo, hi)| format!(", {lo}..={hi}"));
    let kind = match param.choices {
        [] => param.type_name.to_owned(),
        words => words.join(" | "),
    };
    let default = match param.required {
        true => "must be given".to_owned(),
        false => format!("= {}", param.default),
    };
    let (name, doc) = (param.name, &param.doc);
    format!("{name} {default}  ({kind}{range}). {doc}")
}

/// Where the default of each numeric param comes from, and how many were set by hand.
pub fn provenance(stages: &[&dyn AnyStage]) -> String {
    let mut table = table();
    let (mut all, mut by_hand) = (0, 0);
    for stage in stages {
        for param in stage.params().iter().filter(|p| p.is_number()) {
            all += 1;
            by_hand += usize::from(param.source.is_by_hand());
            let default = param.default.to_string();
            let name = format!("{} {}", stage.name(), param.name);
            table.add_row([&name, &default, param.source.word(), param.source.what()]);
        }
    }
    let lines = lines(&mut table);
    format!("{lines}\n{by_hand} of {all} defaults are set by hand\n")
}

/// For other programs.
pub fn json(stage: &dyn AnyStage) -> Value {
    let port = |p: &stage::PortSpec| json!({ "name": p.name, "kind": p.kind, "optional": p.optional, "doc": p.doc });
    json!({
        "name": stage.name(), "version": stage.version(), "about": stage.about(),
        "makes": stage.yields(),
        "ports": stage.ports().iter().map(port).collect::<Vec<_>>(),
        "metrics": stage.metrics(),
        "params": stage.params().iter().map(param).collect::<Vec<_>>(),
    })
}

fn param(p: &ParamSpec) -> Value {
    let mut entry = json!({
        "name": p.name, "doc": p.doc, "type": p.type_name, "choices": p.choices,
        "default": p.default.to_string(), "range": p.range, "required": p.required,
    });
    if p.is_number() {
        entry["source"] = json!({ "kind": p.source.word(), "what": p.source.what() });
    }
    if let Some(fields) = &p.entry {
        entry["entry"] = fields.iter().map(param).collect();
    }
    entry
}
