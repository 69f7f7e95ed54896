//! What the cache may hold, and what goes at the end of a run.

use super::arguments::GlobalArgs;
use super::cache::mib;
use crate::past;
use crate::store::keeper::{self, Budget};
use crate::store::{Store, StoreError};

/// `500M` as bytes.
pub(super) fn bytes(text: &str) -> Result<u64, String> {
    let digits = text.trim_end_matches(|c: char| c.is_ascii_alphabetic());
    let unit = text[digits.len()..].to_ascii_uppercase();
    let factor = match unit.trim_end_matches('B') {
        "" => Some(1u64),
        "K" => Some(1 << 10),
        "M" => Some(1 << 20),
        "G" => Some(1 << 30),
        _ => None,
    };
    let number = digits.parse::<f64>().ok().filter(|x| *x >= 0.0);
    let size = number.zip(factor).map(|(x, f)| (x * f as f64) as u64);
    size.ok_or_else(|| "say 500M or 20G".to_owned())
}

/// Runs whose records are kept if nothing else is said; there may be twice as many for a while.
pub(super) const KEPT_RECORDS: usize = 200;

/// At the end of a run: old records go, and what is over the budget that was said. Never while
/// another run uses the store, which does the same at its own end.
pub(super) fn after_run(global: &GlobalArgs) {
    let many = past::ids(&global.cache).len() > 2 * KEPT_RECORDS;
    if !many && global.max_size.is_none() {
        return;
    }
    let Ok(store) = Store::open(&global.cache) else {
        return;
    };
    let over = global.max_size.filter(|most| keeper::size(&store) > *most);
    if !many && over.is_none() {
        return;
    }
    let budget = Budget {
        most: over.unwrap_or(u64::MAX),
        keep_runs: 1,
        keep_records: KEPT_RECORDS,
    };
    let swept = keeper::gc(&store, &budget, false);
    if global.json || global.quiet {
        return;
    }
    match swept {
        Ok(swept) if !swept.results.is_empty() => {
            let freed: u64 = swept.results.iter().map(|k| k.bytes).sum();
            let (n, freed) = (swept.results.len(), mib(freed));
            crate::errln!("the cache was over its size: {n} results went, {freed:.1} MiB");
        }
        Ok(_) | Err(StoreError::Busy(_)) => {}
        Err(error) => crate::errln!("{error}"),
    }
}
