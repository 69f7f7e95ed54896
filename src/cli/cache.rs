//! `tailor cache ls|du|runs|pin|unpin|pins|gc|verify`.

use super::compare::past;
use super::{Fault, House};
use crate::past;
use crate::store::Store;
use crate::store::keeper::{self, Budget, Kept, Swept};
use clap::{Args, Subcommand};
use serde_json::{Value, json};
use std::collections::BTreeMap;

/// Arguments of `tailor cache`.
#[derive(Args)]
pub(crate) struct Cache {
    #[command(subcommand)]
    verb: Verb,
}

#[derive(Subcommand)]
enum Verb {
    /// The results, largest first
    Ls,
    /// How much the store holds
    Du,
    /// The recorded runs, the newest first
    Runs,
    /// Keep what a run made or found, whatever `gc` removes
    Pin {
        /// The pin's name
        name: String,
        /// `last`, `last~1`, …, or the id that `cache runs` tells
        #[arg(default_value = "last")]
        run: String,
    },
    /// Let go of what was pinned
    Unpin {
        /// The pin's name
        name: String,
    },
    /// What is pinned
    Pins,
    /// Remove what is worth least until the store fits a budget
    Gc {
        /// Greatest size, such as 500M or 20G
        #[arg(long)]
        max_size: String,
        /// Runs whose results are kept whatever their size, beside the pinned ones
        #[arg(long, default_value_t = 1)]
        keep_runs: usize,
        /// Runs whose records are kept, beside the pinned ones
        #[arg(long, default_value_t = 200)]
        keep_records: usize,
        /// Say what would go, remove nothing
        #[arg(long)]
        dry_run: bool,
    },
    /// Read everything; put aside what is corrupt
    Verify,
}

/// `500M` as bytes.
fn bytes(text: &str) -> Option<u64> {
    let digits = text.trim_end_matches(|c: char| c.is_ascii_alphabetic());
    let factor = match text[digits.len()..]
        .to_ascii_uppercase()
        .trim_end_matches('B')
    {
        "" => 1u64,
        "K" => 1 << 10,
        "M" => 1 << 20,
        "G" => 1 << 30,
        _ => return None,
    };
    digits
        .parse::<f64>()
        .ok()
        .filter(|x| *x >= 0.0)
        .map(|x| (x * factor as f64) as u64)
}

fn mib(bytes: u64) -> f64 {
    bytes as f64 / f64::from(1 << 20)
}

/// Prints the one or the other.
fn say(house: &House, json: Value, lines: impl FnOnce() -> Vec<String>) {
    match house.json {
        true => super::outln!("{json}"),
        false => lines().iter().for_each(|line| super::outln!("{line}")),
    }
}

/// Does it.
pub(crate) fn cache(cache: &Cache, house: &House) -> Result<(), Fault> {
    if !house.cache.join("format").exists() {
        let place = house.cache.display();
        return Err(Fault::input(format!(
            "there is no cache at {place}; say where it is with --cache, or run something first"
        )));
    }
    let store = Store::open(&house.cache).map_err(Fault::input)?;
    match &cache.verb {
        Verb::Ls => ls(&store, house),
        Verb::Du => du(&store, house),
        Verb::Runs => runs(&store, house),
        Verb::Pin { name, run } => {
            let run = run_of(&store, run)?;
            store.pin(name, &run).map_err(Fault::input)?;
            let line = format!("{name}: the results of run {run} stay");
            say(house, json!({ "pin": name, "run": run }), || vec![line]);
        }
        Verb::Unpin { name } => {
            if !store.unpin(name) {
                let pins = store.pins();
                let known: Vec<&str> = pins.iter().map(|(name, _)| name.as_str()).collect();
                return Err(Fault::input(stage::unknown("pin", name, &known)));
            }
            say(house, json!({ "unpinned": name }), || {
                vec![format!("{name}: no longer pinned")]
            });
        }
        Verb::Pins => {
            let pins = store.pins();
            let one = |(name, run): &(String, String)| json!({ "pin": name, "run": run });
            say(house, pins.iter().map(one).collect(), || {
                pins.iter()
                    .map(|(name, run)| format!("{name:<20} {run}"))
                    .collect()
            });
        }
        Verb::Gc {
            max_size,
            keep_runs,
            keep_records,
            dry_run,
        } => {
            let most = bytes(max_size)
                .ok_or_else(|| Fault::input(format!("`{max_size}` is no size: say 500M or 20G")))?;
            let budget = Budget {
                most,
                keep_runs: *keep_runs,
                keep_records: *keep_records,
            };
            let swept = keeper::gc(&store, &budget, *dry_run).map_err(Fault::input)?;
            told(&swept, *dry_run, house);
        }
        Verb::Verify => {
            let results = keeper::list(&store).len();
            let bad = keeper::verify(&store);
            say(house, json!({ "checked": results, "bad": bad }), || {
                vec![format!("{results} results checked, {bad} put aside")]
            });
        }
    }
    Ok(())
}

fn ls(store: &Store, house: &House) {
    let mut kept = keeper::list(store);
    kept.sort_by(|a, b| b.bytes.cmp(&a.bytes).then(a.key.cmp(&b.key)));
    let line = |k: &Kept| {
        let (key, size, seconds) = (&k.key[..12], mib(k.bytes), k.seconds);
        format!("{key} {size:>9.2} MiB {seconds:>8.2} s  {}", k.stage)
    };
    let one = |k: &Kept| json!({ "key": k.key, "content": k.content, "bytes": k.bytes, "seconds": k.seconds, "stage": k.stage });
    say(house, kept.iter().map(one).collect(), || {
        kept.iter().map(line).collect()
    });
}

fn du(store: &Store, house: &House) {
    let kept = keeper::list(store);
    // Nodes may share a result.
    let sizes: BTreeMap<&str, u64> = kept.iter().map(|k| (&*k.content, k.bytes)).collect();
    let (total, parts) = (sizes.values().sum(), keeper::parts_size(store));
    let json = json!({ "results": kept.len(), "bytes": total, "parts_bytes": parts });
    say(house, json, || {
        let (n, total, parts) = (kept.len(), mib(total), mib(parts));
        vec![format!("{n} results, {total:.1} MiB; parts {parts:.1} MiB")]
    });
}

fn runs(store: &Store, house: &House) {
    let runs = past::runs(store.root());
    let count = |run: &Value, fate: &str| {
        let nodes = run["nodes"].as_array().into_iter().flatten();
        nodes.filter(|n| n["fate"] == fate).count()
    };
    let one = |(id, run): &(String, Value)| {
        let [found, made, failed] = ["found", "made", "failed"].map(|fate| count(run, fate));
        json!({ "run": id, "about": run["about"], "seconds": run["seconds"], "found": found, "made": made, "failed": failed })
    };
    let all: Vec<Value> = runs.iter().map(one).collect();
    say(house, json!(all), || {
        let line = |run: &Value| {
            let (id, about) = (run["run"].as_str(), run["about"].as_str());
            let seconds = run["seconds"].as_f64().unwrap_or_default();
            let (made, found, failed) = (&run["made"], &run["found"], &run["failed"]);
            format!(
                "{} {seconds:>8.1} s  {made:>3} made {found:>3} found {failed:>3} failed  {}",
                id.unwrap_or_default(),
                about.unwrap_or_default()
            )
        };
        all.iter().map(line).collect()
    });
}

/// The id of the run that somebody means.
fn run_of(store: &Store, text: &str) -> Result<String, Fault> {
    let ids = past::ids(store.root());
    let found = match past(text) {
        Some(ago) => ids.get(ago),
        None => ids.iter().find(|id| *id == text),
    };
    let n = ids.len();
    let unknown = || {
        Fault::input(format!(
            "`{text}` is none of the {n} runs that `cache runs` tells"
        ))
    };
    found.cloned().ok_or_else(unknown)
}

fn told(swept: &Swept, dry_run: bool, house: &House) {
    let results = swept.results.iter();
    let (freed, seconds) = results.fold((0, 0.0), |(b, s), k| (b + k.bytes, s + k.seconds));
    let (n, records, parts) = (swept.results.len(), swept.records, swept.parts_bytes);
    let json = json!({
        "removed": n, "bytes": freed, "rebuild_seconds": seconds, "parts_bytes": parts,
        "records": records, "dry_run": dry_run,
    });
    say(house, json, || {
        let verb = if dry_run { "would remove" } else { "removed" };
        let (freed, parts) = (mib(freed), mib(parts));
        vec![format!(
            "{verb} {n} results, {freed:.1} MiB; to rebuild them: {seconds:.1} s; \
             parts {parts:.1} MiB; {records} records of runs"
        )]
    });
}
