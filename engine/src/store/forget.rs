//! Forgetting a capture: everything that came of a folder of the user's goes, and what would lead to it goes last, so
//! that whoever is cut off can be started again.

use super::captures::{FOLDER as CAPTURES, NOTED, json};
use super::error::StoreError;
use super::files::at;
use super::folder::Store;
use super::links::Links;
use super::retention;
use super::trace::{Trace, accounted};
use crate::own;
use crate::past;
use programs::leftover;
use stage::Hash;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// What went.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Forgotten {
    /// Results.
    pub results: usize,
    /// Their size. \[bytes\]
    pub bytes: u64,
    /// Records of runs.
    pub runs: usize,
    /// Pins of those runs.
    pub pins: Vec<String>,
    /// Whether anything in the store came of it.
    pub known: bool,
    /// Other folders from which some of it came as well: what went is made again for them.
    pub shared: Vec<String>,
    /// Records and notes that could not be read, and went with all that may have come of them.
    pub broken: usize,
    /// Results that went because nothing readable shows what they came of.
    pub untraced: usize,
    /// Blobs that went because no record names them.
    pub unnamed: usize,
    /// What may have come of it and could not be read, and stays.
    pub unread: Vec<String>,
}

/// Removes all that came of the files of a folder or below it, as they were and as they are now: results with their
/// records, parts, records of runs and their pins, what is remembered of the files themselves, and what killed runs
/// left. What no readable record accounts for goes, too. Not while a run uses the store.
///
/// # Errors
///
/// A run uses the store, the disk refuses, or the shared store that the store is linked to. Then what leads to the
/// folder is still there, and it can be forgotten again.
pub fn forget(store: &Store, folder: &Path) -> Result<Forgotten, StoreError> {
    let root = store.root();
    if let Some(link) = own::link(root) {
        return Err(StoreError::Link(link));
    }
    let busy = || StoreError::Busy(root.into());
    let _alone = store.alone().ok_or_else(busy)?;
    let trace = store.trace(folder)?;
    let links = store.links()?;
    // What nothing readable accounts for may have come of it: only what surely did not stays.
    let sources: BTreeSet<String> = &accounted(store)? - &trace.seeds;
    let stay = links.alive(&sources, &BTreeSet::new());
    let derived = links.derived(&trace.seeds).into_iter();
    let of_it: Vec<usize> = derived.filter(|i| !stay.contains(i)).collect();
    let of_them: BTreeSet<usize> = of_it.iter().copied().collect();
    let untraced = (0..links.all.len()).filter(|i| !stay.contains(i) && !of_them.contains(i));
    let order: Vec<usize> = of_it.iter().copied().chain(untraced).collect();
    let mut forgotten = Forgotten {
        results: of_it.len(),
        untraced: order.len() - of_it.len(),
        broken: links.broken.len() + trace.broken,
        shared: shared(&links, &of_it, &trace),
        ..Forgotten::default()
    };
    let there = store.forget_elsewhere(&trace, &links, &stay)?;
    // First, so that nobody goes by it when this is cut off.
    store.gone(&[], NOTED)?;
    let contents = of_it.iter().map(|i| *links.all[*i].content.as_bytes());
    let contents: BTreeSet<[u8; 32]> = contents.collect();
    forget_blobs(store, &links.contents(&stay), &contents, &mut forgotten)?;
    // What was made of something goes before it: what is left leads to the rest.
    for i in order.iter().rev() {
        store.gone_from("ac", links.all[*i].key)?;
    }
    let keys = order.iter().map(|i| links.all[*i].key);
    let keys: Vec<Hash> = keys.chain(links.broken.iter().copied()).collect();
    store.forget_waiting(&keys)?;
    retention::remove_parts(store)?;
    retention::sweep(store)?;
    forget_runs(store, &trace, &mut forgotten)?;
    let plans = forget_plans(store, &trace, &mut forgotten)?;
    let (deliveries, broken) = store.forget_deliveries(|input| trace.has(input))?;
    forgotten.broken += broken;
    let (memo, remembered) = trace.memo(store);
    store.write("files.json", &memo)?;
    forgotten.known = remembered
        || !trace.seeds.is_empty()
        || !trace.notes.is_empty()
        || forgotten.runs + plans + deliveries > 0;
    let record = |key: &Hash| format!("{}/{}", root.display(), &own::name("ac", *key));
    forgotten.unread = links.unread.iter().map(record).collect();
    forgotten.unread.extend(there);
    // Nothing shows whose they are, and a process has their number.
    let mut stay = leftover::there(root).map_err(at(&root.join("exec")))?;
    let written = store.files("tmp", system::is_numbered)?.into_iter();
    stay.extend(written.map(|name| root.join("tmp").join(name)));
    let shown = |path: &PathBuf| path.display().to_string();
    forgotten
        .unread
        .extend(trace.unread.iter().chain(&stay).map(shown));
    // Before what leads to it goes, what went must not come back with a loss of power.
    store.sync_removed()?;
    // Last of all; and not while something may be left to which only they lead.
    if forgotten.unread.is_empty() {
        for (name, stays) in &trace.notes {
            match stays {
                None => _ = store.gone(&[CAPTURES], name)?,
                Some(note) => store.write(&format!("{CAPTURES}/{name}"), &json(note))?,
            }
        }
        store.sync_removed()?;
    }
    Ok(forgotten)
}

/// Folders of other captures of which something went as well.
fn shared(links: &Links, of_it: &[usize], trace: &Trace) -> Vec<String> {
    let going: BTreeSet<usize> = of_it.iter().copied().collect();
    let mut shared = BTreeSet::new();
    for (content, folders) in &trace.remaining {
        let theirs = links.derived(&BTreeSet::from([content.clone()]));
        if theirs.iter().any(|i| going.contains(i)) {
            shared.extend(folders.iter().cloned());
        }
    }
    shared.into_iter().collect()
}

/// Removes the blobs that no record names that stays.
fn forget_blobs(
    store: &Store,
    stay: &BTreeSet<[u8; 32]>,
    of_it: &BTreeSet<[u8; 32]>,
    forgotten: &mut Forgotten,
) -> Result<(), StoreError> {
    for content in store.shelf("cas")? {
        if stay.contains(content.as_bytes()) {
            continue;
        }
        let size = std::fs::metadata(store.place("cas", content)).map_or(0, |m| m.len());
        let went = store.gone_from("cas", content)?;
        match of_it.contains(content.as_bytes()) {
            true if went => forgotten.bytes += size,
            true => {}
            false => forgotten.unnamed += usize::from(went),
        }
    }
    Ok(())
}

/// Removes the plans that name the folder or its files, or cannot be read; how many name it.
fn forget_plans(
    store: &Store,
    trace: &Trace,
    forgotten: &mut Forgotten,
) -> Result<usize, StoreError> {
    let (root, mut count) = (store.root(), 0);
    for name in store.files("plans", own::is_hash)? {
        let bytes = std::fs::read(root.join("plans").join(&name)).unwrap_or_default();
        let named = trace.is_in_plan(&name, &bytes);
        forgotten.broken += usize::from(named.is_none());
        count += usize::from(named == Some(true));
        if named != Some(false) {
            store.gone(&["plans"], &name)?;
        }
    }
    Ok(count)
}

/// Removes the records of runs on the folder, or that cannot be read, and their pins.
fn forget_runs(store: &Store, trace: &Trace, forgotten: &mut Forgotten) -> Result<(), StoreError> {
    let root = store.root();
    let mut going = BTreeSet::new();
    for id in past::all_ids(root).map_err(at(&root.join("runs")))? {
        let mine = trace.is_in_run(root, &id).map_err(at(&root.join("runs")))?;
        forgotten.broken += usize::from(mine.is_none());
        if mine != Some(false) {
            going.insert(id);
        }
    }
    for (pin, run) in store.pins()? {
        if going.contains(&run) && store.gone(&["pins"], &pin)? {
            forgotten.pins.push(pin);
        }
    }
    store.gone(&[], "last-run")?;
    // Logs also of runs that were killed: whose they were is not known, and none runs now.
    for name in store.files("runs", own::is_run)? {
        let log = name.strip_suffix(".jsonl");
        if log.is_some_and(|id| going.contains(id) || !past::run_file(root, id).is_file()) {
            store.gone(&["runs"], &name)?;
        }
    }
    for id in &going {
        store.gone(&["runs"], &format!("{id}.json"))?;
    }
    forgotten.runs = going.len();
    Ok(())
}
