//! `cache ls|du|runs|pin|unpin|pins|gc|forget|verify`; `cli/store.rs` has the rest.

use super::either::print_either;
use super::fault::Fault;
use super::forget::{Forget, forget_folder};
use super::pins;
use super::program::GlobalArgs;
use super::size::mib;
use super::speech::CANCEL;
use super::text::count;
use clap::{Args, Subcommand};
use engine::past::{self, Head};
use engine::store::remote::Sharing;
use engine::store::retention::{self, Budget, KEPT_RECORDS, Kept, Swept};
use engine::store::{Store, StoreError};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::atomic::Ordering;

/// Arguments of `cache`.
#[derive(Args)]
pub(crate) struct Cache {
    #[command(subcommand)]
    verb: Verb,
}

#[derive(Subcommand)]
enum Verb {
    /// The results, largest first, and how much they are
    Ls,
    /// How much the store has
    #[command(hide = true)]
    Du,
    /// The recorded runs, the newest first
    Runs,
    /// Keep what a run made or found, whatever `gc` removes; without a name: what is pinned
    Pin {
        /// The pin's name
        name: Option<String>,
        /// `last`, `last~1`, …, or the id that `cache runs` prints
        #[arg(default_value = "last")]
        run: String,
        /// No longer keep it
        #[arg(long, requires = "name")]
        undo: bool,
    },
    /// `pin NAME --undo`
    #[command(hide = true)]
    Unpin {
        /// The pin's name
        name: String,
    },
    /// `pin`
    #[command(hide = true)]
    Pins,
    /// Remove what is worth least until the store fits a budget
    Gc {
        /// Runs whose results are kept whatever their size, beside the pinned ones
        #[arg(long, default_value_t = 1)]
        keep_runs: usize,
        /// Runs whose records are kept, beside the pinned ones
        #[arg(long, default_value_t = KEPT_RECORDS)]
        keep_records: usize,
        /// Print what would go, remove nothing
        #[arg(long)]
        dry_run: bool,
    },
    /// Remove all that came of an input's folder: results, parts, records of runs; folders of results are named (see --out)
    Forget(Forget),
    /// Read everything; put aside what is corrupt
    Verify,
    /// What the shared store (--store) has, how it answers, whether it keeps its word
    Store,
    /// Upload to the shared store (--store) what waits
    Push,
    /// Make a key that signs what goes to a shared store: FILE, for its owner only, and FILE.pub for those who trust it
    Keygen {
        /// The file; it must not be there
        file: PathBuf,
        /// How many days it is good for
        #[arg(long, default_value_t = 365, value_parser = clap::value_parser!(u32).range(1..=36_500))]
        days: u32,
    },
    /// Remove from the shared store (--store) what was written long ago, by its own clock
    SweepStore {
        /// How many days ago
        #[arg(long)]
        older_days: f64,
        /// Print what would go, remove nothing
        #[arg(long)]
        dry_run: bool,
    },
}

/// Answers about the store that machines share, which needs none here.
fn beside(
    verb: &Verb,
    global: &GlobalArgs,
    sharing: Option<&Sharing>,
) -> Option<Result<(), Fault>> {
    match verb {
        Verb::Store => Some(super::store::look(sharing, global)),
        Verb::SweepStore {
            older_days,
            dry_run,
        } => Some(super::store::sweep(sharing, *older_days, *dry_run, global)),
        Verb::Keygen { file, days } => Some(super::store::keygen(file, *days, global)),
        Verb::Push if sharing.is_none() => {
            let why = "`cache push`: where to? Give --store";
            Some(Err(Fault::input(why)))
        }
        // What waits goes there before the program ends.
        Verb::Push => Some(Ok(())),
        _ => None,
    }
}

/// Answers about the store, or removes from it.
pub(crate) fn cache(
    cache: &Cache,
    global: &GlobalArgs,
    sharing: Option<&Sharing>,
) -> Result<(), Fault> {
    if let Some(answer) = beside(&cache.verb, global, sharing) {
        return answer;
    }
    if !global.cache.join("format").exists() {
        let place = global.cache.display();
        return Err(Fault::input(format!(
            "there is no cache at {place}; give its place with --cache, or run something first"
        )));
    }
    let store = Store::open(&global.cache).map_err(Fault::input)?;
    match &cache.verb {
        Verb::Store | Verb::Push | Verb::SweepStore { .. } | Verb::Keygen { .. } => {
            unreachable!("answered above")
        }
        Verb::Ls => ls(&store, global).map_err(Fault::input)?,
        Verb::Du => du(&store, global).map_err(Fault::input)?,
        Verb::Runs => runs(&store, global),
        Verb::Pins | Verb::Pin { name: None, .. } => pins::list(&store, global)?,
        Verb::Unpin { name }
        | Verb::Pin {
            name: Some(name),
            undo: true,
            ..
        } => pins::unpin(&store, name, global)?,
        Verb::Pin {
            name: Some(name),
            run,
            ..
        } => {
            pins::pin(&store, (name, run), global)?;
        }
        Verb::Gc {
            keep_runs,
            keep_records,
            dry_run,
        } => {
            let why = "give how much may stay: --max-size 500M, or 20G";
            let most = global.max_size.ok_or_else(|| Fault::input(why))?;
            let budget = Budget {
                most,
                keep_runs: *keep_runs,
                keep_records: *keep_records,
            };
            gc(&store, &budget, *dry_run, global)?;
        }
        Verb::Forget(args) => forget_folder(args, &store, global)?,
        Verb::Verify => {
            let bad = retention::verify(&store).map_err(Fault::input)?;
            let results = retention::list(&store).map_err(Fault::input)?.len();
            print_either(global, json!({ "checked": results, "bad": bad }), || {
                let (whole, aside) = (count(results, "result"), count(bad, "file"));
                vec![format!("whole: {whole}; put aside: {aside}")]
            });
        }
    }
    Ok(())
}

/// Removes what is worth least, until the user asks to stop.
fn gc(store: &Store, budget: &Budget, dry_run: bool, global: &GlobalArgs) -> Result<(), Fault> {
    let stop = || CANCEL.load(Ordering::Relaxed);
    let swept = retention::gc_until(store, budget, dry_run, &stop).map_err(|why| match why {
        StoreError::Left(_) => Fault::stage(why),
        why => Fault::input(why),
    })?;
    report_swept(&swept, dry_run, global);
    match swept.stopped {
        true => Err(Fault::stopped()),
        false => Ok(()),
    }
}

fn ls(store: &Store, global: &GlobalArgs) -> Result<(), StoreError> {
    let mut kept = retention::list(store)?;
    let total = total(store, &kept)?.0;
    kept.sort_by(|a, b| b.bytes.cmp(&a.bytes).then(a.key.cmp(&b.key)));
    let line = |k: &Kept| {
        let (key, size, seconds) = (&k.key[..12], mib(k.bytes), k.seconds);
        format!("{key} {size:>9.2} MiB {seconds:>8.2} s  {}", k.stage)
    };
    let one = |k: &Kept| json!({ "key": k.key, "content": k.content, "bytes": k.bytes, "seconds": k.seconds, "stage": k.stage });
    print_either(global, kept.iter().map(one).collect(), || {
        let lines = kept.iter().map(line);
        lines.chain([total]).collect()
    });
    Ok(())
}

/// How much these results are, in words and as JSON. Nodes may share a result.
fn total(store: &Store, kept: &[Kept]) -> Result<(String, Value), StoreError> {
    let sizes: BTreeMap<&str, u64> = kept.iter().map(|k| (&*k.content, k.bytes)).collect();
    let (total, parts) = (sizes.values().sum(), retention::parts_size(store)?);
    let json = json!({ "results": kept.len(), "bytes": total, "parts_bytes": parts });
    let (results, total, parts) = (count(kept.len(), "result"), mib(total), mib(parts));
    let line = format!("{results}, {total:.1} MiB; parts {parts:.1} MiB");
    Ok((line, json))
}

fn du(store: &Store, global: &GlobalArgs) -> Result<(), StoreError> {
    let (line, json) = total(store, &retention::list(store)?)?;
    print_either(global, json, || vec![line]);
    Ok(())
}

fn runs(store: &Store, global: &GlobalArgs) {
    let root = store.root();
    let head = |id: String| past::head(root, &id).map(|head| (id, head));
    let all: Vec<(String, Head)> = past::ids(root).into_iter().filter_map(head).collect();
    let one = |(id, h): &(String, Head)| {
        json!({ "run": id, "about": h.about, "pipeline": h.of.pipeline, "variant": h.of.variant,
            "seconds": h.seconds, "found": h.found, "made": h.made, "failed": h.failed })
    };
    print_either(global, all.iter().map(one).collect(), || {
        let line = |(id, h): &(String, Head)| {
            let Head {
                seconds,
                made,
                found,
                failed,
                about,
                ..
            } = h;
            format!(
                "{id} {seconds:>8.1} s  {made:>3} made {found:>3} found {failed:>3} failed  {about}"
            )
        };
        all.iter().map(line).collect()
    });
}

fn report_swept(swept: &Swept, dry_run: bool, global: &GlobalArgs) {
    let results = swept.results.iter();
    let (freed, seconds) = results.fold((0, 0.0), |(b, s), k| (b + k.bytes, s + k.seconds));
    let (n, records, parts) = (swept.results.len(), swept.records, swept.parts_bytes);
    let json = json!({
        "removed": n, "bytes": freed, "rebuild_seconds": seconds, "parts_bytes": parts,
        "records": records, "dry_run": dry_run,
    });
    print_either(global, json, || {
        let verb = if dry_run { "would remove" } else { "removed" };
        let (freed, parts) = (mib(freed), mib(parts));
        vec![format!(
            "{verb} {}, {freed:.1} MiB; to rebuild them: {seconds:.1} s; \
             parts {parts:.1} MiB; {} of runs",
            count(n, "result"),
            count(records, "record")
        )]
    });
}
