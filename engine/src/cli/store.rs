//! `tailor cache store|push|sweep-store`: the store that machines share.

use super::fault::Fault;
use super::program::GlobalArgs;
use super::size::mib;
use crate::store::remote::{Honest, Sharing, Trouble};
use serde_json::json;
use std::time::Duration;

/// Nothing younger goes: a job may have looked at it and not used it yet. \[days\]
const LEAST_DAYS: f64 = 1.0;

/// Clocks that are farther apart are told. \[s\]
const APART_S: f64 = 60.0;

fn sharing<'a>(sharing: Option<&'a Sharing>, verb: &str) -> Result<&'a Sharing, Fault> {
    let say = || Fault::input(format!("`cache {verb}`: say which store, with --store"));
    sharing.ok_or_else(say)
}

fn fault(sharing: &Sharing, why: &Trouble) -> Fault {
    Fault::input(format!("the store {}: {why}", sharing.name()))
}

/// What it holds, how it answers, whether it keeps its word.
pub(super) fn look(shared: Option<&Sharing>, global: &GlobalArgs) -> Result<(), Fault> {
    let shared = sharing(shared, "store")?;
    let looked = shared.look().map_err(|why| fault(shared, &why))?;
    let creates = looked.honest.map(|honest| honest == Honest::Creates);
    if global.json {
        crate::outln!(
            "{}",
            json!({ "store": shared.name(), "records": looked.records, "blobs": looked.blobs,
                "bytes": looked.bytes, "answer_s": looked.answer_s, "clock_ahead_s": looked.ahead_s,
                "creates_once": creates })
        );
        return Ok(());
    }
    let (records, size) = (looked.records, mib(looked.bytes));
    crate::outln!("{}: {records} results, {size:.1} MiB", shared.name());
    crate::outln!("it answers within {:.0} ms", 1000.0 * looked.answer_s);
    match creates {
        Some(true) => crate::outln!("of two that create one object, one wins"),
        Some(false) => crate::outln!(
            "of two that create one object both are told that they won: what is not deterministic is not noticed"
        ),
        None => {}
    }
    if looked.ahead_s.abs() > APART_S {
        let (by, how) = (
            looked.ahead_s.abs(),
            if looked.ahead_s > 0.0 {
                "ahead"
            } else {
                "behind"
            },
        );
        crate::outln!(
            "its clock is {by:.0} s {how} of this machine's; results do not depend on clocks, requests may be refused"
        );
    }
    Ok(())
}

/// Removes what is old.
pub(super) fn sweep(
    shared: Option<&Sharing>,
    days: f64,
    dry_run: bool,
    global: &GlobalArgs,
) -> Result<(), Fault> {
    let shared = sharing(shared, "sweep-store")?;
    if !(LEAST_DAYS..1e5).contains(&days) {
        return Err(Fault::input(format!(
            "--older-days {days}: say at least {LEAST_DAYS}: a job may have looked at what is younger and not used it yet"
        )));
    }
    if global.store_read_only {
        return Err(Fault::input(
            "`cache sweep-store` removes: leave --store-read-only out",
        ));
    }
    let older = Duration::from_secs_f64(86_400.0 * days);
    let swept = shared
        .sweep(older, dry_run)
        .map_err(|why| fault(shared, &why))?;
    if global.json {
        crate::outln!(
            "{}",
            json!({ "store": shared.name(), "records": swept.records, "blobs": swept.blobs,
                "plans": swept.plans, "bytes": swept.bytes, "dry_run": dry_run })
        );
        return Ok(());
    }
    let verb = if dry_run { "would remove" } else { "removed" };
    crate::outln!(
        "{verb} {} results, {} plans, {:.1} MiB",
        swept.records,
        swept.plans,
        mib(swept.bytes)
    );
    Ok(())
}
