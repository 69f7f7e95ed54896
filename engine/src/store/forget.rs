//! Forgetting a capture: everything that came of a folder of the user's goes.
//!
//! `captures/HASH` names the folders whose files had this content, as a list in JSON: where the
//! search begins, also when the records of the runs are long gone.

use super::error::StoreError;
use super::folder::Store;
use super::keeper;
use crate::own;
use crate::past;
use crate::source::Memo;
use stage::Hash;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// A hash over all folders and contents that the last run noted.
const NOTED: &str = "noted";

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
}

/// What a result was made of, and where it lies.
struct Link {
    key: Hash,
    content: Hash,
    bytes: u64,
    from: Vec<String>,
}

impl Store {
    /// Notes what the files of each folder had as content. What a run notes as the one before did is looked at
    /// once, not input by input.
    pub(crate) fn note_captures(&self, all: &[(Hash, &Path)]) {
        let mut digest = blake3::Hasher::new();
        for (content, folder) in all {
            digest.update(content.as_bytes());
            let folder = folder.as_os_str().as_encoded_bytes();
            digest.update(&(folder.len() as u64).to_le_bytes());
            digest.update(folder);
        }
        let digest = digest.finalize().to_hex();
        let noted = std::fs::read(self.root().join(NOTED)).unwrap_or_default();
        if noted == digest.as_bytes() {
            return;
        }
        let note = |one: &&(Hash, &Path)| self.note_capture(one.0, one.1);
        if all.iter().filter(note).count() == all.len() {
            let _ = self.write(NOTED, digest.as_bytes());
        }
    }

    /// Notes that the files of a folder had this content; whether that stands there now.
    pub fn note_capture(&self, content: Hash, folder: &Path) -> bool {
        let (mut folders, folder) = (self.folders_of(content), folder.display().to_string());
        if folders.contains(&folder) {
            return true;
        }
        folders.push(folder);
        self.write(&capture(content), &json(&folders)).is_ok()
    }

    fn folders_of(&self, content: Hash) -> Vec<String> {
        let file = std::fs::read(self.root().join(capture(content)));
        serde_json::from_slice(&file.unwrap_or_default()).unwrap_or_default()
    }

    /// Every result with what it was made of.
    fn links(&self) -> Vec<Link> {
        let link = |key: Hash| {
            let record = self.record(key)?;
            let from = record.provenance.into_iter();
            let from = from.filter(|(what, _)| what.starts_with("from "));
            Some(Link {
                key,
                content: record.content,
                bytes: record.bytes,
                from: from.map(|(_, value)| value).collect(),
            })
        };
        let keys = own::shelf(self.root(), "ac").into_iter();
        keys.filter_map(link).collect()
    }
}

fn capture(content: Hash) -> String {
    format!("captures/{}", content.to_hex())
}

fn json(folders: &[String]) -> Vec<u8> {
    serde_json::to_vec(folders).expect("bug: JSON")
}

/// The results that came of some contents, directly or not, by their place in the list.
fn derived(links: &[Link], seeds: &BTreeSet<String>) -> BTreeSet<usize> {
    let mut readers: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
    for (i, link) in links.iter().enumerate() {
        for from in &link.from {
            readers.entry(from).or_default().push(i);
        }
    }
    let (mut open, mut found): (Vec<String>, _) =
        (seeds.iter().cloned().collect(), BTreeSet::new());
    while let Some(content) = open.pop() {
        for i in readers.get(content.as_str()).into_iter().flatten() {
            if found.insert(*i) {
                open.push(links[*i].content.to_hex().to_string());
            }
        }
    }
    found
}

/// Removes all that came of the files of a folder or below it: results with their records, parts,
/// records of runs and their pins, and what is remembered of the files themselves. Not while a run
/// uses the store.
///
/// # Errors
///
/// A run uses the store, the disk refuses, or the shared store that the store is linked to.
pub fn forget(store: &Store, folder: &Path) -> Result<Forgotten, StoreError> {
    let root = store.root();
    if let Some(link) = own::link(root) {
        return Err(StoreError::Link(link));
    }
    let busy = || StoreError::Busy(root.into());
    let _alone = store.alone().ok_or_else(busy)?;
    let folder = own::whole(folder);
    let below = |text: &String| Path::new(text).starts_with(&folder);
    let deliveries = store.forget_deliveries(below);
    // First, so that nobody goes by it when this is cut off.
    own::remove(root, &[], NOTED);
    let (mut mine, mut others) = (BTreeSet::new(), BTreeMap::new());
    for name in own::files(root, "captures", own::is_hash) {
        let Ok(content) = Hash::from_hex(&name) else {
            continue;
        };
        let (here, there): (Vec<_>, Vec<_>) =
            store.folders_of(content).into_iter().partition(below);
        if !here.is_empty() {
            mine.insert(name.clone());
            match there.is_empty() {
                true => _ = own::remove(root, &["captures"], &name),
                false => store.write(&capture(content), &json(&there))?,
            }
        }
        if !there.is_empty() {
            others.insert(name, there);
        }
    }
    let links = store.links();
    let going = derived(&links, &mine);
    let mut forgotten = Forgotten {
        results: going.len(),
        ..Forgotten::default()
    };
    let contents: BTreeSet<&[u8; 32]> =
        going.iter().map(|i| links[*i].content.as_bytes()).collect();
    for (content, folders) in others {
        let theirs = derived(&links, &BTreeSet::from([content]));
        if theirs
            .iter()
            .any(|i| contents.contains(links[*i].content.as_bytes()))
        {
            forgotten.shared.extend(folders);
        }
    }
    forgotten.shared.sort();
    forgotten.shared.dedup();
    let there: Vec<(Hash, Hash)> = going
        .iter()
        .map(|i| (links[*i].key, links[*i].content))
        .collect();
    store.forget_elsewhere(&there)?;
    for i in &going {
        let Link {
            key,
            content,
            bytes,
            ..
        } = links[*i];
        own::remove_from(root, "ac", key);
        store.forget_waiting(key);
        if own::remove_from(root, "cas", content) {
            forgotten.bytes += bytes;
        }
    }
    forget_runs(store, &below, &mut forgotten);
    let plans = forget_plans(root, &below);
    forgotten.known = !mine.is_empty() || forgotten.runs + plans + deliveries > 0;
    keeper::remove_parts(root);
    keeper::sweep(root);
    let memo = root.join("files.json");
    store.write("files.json", &Memo::load(&memo).without(&folder).bytes())?;
    Ok(forgotten)
}

/// Removes the plans that name a folder that fits, or cannot be read; how many name one.
fn forget_plans(root: &Path, fits: &dyn Fn(&String) -> bool) -> usize {
    #[derive(serde::Deserialize)]
    struct Plan {
        inputs: Vec<Input>,
    }
    #[derive(serde::Deserialize)]
    struct Input {
        folder: String,
    }
    let mut count = 0;
    for name in own::files(root, "plans", own::is_hash) {
        let bytes = std::fs::read(root.join("plans").join(&name)).unwrap_or_default();
        let plan = serde_json::from_slice::<Plan>(&bytes);
        let named = plan.map(|plan| plan.inputs.iter().any(|i| fits(&i.folder)));
        count += usize::from(matches!(named, Ok(true)));
        if named.unwrap_or(true) {
            own::remove(root, &["plans"], &name);
        }
    }
    count
}

/// Removes the records of runs on inputs that fit, and their pins.
fn forget_runs(store: &Store, fits: &dyn Fn(&String) -> bool, forgotten: &mut Forgotten) {
    let root = store.root();
    let going = |id: &String| {
        let head = past::head(root, id).unwrap_or_default();
        head.of.inputs.values().any(fits)
    };
    let going: Vec<String> = past::ids(root).into_iter().filter(going).collect();
    for id in &going {
        own::remove(root, &["runs"], &format!("{id}.json"));
        own::remove(root, &["runs"], &format!("{id}.jsonl"));
    }
    // Of runs that were killed, whose they were is not known; none runs now.
    for name in own::files(root, "runs", own::is_run) {
        let log = name.strip_suffix(".jsonl");
        if log.is_some_and(|id| !past::run_file(root, id).is_file()) {
            own::remove(root, &["runs"], &name);
        }
    }
    for (pin, run) in store.pins() {
        if going.contains(&run) && store.unpin(&pin) {
            forgotten.pins.push(pin);
        }
    }
    own::remove(root, &[], "last-run");
    forgotten.runs = going.len();
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_noted_is_not_looked_at_again_until_it_is_forgotten() {
        let place = tempfile::tempdir().unwrap();
        let store = Store::open(&place.path().join("cache")).unwrap();
        let (content, folder) = (blake3::hash(b"photos"), place.path().join("photos"));
        let mark = store.root().join(capture(content));
        store.note_captures(&[(content, &folder)]);
        assert_eq!(store.folders_of(content).len(), 1);
        std::fs::remove_file(&mark).unwrap();
        store.note_captures(&[(content, &folder)]);
        assert!(!mark.exists(), "one look, and no more");
        // Another folder with the same content, and both.
        let other = place.path().join("other");
        store.note_captures(&[(content, &folder), (content, &other)]);
        assert_eq!(store.folders_of(content).len(), 2);
        forget(&store, &folder).unwrap();
        assert_eq!(store.folders_of(content), [other.display().to_string()]);
        store.note_captures(&[(content, &folder), (content, &other)]);
        assert_eq!(store.folders_of(content).len(), 2);
    }
}
