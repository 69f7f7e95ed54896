//! `cache pin`: results that `gc` keeps.

use super::either::print_either;
use super::fault::Fault;
use super::program::GlobalArgs;
use engine::past::{self, ago};
use engine::store::Store;
use serde_json::json;
use system::text::count;

/// Keeps what a run made or found.
pub(super) fn pin(
    store: &Store,
    (name, run): (&str, &str),
    global: &GlobalArgs,
) -> Result<(), Fault> {
    let run = run_of(store, run)?;
    store.pin(name, &run).map_err(Fault::input)?;
    let line = format!("{name}: the results of run {run} stay");
    print_either(global, json!({ "pin": name, "run": run }), || vec![line]);
    Ok(())
}

/// What is pinned.
pub(super) fn list(store: &Store, global: &GlobalArgs) -> Result<(), Fault> {
    let pins = store.pins().map_err(Fault::input)?;
    let one = |(name, run): &(String, String)| json!({ "pin": name, "run": run });
    print_either(global, pins.iter().map(one).collect(), || {
        let line = |(name, run): &(String, String)| format!("{name:<20} {run}");
        pins.iter().map(line).collect()
    });
    Ok(())
}

/// No longer keeps it.
pub(super) fn unpin(store: &Store, name: &str, global: &GlobalArgs) -> Result<(), Fault> {
    if !store.unpin(name) {
        let pins = store.pins().map_err(Fault::input)?;
        let known: Vec<&str> = pins.iter().map(|(name, _)| name.as_str()).collect();
        return Err(Fault::coded(&stage::unknown("pin", name, &known)));
    }
    print_either(global, json!({ "unpinned": name }), || {
        vec![format!("{name}: no longer pinned")]
    });
    Ok(())
}

/// The id of the run that somebody means.
fn run_of(store: &Store, text: &str) -> Result<String, Fault> {
    let ids = past::ids(store.root());
    let found = match ago(text) {
        Some(ago) => ids.get(ago),
        None => ids.iter().find(|id| *id == text),
    };
    let known = count(ids.len(), "run");
    let why = format!("`{text}` is no run of this cache; `cache runs` lists its {known}");
    found.cloned().ok_or_else(|| Fault::input(why))
}
