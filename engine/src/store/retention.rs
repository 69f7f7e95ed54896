//! What the store holds, what may go when it grows, and whether it is sound.

use super::error::StoreError;
use super::files::at;
use super::folder::Store;
use super::removal::is_litter;
use crate::own;
use crate::past;
use programs::leftover;
use stage::Hash;
use std::collections::{BTreeMap, BTreeSet};
use system::nofollow;

/// Runs whose records are kept by default; there may be twice as many for a while.
pub const KEPT_RECORDS: usize = 200;

/// Where parts and checkpoints are, and lay before they were bound to their keys.
const PARTS: [&str; 2] = ["parts", "part"];

/// A result in the store.
#[derive(Debug, Clone)]
pub struct Kept {
    /// Its key, hexadecimal.
    pub key: String,
    /// Its content, hexadecimal.
    pub content: String,
    /// Size. \[bytes\]
    pub bytes: u64,
    /// How long it took to make. \[s\]
    pub seconds: f64,
    /// What made it.
    pub stage: String,
}

/// The results that are there, by key. Records that are corrupt are put aside and left out.
///
/// # Errors
///
/// The disk refuses: then nobody knows what there is.
pub fn list(store: &Store) -> Result<Vec<Kept>, StoreError> {
    Ok(listed(store, &|| false)?.unwrap_or_default())
}

/// As [`list`], unless somebody asks to stop.
fn listed(store: &Store, stop: &dyn Fn() -> bool) -> Result<Option<Vec<Kept>>, StoreError> {
    let kept = |key: Hash| {
        let Some(record) = store.record_on_disk(key)? else {
            return Ok(None);
        };
        // The size on the disk, whatever a record from elsewhere has.
        let place = store.place("cas", record.content);
        let bytes = match std::fs::metadata(&place) {
            Err(why) if nofollow::is_absent(&why) => return Ok(None),
            blob => blob.map_err(at(&place))?,
        };
        let Some(bytes) = Some(bytes).filter(|b| b.is_file()).map(|b| b.len()) else {
            return Ok(None);
        };
        let stage = record
            .provenance
            .first()
            .map_or(String::new(), |(_, value)| value.clone());
        Ok(Some(Kept {
            key: key.to_hex().to_string(),
            content: record.content.to_hex().to_string(),
            bytes,
            seconds: record.seconds,
            stage,
        }))
    };
    let mut all = Vec::new();
    for key in store.shelf("ac")? {
        if stop() {
            return Ok(None);
        }
        all.extend(kept(key)?);
    }
    Ok(Some(all))
}

/// Size of all parts and checkpoints. \[bytes\]
///
/// # Errors
///
/// As [`list`].
pub fn parts_size(store: &Store) -> Result<u64, StoreError> {
    let sizes = PARTS.map(|shelf| size_of(store, shelf));
    sizes.into_iter().sum()
}

/// Size of all that is kept, without the records. \[bytes\]
///
/// # Errors
///
/// As [`list`].
pub fn size(store: &Store) -> Result<u64, StoreError> {
    Ok(size_of(store, "cas")? + parts_size(store)?)
}

fn size_of(store: &Store, shelf: &str) -> Result<u64, StoreError> {
    own::size(store.root(), shelf).map_err(at(&store.root().join(shelf)))
}

/// What may stay.
#[derive(Debug, Clone, Copy)]
pub struct Budget {
    /// Of all results. \[bytes\]
    pub most: u64,
    /// The last so many runs keep their results whatever their size, as pinned runs do.
    pub keep_runs: usize,
    /// The last so many runs keep their records, as pinned runs do.
    pub keep_records: usize,
}

/// What went, or would go.
#[derive(Debug, Clone, Default)]
pub struct Swept {
    /// Results.
    pub results: Vec<Kept>,
    /// Parts and checkpoints. \[bytes\]
    pub parts_bytes: u64,
    /// Records of runs.
    pub records: usize,
    /// Whether it was stopped before its end; what went by then is reported.
    pub stopped: bool,
}

/// Removes results worth least (seconds to rebuild per byte) until the rest fits into the budget;
/// those of pinned runs and of the last ones stay. Parts go first if it does not fit, and what
/// killed processes left, what was put aside and records of old runs go anyhow.
///
/// Records of results stay: the content of what went is still known, so that it is made again only
/// when somebody reads it. Nothing goes while a run uses the store.
///
/// # Errors
///
/// A run uses the store, or the disk refuses.
pub fn gc(store: &Store, budget: &Budget, dry_run: bool) -> Result<Swept, StoreError> {
    gc_until(store, budget, dry_run, &|| false)
}

/// As [`gc`], until somebody asks to stop: the store is sound at any moment.
///
/// # Errors
///
/// As [`gc`].
pub fn gc_until(
    store: &Store,
    budget: &Budget,
    dry_run: bool,
    stop: &dyn Fn() -> bool,
) -> Result<Swept, StoreError> {
    if let Some(link) = own::link(store.root()) {
        return Err(StoreError::Link(link));
    }
    let _alone = match dry_run {
        true => None,
        false => Some(
            store
                .alone()
                .ok_or_else(|| StoreError::Busy(store.root().into()))?,
        ),
    };
    // All is read before anything goes: what cannot be read may be why something stays.
    let runs = store.root().join("runs");
    let pins: BTreeSet<String> = store.pins()?.into_iter().map(|(_, run)| run).collect();
    let stays = past::contents(store.root(), budget.keep_runs, &pins);
    let mut stays = stays.map_err(at(&runs))?;
    stays.extend(store.waiting_contents()?);
    let mut swept = Swept::default();
    let Some(all) = listed(store, stop)? else {
        swept.stopped = true;
        return Ok(swept);
    };
    let (known, going, parts) = chosen(budget, all, &stays, parts_size(store)?);
    swept.parts_bytes = parts;
    swept.results = going;
    let pruned = past::prune(store.root(), budget.keep_records, &pins, dry_run);
    swept.records = pruned.map_err(at(&runs))?;
    if !dry_run {
        if swept.parts_bytes > 0 {
            remove_parts(store)?;
        }
        let going = swept.results.iter().map(|k| k.content.clone());
        let going: BTreeSet<String> = going.collect();
        let mut gone = BTreeSet::new();
        for hash in store.shelf("cas")? {
            if stop() {
                swept.stopped = true;
                swept.results.retain(|k| gone.contains(&k.content));
                return Ok(swept);
            }
            let name = hash.to_hex();
            let goes = going.contains(name.as_str());
            let known = known.contains(name.as_str()) || stays.contains(name.as_str());
            if goes || !known {
                store.gone_from("cas", hash)?;
                gone.insert(name.to_string());
            }
        }
        sweep(store)?;
    }
    Ok(swept)
}

/// What goes that is not among the contents that stay, and the size of the parts if they go; and all contents that
/// records name.
fn chosen(
    budget: &Budget,
    all: Vec<Kept>,
    stays: &BTreeSet<String>,
    parts: u64,
) -> (BTreeSet<String>, Vec<Kept>, u64) {
    // Nodes may share a result: it is worth what the dearest of them took.
    let mut kept: BTreeMap<String, Kept> = BTreeMap::new();
    for k in all {
        let dearest = kept.entry(k.content.clone()).or_insert_with(|| k.clone());
        if k.seconds > dearest.seconds {
            *dearest = k;
        }
    }
    let known: BTreeSet<String> = kept.keys().cloned().collect();
    let mut kept: Vec<Kept> = kept.into_values().collect();
    let worth = |k: &Kept| k.seconds / k.bytes.max(1) as f64;
    kept.sort_by(|a, b| worth(a).total_cmp(&worth(b)).then(a.key.cmp(&b.key)));
    let mut total = kept.iter().fold(0u64, |sum, k| sum.saturating_add(k.bytes));
    let parts_go = total.saturating_add(parts) > budget.most;
    let mut going = Vec::new();
    for k in kept {
        if total <= budget.most {
            break;
        }
        if !stays.contains(&k.content) {
            total = total.saturating_sub(k.bytes);
            going.push(k);
        }
    }
    (known, going, if parts_go { parts } else { 0 })
}

/// Removes all parts and checkpoints.
pub(super) fn remove_parts(store: &Store) -> Result<(), StoreError> {
    for shelf in PARTS {
        for key in store.shelf(shelf)? {
            store.gone_from(shelf, key)?;
        }
    }
    Ok(())
}

/// Removes what killed processes left: files that were being written, programs with their folders,
/// files of leases; and what was put aside.
pub(super) fn sweep(store: &Store) -> Result<(), StoreError> {
    let root = store.root();
    store.gone(&[], "index")?;
    store.all_gone("quarantine", own::is_hash)?;
    store.all_gone("tmp", |name| {
        system::is_numbered(name) && is_litter(root, name)
    })?;
    leftover::clear(root);
    // Nobody runs, so nobody holds one.
    store.all_gone("lease", own::is_lease)?;
    Ok(())
}

/// Whether what has a hash as its name is what it should be.
type Whole<'a> = &'a dyn Fn(Hash) -> Result<bool, StoreError>;

/// Reads every record, blob and part; what is corrupt is put aside. Returns how many were.
///
/// # Errors
///
/// The disk refused some of it, and all the rest was read.
pub fn verify(store: &Store) -> Result<usize, StoreError> {
    let (mut bad, mut refused) = (0, None);
    let mut look = |shelf: &str, whole: Whole<'_>| {
        let all = store.shelf(shelf).map_err(|why| refused = Some(why));
        for hash in all.unwrap_or_default() {
            match whole(hash) {
                Ok(whole) => bad += usize::from(!whole),
                Err(why) => refused = Some(why),
            }
        }
    };
    look("ac", &|key| store.is_sound(key));
    look("cas", &|content| Ok(store.blob_on_disk(content)?.is_some()));
    look("parts", &|key| Ok(store.recall_on_disk(key)?.is_some()));
    refused.map_or(Ok(bad), Err)
}
