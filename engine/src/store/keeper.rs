//! What the store holds, what may go when it grows, and whether it is sound.

use super::error::StoreError;
use super::folder::Store;
use crate::foreign::leftover;
use crate::own;
use crate::past;
use crate::system::is_alive;
use stage::Hash;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// Runs whose records are kept if nothing else is said; there may be twice as many for a while.
pub const KEPT_RECORDS: usize = 200;

/// Where parts and checkpoints lie, and lay before they were bound to their keys.
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
pub fn list(store: &Store) -> Vec<Kept> {
    let kept = |key: Hash| {
        let record = store.record(key)?;
        if !store.place("cas", record.content).is_file() {
            return None;
        }
        let stage = record
            .provenance
            .first()
            .map_or(String::new(), |(_, value)| value.clone());
        Some(Kept {
            key: key.to_hex().to_string(),
            content: record.content.to_hex().to_string(),
            bytes: record.bytes,
            seconds: record.seconds,
            stage,
        })
    };
    let keys = own::shelf(store.root(), "ac").into_iter();
    keys.filter_map(kept).collect()
}

/// Size of all parts and checkpoints. \[bytes\]
pub fn parts_size(store: &Store) -> u64 {
    let sizes = PARTS.map(|shelf| own::size(store.root(), shelf));
    sizes.iter().sum()
}

/// Size of all that is kept, without the records. \[bytes\]
pub fn size(store: &Store) -> u64 {
    own::size(store.root(), "cas") + parts_size(store)
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
    let pins: BTreeSet<String> = store.pins().into_iter().map(|(_, run)| run).collect();
    let mut stays = past::contents(store.root(), budget.keep_runs, &pins);
    stays.extend(store.waiting_contents());
    // Nodes may share a result: it is worth what the dearest of them took.
    let mut kept: BTreeMap<String, Kept> = BTreeMap::new();
    for k in list(store) {
        let dearest = kept.entry(k.content.clone()).or_insert_with(|| k.clone());
        if k.seconds > dearest.seconds {
            *dearest = k;
        }
    }
    let known: BTreeSet<String> = kept.keys().cloned().collect();
    let mut kept: Vec<Kept> = kept.into_values().collect();
    let worth = |k: &Kept| k.seconds / k.bytes.max(1) as f64;
    kept.sort_by(|a, b| worth(a).total_cmp(&worth(b)).then(a.key.cmp(&b.key)));
    let mut total: u64 = kept.iter().map(|k| k.bytes).sum();
    let mut swept = Swept::default();
    let parts = parts_size(store);
    if total + parts > budget.most {
        swept.parts_bytes = parts;
    }
    for k in kept {
        if total <= budget.most {
            break;
        }
        if !stays.contains(&k.content) {
            total -= k.bytes;
            swept.results.push(k);
        }
    }
    swept.records = past::prune(store.root(), budget.keep_records, &pins, dry_run);
    if !dry_run {
        let root = store.root();
        if swept.parts_bytes > 0 {
            remove_parts(root);
        }
        let going: BTreeSet<&str> = swept.results.iter().map(|k| k.content.as_str()).collect();
        for hash in own::shelf(root, "cas") {
            let name = hash.to_hex();
            if going.contains(name.as_str()) || !known.contains(name.as_str()) {
                own::remove_from(root, "cas", hash);
            }
        }
        sweep(root);
    }
    Ok(swept)
}

/// Removes all parts and checkpoints.
pub(super) fn remove_parts(root: &Path) {
    for shelf in PARTS {
        for key in own::shelf(root, shelf) {
            own::remove_from(root, shelf, key);
        }
    }
}

/// Removes what killed processes left: files that were being written, programs with their folders,
/// files of leases; and what was put aside.
pub(super) fn sweep(root: &Path) {
    own::remove(root, &[], "index");
    for name in own::files(root, "quarantine", own::is_hash) {
        own::remove(root, &["quarantine"], &name);
    }
    for name in own::files(root, "tmp", own::is_writing) {
        // Files here begin with the number of the process that writes them.
        let process = name.split('-').next().unwrap_or("");
        if !is_alive(process) {
            own::remove(root, &["tmp"], &name);
        }
    }
    leftover::clear(root);
    // Nobody runs, so nobody holds one.
    for name in own::files(root, "lease", own::is_lease) {
        own::remove(root, &["lease"], &name);
    }
}

/// Reads every record, blob and part; what is corrupt is put aside. Returns how many were.
pub fn verify(store: &Store) -> usize {
    let bad = |shelf: &str, whole: &dyn Fn(Hash) -> bool| {
        let all = own::shelf(store.root(), shelf).into_iter();
        all.filter(|hash| !whole(*hash)).count()
    };
    bad("ac", &|key| store.is_sound(key))
        + bad("cas", &|content| store.blob_here(content).is_some())
        + bad("parts", &|key| store.recall(key).is_some())
}
