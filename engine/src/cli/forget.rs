//! `cache forget`: all that came of a capture goes from the cache; folders of results that hold some of it are named, or
//! emptied where that is asked for.

use super::deliver::whose;
use super::fault::Fault;
use super::program::GlobalArgs;
use super::size::mib;
use crate::delivery::{self, Withdrawn, withdraw};
use crate::own::whole;
use crate::store::{Forgotten, Store, forget};
use clap::Args;
use serde_json::json;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// Arguments of `cache forget`.
#[derive(Args)]
pub(super) struct Forget {
    /// The folder; it may be gone
    folder: PathBuf,
    /// Remove the results of it in this folder, too: only what runs wrote there and nobody changed since; may be repeated
    #[arg(long)]
    out: Vec<PathBuf>,
}

/// What marks results of a folder, or of a file in it, that were made without a note of it in this cache.
fn marks(folder: &Path, global: &GlobalArgs) -> BTreeSet<String> {
    let Some(input) = global.program().input else {
        return BTreeSet::new();
    };
    let of = |path: PathBuf| whose(&[(input.to_owned(), path)]);
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let inner = entries
        .map(|entry| entry.path())
        .filter(|path| path.is_file());
    inner.chain([folder.to_owned()]).map(of).collect()
}

/// Where results of a folder lie: as the cache notes it, and in folders here and beside the folder.
fn results(store: &Store, folder: &Path, global: &GlobalArgs) -> BTreeMap<PathBuf, String> {
    let noted = store.delivered(folder).into_iter().map(|d| (d.out, d.of));
    let mut found: BTreeMap<PathBuf, String> = noted.collect();
    let marks = marks(folder, global);
    let beside = whole(folder).parent().map(Path::to_owned);
    for place in beside.into_iter().chain([whole(Path::new("."))]) {
        for entry in std::fs::read_dir(place).into_iter().flatten().flatten() {
            if let Some(of) = delivery::of(&entry.path()).filter(|of| marks.contains(of)) {
                found.insert(entry.path(), of);
            }
        }
    }
    found
}

/// The folders of results that are to be emptied. Nothing goes if one of them holds anything else.
fn asked(
    args: &Forget,
    found: &BTreeMap<PathBuf, String>,
    global: &GlobalArgs,
) -> Result<Vec<PathBuf>, Fault> {
    let marks = marks(&args.folder, global);
    let one = |out: &PathBuf| {
        let real = whole(out);
        let shown = out.display();
        let Some(of) = delivery::of(&real) else {
            return Err(Fault::input(format!(
                "{shown} holds no results of a run; nothing was removed"
            )));
        };
        match found.contains_key(&real) || marks.contains(&of) {
            true => Ok(real),
            false => Err(Fault::input(format!(
                "{shown} holds results of something else than {}; nothing was removed",
                args.folder.display()
            ))),
        }
    };
    args.out.iter().map(one).collect()
}

/// Forgets a folder.
pub(super) fn forget_folder(
    args: &Forget,
    store: &Store,
    global: &GlobalArgs,
) -> Result<(), Fault> {
    let found = results(store, &args.folder, global);
    let asked = asked(args, &found, global)?;
    let forgotten = forget(store, &args.folder).map_err(Fault::input)?;
    let mut gone: Vec<(PathBuf, Withdrawn)> = Vec::new();
    for out in asked {
        let withdrawn = withdraw(&out).map_err(Fault::stage)?;
        gone.push((out, withdrawn));
    }
    let stay = found
        .into_keys()
        .filter(|out| gone.iter().all(|(g, _)| g != out));
    let stay: Vec<String> = stay.map(|out| out.display().to_string()).collect();
    if !forgotten.known && gone.is_empty() {
        let mut why = format!(
            "nothing in {} came of {}: was it made with another cache (--cache), or has the folder another path since?",
            global.cache.display(),
            args.folder.display()
        );
        stay.iter()
            .for_each(|out| why += &format!("\n{}", remains(out)));
        return Err(Fault::stage(why));
    }
    told(&forgotten, &stay, &gone, global);
    Ok(())
}

fn remains(out: &str) -> String {
    format!("results of it remain in {out}: remove the folder, or run this again with --out {out}")
}

fn told(f: &Forgotten, stay: &[String], gone: &[(PathBuf, Withdrawn)], global: &GlobalArgs) {
    if global.json {
        let removed = |(out, w): &(PathBuf, Withdrawn)| json!({ "out": out.display().to_string(), "files": w.removed, "left": w.left });
        let removed: Vec<_> = gone.iter().map(removed).collect();
        crate::outln!(
            "{}",
            json!({
                "results": f.results, "bytes": f.bytes, "runs": f.runs, "pins": f.pins, "shared": f.shared,
                "outs": stay, "removed": removed,
            })
        );
        return;
    }
    let (results, runs, freed) = (f.results, f.runs, mib(f.bytes));
    if f.known {
        crate::outln!(
            "forgotten: results {results} ({freed:.1} MiB), records of runs {runs}, all unfinished parts"
        );
    }
    if !f.pins.is_empty() {
        crate::outln!("pins that went with them: {}", f.pins.join(", "));
    }
    for folder in &f.shared {
        crate::outln!("{folder} shared some of it; that is made again when it is needed");
    }
    for (out, withdrawn) in gone {
        let out = out.display();
        crate::outln!("removed from {out}: files {}", withdrawn.removed);
        if !withdrawn.left.is_empty() {
            let left = withdrawn.left.join(", ");
            crate::outln!("left in {out} (not written by a run, or changed since): {left}");
        }
    }
    stay.iter()
        .for_each(|out| crate::outln!("{}", remains(out)));
}
