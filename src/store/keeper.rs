//! What the store holds, what may go when it grows, and whether it is sound.

use super::{Store, StoreError};
use crate::past;
use stage::Hash;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

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

/// All files of a shelf.
fn shelf(root: &Path, name: &str) -> Vec<PathBuf> {
    let inner = |folder: PathBuf| {
        let entries = std::fs::read_dir(folder).into_iter().flatten();
        entries
            .filter_map(|e| Some(e.ok()?.path()))
            .collect::<Vec<_>>()
    };
    let mut files: Vec<_> = inner(root.join(name)).into_iter().flat_map(inner).collect();
    files.sort();
    files
}

fn hash_of(path: &Path) -> Option<Hash> {
    Hash::from_hex(path.file_name()?.to_str()?).ok()
}

/// The results that are there, by key. Records that are corrupt are put aside and left out.
pub fn list(store: &Store) -> Vec<Kept> {
    let kept = |path: PathBuf| {
        let key = hash_of(&path)?;
        let record = store.record(key)?;
        if !store.place("cas", record.content).is_file() {
            return None;
        }
        let stage = record
            .story
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
    shelf(store.root(), "ac")
        .into_iter()
        .filter_map(kept)
        .collect()
}

/// Size of all parts and checkpoints. \[bytes\]
pub fn parts_size(store: &Store) -> u64 {
    let size = |path: &PathBuf| std::fs::metadata(path).map_or(0, |m| m.len());
    shelf(store.root(), "part").iter().map(size).sum()
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
pub fn gc(store: &Store, budget: &Budget, dry_run: bool) -> Result<Swept, StoreError> {
    let _alone = match dry_run {
        true => None,
        false => Some(
            store
                .alone()
                .ok_or_else(|| StoreError::Busy(store.root().into()))?,
        ),
    };
    let pins: BTreeSet<String> = store.pins().into_iter().map(|(_, run)| run).collect();
    let stays = past::contents(store.root(), budget.keep_runs, &pins);
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
        if swept.parts_bytes > 0 {
            for path in shelf(store.root(), "part") {
                let _ = std::fs::remove_file(path);
            }
        }
        let going: BTreeSet<&str> = swept.results.iter().map(|k| k.content.as_str()).collect();
        for path in shelf(store.root(), "cas") {
            let name = path.file_name().and_then(|n| n.to_str()).unwrap_or("");
            if going.contains(name) || !known.contains(name) {
                let _ = std::fs::remove_file(path);
            }
        }
        sweep(store);
    }
    Ok(swept)
}

/// Removes what killed processes left: files that were being written; files of leases; and what
/// was put aside.
fn sweep(store: &Store) {
    let _ = std::fs::remove_file(store.root().join("index"));
    let names = |folder: &str| {
        let entries = std::fs::read_dir(store.root().join(folder))
            .into_iter()
            .flatten();
        entries
            .filter_map(|e| Some(e.ok()?.path()))
            .collect::<Vec<_>>()
    };
    for path in names("quarantine") {
        let _ = std::fs::remove_file(path);
    }
    for path in names("tmp") {
        // Files here begin with the number of the process that writes them.
        let process = path.file_name().and_then(|n| n.to_str()?.split('-').next());
        let alive = process.is_some_and(|id| Path::new("/proc").join(id).exists());
        if !alive {
            let _ = std::fs::remove_file(path);
        }
    }
    // Nobody runs, so nobody holds one.
    for path in names("lease") {
        let _ = std::fs::remove_file(path);
    }
}

/// Reads every record and every blob; what is corrupt is put aside. Returns how many were.
pub fn verify(store: &Store) -> usize {
    let records = shelf(store.root(), "ac").into_iter();
    let bad_records = records
        .filter(|p| hash_of(p).is_none_or(|h| store.record(h).is_none()))
        .count();
    let blobs = shelf(store.root(), "cas").into_iter();
    let bad_blobs = blobs
        .filter(|p| hash_of(p).is_none_or(|h| store.blob(h).is_none()))
        .count();
    let parts = shelf(store.root(), "part").into_iter();
    let bad_parts = parts
        .filter(|p| hash_of(p).is_none_or(|h| store.recall(h).is_none()))
        .count();
    bad_records + bad_blobs + bad_parts
}
