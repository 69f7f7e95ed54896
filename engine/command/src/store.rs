//! `cache store|push|sweep-store|keygen`: the store that machines share.

use super::fault::Fault;
use super::program::GlobalArgs;
use super::size::mib;
use super::text::count;
use buckets::Trouble;
use engine::store::remote::{Honest, Sharing};
use serde_json::json;
use std::path::Path;
use std::time::Duration;

/// Nothing younger goes: a job may have looked at it and not used it yet. \[days\]
const LEAST_DAYS: f64 = 1.0;

/// Clocks that are farther apart are reported. \[s\]
const APART_S: f64 = 60.0;

fn sharing<'a>(sharing: Option<&'a Sharing>, verb: &str) -> Result<&'a Sharing, Fault> {
    let missing = || Fault::input(format!("`cache {verb}`: name the store with --store"));
    sharing.ok_or_else(missing)
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
    let records = count(records, "result");
    crate::outln!("{}: {records}, {size:.1} MiB", shared.name());
    crate::outln!("it answers within {:.0} ms", 1000.0 * looked.answer_s);
    match creates {
        Some(true) => crate::outln!("conditional create works (two writers, one wins)"),
        Some(false) => crate::outln!(
            "conditional create does not work (of two writers both win): what is not deterministic is not noticed"
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

/// Makes a key that signs what goes there.
#[cfg(feature = "remote")]
pub(super) fn keygen(file: &Path, days: u32, global: &GlobalArgs) -> Result<(), Fault> {
    let line = buckets::keygen(file, days).map_err(Fault::input)?;
    match global.json {
        true => crate::outln!(
            "{}",
            json!({ "key": file.display().to_string(), "public": line })
        ),
        false => crate::outln!(
            "{line}\n{} signs (--sign-key): keep it to yourself. Put the line above, which {0}.pub holds, too, \
             into the lists of --trust of those who are to believe it.",
            file.display()
        ),
    }
    Ok(())
}

/// There is none in this program.
#[cfg(not(feature = "remote"))]
pub(super) fn keygen(_file: &Path, _days: u32, _global: &GlobalArgs) -> Result<(), Fault> {
    Err(Fault::input(
        "`cache keygen`: this program was built without stores that machines share; build it with `--features remote`",
    ))
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
            "--older-days {days}: give at least {LEAST_DAYS}: a job may have looked at what is younger and not used it yet"
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
                "plans": swept.plans, "cut_off": swept.cut_off, "bytes": swept.bytes, "dry_run": dry_run })
        );
        return Ok(());
    }
    let verb = if dry_run { "would remove" } else { "removed" };
    crate::outln!(
        "{verb} {}, {}, {} cut off, {:.1} MiB",
        count(swept.records, "result"),
        count(swept.plans, "plan"),
        count(swept.cut_off, "upload"),
        mib(swept.bytes)
    );
    Ok(())
}
