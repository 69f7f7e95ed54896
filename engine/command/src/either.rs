//! An answer in lines or in JSON.

use super::program::GlobalArgs;
use serde_json::Value;

/// Prints the one or the other.
pub(super) fn print_either(global: &GlobalArgs, json: Value, lines: impl FnOnce() -> Vec<String>) {
    match global.json {
        true => crate::outln!("{json}"),
        false => lines().iter().for_each(|line| crate::outln!("{line}")),
    }
}
