//! What the cache may hold, and what goes at the end of a run.

use super::program::GlobalArgs;
use super::size::mib;
use super::text::count;
use engine::past;
use engine::store::retention::{self, Budget, KEPT_RECORDS};
use engine::store::{Store, StoreError};

/// At the end of a run: old records go, and what is over the given budget. Never while
/// another run uses the store, which does the same at its own end.
pub(super) fn after_run(global: &GlobalArgs) {
    let many = past::ids(&global.cache).len() > 2 * KEPT_RECORDS;
    if !many && global.max_size.is_none() {
        return;
    }
    let Ok(store) = Store::open(&global.cache) else {
        return;
    };
    let over = global.max_size;
    let over = over.filter(|most| retention::size(&store).is_ok_and(|size| size > *most));
    if !many && over.is_none() {
        return;
    }
    let budget = Budget {
        most: over.unwrap_or(u64::MAX),
        keep_runs: 1,
        keep_records: KEPT_RECORDS,
    };
    let swept = retention::gc(&store, &budget, false);
    if global.json || global.quiet {
        return;
    }
    match swept {
        Ok(swept) if !swept.results.is_empty() => {
            let freed: u64 = swept.results.iter().map(|k| k.bytes).sum();
            let (went, freed) = (count(swept.results.len(), "result"), mib(freed));
            crate::errln!("the cache was over its size: {went} removed, {freed:.1} MiB");
        }
        Ok(_) | Err(StoreError::Busy(_)) => {}
        Err(error) => crate::errln!("{error}"),
    }
}
