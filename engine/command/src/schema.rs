//! The JSON schema of a pipeline file, for editors: stages with their ports and params, their
//! units, ranges and defaults.
//!
//! JSON Schema 2020-12. Editors that know TOML (Even Better TOML, Tombi) take it by a first line
//! `#:schema pipeline.schema.json`.

use programs::EXEC;
use serde_json::{Map, Value, json};
use stage::{AnyStage, ParamSpec};

/// The schema for a catalog of stages.
pub fn schema<'a>(stages: impl Iterator<Item = &'a dyn AnyStage>) -> Value {
    let stages: Vec<&dyn AnyStage> = stages.collect();
    let names = stages.iter().map(|s| s.name());
    let names: Vec<&str> = names.chain([EXEC]).collect();
    let by_stage: Vec<Value> = stages.iter().map(|s| rule(*s)).collect();
    let texts = json!({ "type": "array", "items": { "type": "string" } });
    let text_or_texts = json!({ "anyOf": [{ "type": "string" }, texts] });
    let from = json!({
        "description": "What the ports read: `{ port = \"node\" }`, or a list where each port is called like what it reads; `@name` is an input",
        "anyOf": [
            { "type": "object", "additionalProperties": { "type": "string" } },
            texts,
            { "type": "string" },
        ],
    });
    let with = json!({ "type": "object", "additionalProperties": { "$ref": "#/$defs/value" } });
    let about = json!({ "type": "string", "description": "What it is for" });
    let stage = json!({ "type": "string", "enum": names, "description": "What the node does" });
    let of_nodes = |value: Value| json!({ "type": "object", "additionalProperties": value });
    let named = |value: Value| json!({ "type": "object", "additionalProperties": value });
    let mut schema = json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "A pipeline",
        "type": "object",
        "if": { "not": { "required": ["extends"] } },
        "then": {
            "required": ["goal", "node"],
            "properties": { "node": named(json!({ "required": ["stage"] })) },
        },
        "additionalProperties": false,
        "properties": {
            "about": about,
            "extends": { "type": "string", "description": "The pipeline that this one changes: a file beside it, or a built-in one" },
            "without": text_or_texts,
            "params": with,
            "goal": text_or_texts,
            "input": named(json!({
                "type": "object", "required": ["files"], "additionalProperties": false,
                "properties": { "about": about, "files": text_or_texts },
            })),
            "node": named(json!({
                "type": "object", "additionalProperties": false,
                "properties": node_keys(&stage, &from),
                "allOf": by_stage,
            })),
            "variant": named(json!({
                "type": "object", "additionalProperties": false,
                "properties": {
                    "about": about, "without": text_or_texts, "with": of_nodes(with),
                    "stage": of_nodes(stage), "from": of_nodes(from),
                },
            })),
            "search": named(search_keys(&about, &text_or_texts)),
            "sweep": named(json!({
                "type": "object", "additionalProperties": false,
                "properties": {
                    "about": about, "with": text_or_texts, "tell": text_or_texts,
                    "goal": text_or_texts,
                    "csv": { "type": "string" }, "zip": { "type": "array" },
                    "sample": { "type": "object" },
                    "replicate": { "type": "integer", "minimum": 2, "maximum": 10000, "description": "How often each point is repeated, each time with other seeds" },
                    "over": of_nodes(json!({ "type": "object" })),
                },
            })),
        },
        "$defs": { "value": { "type": ["boolean", "number", "string", "array", "object"] } },
    });
    for spec in stages.iter().flat_map(|s| s.params()) {
        if spec.entry.is_some() {
            schema["properties"][spec.name] = param(&spec);
        }
    }
    schema
}

/// The keys of a search.
fn search_keys(about: &Value, text_or_texts: &Value) -> Value {
    let of_nodes = |value: Value| json!({ "type": "object", "additionalProperties": value });
    json!({
        "type": "object", "additionalProperties": false, "required": ["over", "budget"],
        "properties": {
            "about": about, "with": text_or_texts, "tell": text_or_texts, "goal": text_or_texts,
            "over": of_nodes(json!({ "type": "object" })), "replicate": { "type": "integer" },
            "method": { "enum": engine::recipe::Method::ALL.map(|(word, _)| word) },
            "budget": { "type": "integer", "minimum": 1, "description": "How many whole points may be made" },
            "seed": { "type": "integer" },
            "least": { "type": "string", "description": "The metric that is to be small" },
            "most": { "type": "string", "description": "The metric that is to be large" },
            "dear": of_nodes(json!({ "type": "object", "description": "halving: the param that makes points dear, from its least to its full value" })),
        },
    })
}

/// The keys of a node; those of a program go with its stage.
fn node_keys(stage: &Value, from: &Value) -> Value {
    let list = |what: &str| {
        let items = json!({ "type": "string" });
        json!({ "description": what, "type": "array", "items": items })
    };
    let number =
        |what: &str| json!({ "description": what, "type": "number", "exclusiveMinimum": 0 });
    json!({
        "stage": stage, "from": from, "with": { "type": "object" },
        "command": list("exec: the program and its words; {here}, {from.PORT}, {from.PORT:FORMAT}, {out}, {with.NAME} are filled in when it runs"),
        "out": { "description": "exec: the kind that it makes", "type": "string" },
        "files": list("exec: files beside the pipeline, laid out in {here}; their content is in the key"),
        "identity": list("exec: a command that prints what the program is; what it prints is in the key"),
        "env": list("exec: variables of the environment that it gets"),
        "reads": list("exec: files and folders that it reads beside what it is given, by whole paths; their content is in the key"),
        "timeout_s": number("exec: how long it may take; an hour if not given [s]"),
        "memory_mb": number("exec: what it may hold with its children [MB]"),
        "keep": { "description": "exec: whether it stays, and gets further jobs on its standard input", "type": "boolean", "default": false },
        "network": { "description": "exec: whether it may reach the network", "type": "boolean", "default": false },
    })
}

/// If a node has this stage, its ports and params are these.
fn rule(stage: &dyn AnyStage) -> Value {
    let properties = |entries: Vec<(&str, Value)>| -> Value {
        let map: Map<String, Value> = entries
            .into_iter()
            .map(|(k, v)| (k.to_owned(), v))
            .collect();
        map.into()
    };
    let ports = stage.ports();
    let port = |p: &stage::PortSpec| {
        let description = format!("{} ({})", p.doc, p.kind);
        (
            p.name,
            json!({ "type": "string", "description": description }),
        )
    };
    let needed: Vec<&str> = ports
        .iter()
        .filter(|p| !p.optional)
        .map(|p| p.name)
        .collect();
    let specs = stage.params();
    let params = specs.iter().map(|p| (p.name, param(p))).collect();
    json!({
        "if": { "required": ["stage"], "properties": { "stage": { "const": stage.name() } } },
        "then": {
            "description": stage.about(),
            "properties": {
                "from": {
                    "if": { "type": "object" },
                    "then": {
                        "properties": properties(ports.iter().map(port).collect()),
                        "required": needed, "additionalProperties": false,
                    },
                },
                "with": { "properties": properties(params), "additionalProperties": false },
            },
        },
    })
}

/// A text that names a shared param.
const SHARED: &str = "^\\$[A-Za-z0-9_-]+$";

fn param(spec: &ParamSpec) -> Value {
    let mut rule = json!({ "description": spec.doc, "default": plain(&spec.default) });
    if let Some(fields) = &spec.entry {
        let properties: Map<String, Value> = fields
            .iter()
            .map(|f| (f.name.to_owned(), param(f)))
            .collect();
        let required = fields.iter().filter(|f| f.required).map(|f| f.name);
        rule["type"] = json!("object");
        rule["additionalProperties"] = json!({
            "type": "object", "properties": properties,
            "required": required.collect::<Vec<_>>(), "additionalProperties": false,
        });
    } else if !spec.choices.is_empty() {
        let shared = json!({ "type": "string", "pattern": SHARED });
        rule["anyOf"] = json!([{ "enum": spec.choices }, shared]);
    } else {
        let own = match &spec.default {
            stage::Value::Bool(_) => "boolean",
            stage::Value::Int(_) => "integer",
            stage::Value::Float(_) => "number",
            stage::Value::Text(_) => "string",
            stage::Value::List(_) => "array",
            stage::Value::Table(_) => "object",
        };
        rule["type"] = json!([own, "string"]);
        if own != "string" {
            rule["pattern"] = json!(SHARED);
        }
    }
    if let Some((least, greatest)) = spec.range {
        rule["minimum"] = json!(least);
        rule["maximum"] = json!(greatest);
    }
    rule
}

fn plain(value: &stage::Value) -> Value {
    match value {
        stage::Value::Bool(b) => json!(b),
        stage::Value::Int(i) => json!(i),
        stage::Value::Float(x) => json!(x),
        stage::Value::Text(t) => json!(t),
        stage::Value::List(l) => l.iter().map(plain).collect(),
        stage::Value::Table(t) => t.iter().map(|(k, v)| (k.clone(), plain(v))).collect(),
    }
}
