//! What axe-core finds on a page.

use super::Tab;
use serde_json::{Value, json};

/// What it finds wrong.
const FOUND: &str = "axe.run().then((r) => r.violations.map((v) =>
    v.id + ': ' + v.nodes.map((n) => n.html.slice(0, 90)).join(' | ')))";

impl Tab {
    /// What axe-core finds, where `TAILOR_AXE` names its file; nothing without one.
    pub(crate) fn axe(&mut self) -> Value {
        let Some(file) = std::env::var_os("TAILOR_AXE") else {
            return json!([]);
        };
        self.value(&format!("{}; 1", std::fs::read_to_string(file).unwrap()));
        self.value(FOUND)
    }
}
