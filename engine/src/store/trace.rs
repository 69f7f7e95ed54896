//! What came of a folder: its captures by where they lay, and by the files that lie there now, so that one that was
//! moved is found, too.

use super::captures::Note;
use super::folder::Store;
use crate::own::{self, whole};
use crate::past;
use crate::source::Memo;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// What in a store came of a folder.
#[derive(Debug, Default)]
pub struct Trace {
    /// The folder, and where it lay before.
    pub(super) folders: Vec<PathBuf>,
    /// The contents of its captures, hexadecimal.
    pub(super) seeds: BTreeSet<String>,
    /// Their notes in the order in which they go, and what of each stays: other folders that are there.
    pub(super) notes: Vec<(String, Option<Note>)>,
    /// Contents of other captures that stay, with their folders.
    pub(super) others: BTreeMap<String, Vec<String>>,
    /// Files in the folder that cannot be read.
    pub(super) unread: Vec<PathBuf>,
    /// The hashes of its files, hexadecimal.
    here: BTreeSet<String>,
    /// Folders of links to its files.
    linked: BTreeSet<String>,
}

/// A plan's inputs: as much as is read of it here.
#[derive(serde::Deserialize)]
struct Plan {
    inputs: Vec<Input>,
}

#[derive(serde::Deserialize)]
struct Input {
    folder: String,
    #[serde(default)]
    files: Vec<(String, String, u64)>,
}

impl Trace {
    /// Whether a path is the folder, or lies in it, or did before it was moved.
    pub(super) fn has(&self, path: &str) -> bool {
        let path = Path::new(path);
        self.folders.iter().any(|folder| path.starts_with(folder))
    }

    /// Whether these are the folder's files: half of them or more lie in it, or they are half of what lies in it. A
    /// plate or a `capture.toml` that captures share makes none of them the other.
    fn is_of(&self, files: &[String]) -> bool {
        let files: BTreeSet<&String> = files.iter().collect();
        let both = files.iter().filter(|f| self.here.contains(**f)).count();
        both > 0 && (2 * both >= files.len() || 2 * both >= self.here.len())
    }

    /// Whether a plan's file names the folder or its files; `None` if it is not the plan of its name, or none that can be
    /// read.
    pub(super) fn is_in_plan(&self, name: &str, plan: &[u8]) -> Option<bool> {
        if stage::hash(plan).to_hex().as_str() != name {
            return None;
        }
        let plan: Plan = serde_json::from_slice(plan).ok()?;
        let of = |input: &Input| {
            let hashes: Vec<String> = input
                .files
                .iter()
                .map(|(_, hash, _)| hash.clone())
                .collect();
            // In a folder that is there, they are somebody's of their own.
            let alone = Path::new(&input.folder).exists() && !self.linked.contains(&input.folder);
            self.has(&input.folder) || (!alone && self.is_of(&hashes))
        };
        Some(plan.inputs.iter().any(of))
    }

    /// What is remembered of files, without the folder's own; and whether any were.
    pub(super) fn memo(&self, store: &Store) -> (Vec<u8>, bool) {
        let memo = Memo::load(&store.root().join("files.json"));
        let mine = |path: &Path, content: &str| {
            self.has(&path.display().to_string()) || (self.here.contains(content) && !path.exists())
        };
        let count = memo.len();
        let memo = memo.without(mine);
        (memo.bytes(), memo.len() < count)
    }
}

/// The plain files in a folder and below it, links to files among them; without what lies in `but`.
fn below(folder: &Path, but: &Path) -> Vec<PathBuf> {
    let (mut open, mut found) = (vec![folder.to_owned()], Vec::new());
    while let Some(path) = open.pop() {
        for entry in std::fs::read_dir(&path).into_iter().flatten().flatten() {
            let path = entry.path();
            match entry.file_type() {
                Ok(kind) if kind.is_dir() => open.extend((path != but).then_some(path)),
                _ => found.extend(path.is_file().then_some(path)),
            }
        }
    }
    found
}

/// Whether a folder has links to files in another.
fn leads(from: &Path, to: &Path) -> bool {
    let mut links = below(from, to).into_iter().filter(|path| path.is_symlink());
    links.any(|path| path.canonicalize().is_ok_and(|real| real.starts_with(to)))
}

/// Files of inputs that records of runs tell: the folder, and the hashes.
fn told_by_runs(root: &Path) -> Vec<(String, Vec<String>)> {
    let mut told = Vec::new();
    for id in past::ids(root) {
        let Some((head, lists)) = past::head(root, &id).zip(past::file_lists(root, &id)) else {
            continue;
        };
        for (input, files) in lists {
            if let Some(folder) = head.of.inputs.get(&input) {
                let hashes = files.into_iter().map(|(_, hash)| hash).collect();
                told.push((folder.clone(), hashes));
            }
        }
    }
    told
}

impl Store {
    /// What here came of a folder, which may be gone.
    pub fn trace(&self, folder: &Path) -> Trace {
        let (real, said) = (whole(folder), std::path::absolute(folder));
        let mut trace = Trace::default();
        trace.folders.push(real.clone());
        let notes = self.notes();
        if let Some(said) = said.ok().filter(|said| !said.exists() && *said != real) {
            trace.folders.push(said);
        }
        if !real.exists() {
            let links = notes.iter().filter_map(|(_, note)| match note {
                Some(Note::Link { link, to }) if trace.has(link) => Some(PathBuf::from(to)),
                _ => None,
            });
            let links: Vec<PathBuf> = links.collect();
            trace.folders.extend(links);
        }
        let store = whole(self.root());
        for path in below(&real, &store) {
            let mut hasher = blake3::Hasher::new();
            let read = std::fs::File::open(&path).and_then(|f| hasher.update_reader(f).map(|_| ()));
            match read {
                Ok(()) => _ = trace.here.insert(hasher.finalize().to_hex().to_string()),
                Err(_) => trace.unread.push(path),
            }
        }
        // Where the same files lay: gone since, they were moved; there, they are somebody's of their own.
        let told = told_by_runs(self.root());
        let alike = told.iter().filter(|(_, files)| trace.is_of(files));
        let mut alike: BTreeSet<String> = alike.map(|(folder, _)| folder.clone()).collect();
        let noted = notes.iter().filter_map(|(_, note)| note.as_ref());
        for note in noted.filter(|note| trace.is_of(note.files())) {
            alike.extend(note.folders().iter().cloned());
        }
        let (there, moved): (Vec<String>, Vec<String>) =
            alike.into_iter().partition(|f| Path::new(f).exists());
        trace.folders.extend(moved.iter().map(PathBuf::from));
        let linked = there.into_iter().filter(|f| leads(Path::new(f), &real));
        trace.linked = linked.collect();
        // What leads to other notes goes after them, when all goes: notes of these files, and links.
        let rank = |note: &Option<Note>| match note {
            Some(Note::Link { .. }) => 2,
            Some(note) => u8::from(trace.is_of(note.files())),
            None => 0,
        };
        let mut notes = notes;
        notes.sort_by_cached_key(|(_, note)| rank(note));
        for (name, note) in notes {
            trace.sort_in(name, note);
        }
        trace
    }
}

impl Trace {
    /// Whether a note is one of the folder's; one that cannot be read may be.
    fn sort_in(&mut self, name: String, note: Option<Note>) {
        let (folders, files) = match note {
            None => (vec![], vec![]),
            Some(Note::Link { link, to }) => {
                if self.has(&link) || self.has(&to) {
                    self.notes.push((name, None));
                }
                return;
            }
            Some(note) => (note.folders().to_vec(), note.files().to_vec()),
        };
        let unread = folders.is_empty();
        let (mine, theirs): (Vec<String>, Vec<String>) =
            folders.into_iter().partition(|folder| self.has(folder));
        let linked = theirs.iter().any(|folder| self.linked.contains(folder));
        let same = linked && (files.is_empty() || self.is_of(&files));
        if !mine.is_empty() || same || unread {
            self.seeds.insert(name.clone());
            let stays = (!theirs.is_empty()).then(|| Note::Capture {
                folders: theirs.clone(),
                files,
            });
            if !mine.is_empty() || unread {
                self.notes.push((name.clone(), stays));
            }
        }
        if !theirs.is_empty() {
            self.others.insert(name, theirs);
        }
    }
}

/// The names of all notes of captures, hexadecimal: contents of inputs that somebody accounts for.
pub(super) fn accounted(store: &Store) -> BTreeSet<String> {
    let names = own::files(store.root(), super::captures::FOLDER, own::is_hash);
    names.into_iter().collect()
}
