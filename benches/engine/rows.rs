//! What was measured: a row a tool and graph, on the screen and as JSON.

use serde_json::{Value, json};
use std::path::Path;
use std::process::Command;

/// One tool on one graph. Times are the least of all rounds.
pub(crate) struct Row {
    pub(crate) tool: String,
    nodes: usize,
    first_s: Option<f64>,
    nothing_s: f64,
    one_s: f64,
    plan_s: f64,
    memory_kib: usize,
}

impl Row {
    pub(crate) fn new(tool: &str, nodes: usize, first_s: Option<f64>) -> Row {
        Row {
            tool: tool.into(),
            nodes,
            first_s,
            nothing_s: f64::INFINITY,
            one_s: f64::INFINITY,
            plan_s: f64::INFINITY,
            memory_kib: 0,
        }
    }

    /// A run that had nothing to do. \[s\]
    pub(crate) fn nothing(&mut self, seconds: f64) {
        self.nothing_s = self.nothing_s.min(seconds);
    }

    /// A run after one source changed. \[s\]
    pub(crate) fn one(&mut self, seconds: f64) {
        self.one_s = self.one_s.min(seconds);
    }

    /// A plan. \[s\]
    pub(crate) fn plan(&mut self, seconds: f64) {
        self.plan_s = self.plan_s.min(seconds);
    }

    /// The greatest memory of a run that had nothing to do.
    pub(crate) fn memory(&mut self, kib: usize) {
        self.memory_kib = self.memory_kib.max(kib);
    }

    pub(crate) fn print(&self) {
        println!("{}", self.json());
    }

    fn json(&self) -> Value {
        let ms = |seconds: f64| round(seconds * 1e3, 10.0);
        let mut row = json!({ "tool": self.tool, "nodes": self.nodes });
        if let Some(first) = self.first_s {
            row["first_s"] = round(first, 100.0).into();
        }
        row["nothing_ms"] = ms(self.nothing_s).into();
        row["one_changed_ms"] = ms(self.one_s).into();
        if self.memory_kib > 0 {
            row["plan_ms"] = ms(self.plan_s).into();
            row["memory_mb"] = round(self.memory_kib as f64 / 1024.0, 1.0).into();
        }
        row
    }
}

fn round(x: f64, parts: f64) -> f64 {
    (x * parts).round() / parts
}

/// All rows, with what took them.
pub(crate) struct Table {
    pub(crate) rows: Vec<Row>,
}

impl Table {
    pub(crate) fn new() -> Table {
        Table { rows: Vec::new() }
    }

    /// As a file.
    pub(crate) fn write(&self, path: &Path) {
        let cores = std::thread::available_parallelism().map_or(1, usize::from);
        let commit = first_line("git", &["describe", "--always", "--dirty=+"]);
        let disk = first_line(
            "stat",
            &["-f", "-c", "%T", &std::env::temp_dir().to_string_lossy()],
        );
        let table = json!({
            "program": format!("tailor {} at {commit}", env!("CARGO_PKG_VERSION")),
            "date": first_line("date", &["-u", "+%F"]),
            "machine": format!("{cores} cores, {disk}"),
            "beside": [first_line("ninja", &["--version"]), first_line("make", &["--version"])],
            "rows": self.rows.iter().map(Row::json).collect::<Vec<_>>(),
        });
        let text = serde_json::to_string_pretty(&table).unwrap();
        std::fs::write(path, text + "\n").unwrap();
    }
}

/// The first line of a program's output, or nothing.
fn first_line(program: &str, args: &[&str]) -> String {
    let out = Command::new(program).args(args).output();
    let text = out.map(|o| String::from_utf8_lossy(&o.stdout).into_owned());
    let text = text.unwrap_or_default();
    text.lines().next().unwrap_or_default().to_owned()
}
