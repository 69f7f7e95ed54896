//! `cache forget`: all that came of a capture goes from the cache; folders of results that hold some of it are named, or
//! emptied where that is asked for.

use super::deliver::whose;
use super::fault::Fault;
use super::forget_report::{remains, reported};
use super::program::GlobalArgs;
use clap::Args;
use engine::delivery::{self, Withdrawn, withdraw};
use engine::store::{Store, StoreError, forget};
use engine::whole;
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

/// Where results of a folder are: as the cache notes it, and in folders here and beside the folder.
fn results(
    store: &Store,
    folder: &Path,
    global: &GlobalArgs,
) -> Result<BTreeMap<PathBuf, String>, StoreError> {
    let noted = store.delivered(&store.trace(folder)?)?.into_iter();
    let mut found: BTreeMap<PathBuf, String> = noted.map(|d| (d.out, d.of)).collect();
    let marks = marks(folder, global);
    let beside = whole(folder).parent().map(Path::to_owned);
    for place in beside.into_iter().chain([whole(Path::new("."))]) {
        for entry in std::fs::read_dir(place).into_iter().flatten().flatten() {
            if let Some(of) = delivery::of(&entry.path()).filter(|of| marks.contains(of)) {
                found.insert(entry.path(), of);
            }
        }
    }
    Ok(found)
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
    let found = results(store, &args.folder, global).map_err(Fault::input)?;
    let asked = asked(args, &found, global)?;
    super::private::clear();
    let forgotten = forget(store, &args.folder).map_err(|why| match why {
        StoreError::Left(_) => Fault::stage(why),
        why => Fault::input(why),
    })?;
    let mut gone: Vec<(PathBuf, Withdrawn)> = Vec::new();
    for out in asked {
        let withdrawn = withdraw(&out).map_err(Fault::stage)?;
        gone.push((out, withdrawn));
    }
    let stay = found
        .into_keys()
        .filter(|out| gone.iter().all(|(g, _)| g != out));
    let stay: Vec<String> = stay.map(|out| out.display().to_string()).collect();
    if !forgotten.known && gone.is_empty() && forgotten.unread.is_empty() && forgotten.broken == 0 {
        let mut why = format!(
            "nothing in {} came of {}: was it made with another cache (--cache), or has the folder another path and other files since?",
            global.cache.display(),
            args.folder.display()
        );
        stay.iter()
            .for_each(|out| why += &format!("\n{}", remains(out)));
        return Err(Fault::stage(why));
    }
    reported(&forgotten, &stay, &gone, global)
}
