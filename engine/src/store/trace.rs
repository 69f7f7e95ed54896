//! What came of a folder: its captures by where they lay, and by the files that are there now, so that one that was
//! moved is found, too.

use super::captures::Note;
use super::error::StoreError;
use super::files::at;
use super::folder::Store;
use crate::own::{self, whole};
use crate::past;
use crate::source::Memo;
use std::collections::{BTreeMap, BTreeSet};
use std::fs::Metadata;
use std::io::{Error, Result};
use std::path::{Path, PathBuf};
use system::nofollow;

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
    pub(super) remaining: BTreeMap<String, Vec<String>>,
    /// Files in the folder that cannot be read, and folders in which there may be links to them.
    pub(super) unread: Vec<PathBuf>,
    /// How many notes could not be read.
    pub(super) broken: usize,
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
    /// Whether a path is the folder, or is in it, or did before it was moved.
    pub(super) fn has(&self, path: &str) -> bool {
        let path = Path::new(path);
        self.folders.iter().any(|folder| path.starts_with(folder))
    }

    /// Whether these are the folder's files: half of them or more are in it, or they are half of what is in it. A
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

    /// Whether the record of a run names the folder or its files; `None` if it cannot be read.
    ///
    /// # Errors
    ///
    /// The disk refuses.
    pub(super) fn is_in_run(&self, root: &Path, id: &str) -> Result<Option<bool>> {
        let Some(head) = past::read_head(root, id)? else {
            return Ok(None);
        };
        // Bits may flip in what it calls the folder, since that was traced.
        let of = |(folder, files): &(String, Vec<String>)| {
            !Path::new(folder).exists() && self.is_of(files)
        };
        let named = head.of.inputs.values().any(|input| self.has(input));
        Ok(Some(named || files_of_run(root, id, &head)?.iter().any(of)))
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

/// What there is of a path; `None` if nothing is there, or it is a link that leads nowhere.
fn kind(path: &Path) -> Result<Option<Metadata>> {
    match std::fs::metadata(path) {
        Err(why) if nofollow::is_absent(&why) => Ok(None),
        meta => meta.map(Some),
    }
}

/// The plain files in a folder and below it, links to files among them; without what is in `but`. What cannot be read
/// is added to `unread`.
fn below(folder: &Path, but: &Path, unread: &mut Vec<PathBuf>) -> Vec<PathBuf> {
    let (mut open, mut found) = (vec![folder.to_owned()], Vec::new());
    while let Some(path) = open.pop() {
        let mut look = || {
            for entry in std::fs::read_dir(&path)? {
                let (path, kind) = entry.and_then(|e| Ok((e.path(), e.file_type()?)))?;
                match kind.is_dir() {
                    true => open.extend((path != but).then_some(path)),
                    false if self::kind(&path)?.is_some_and(|meta| meta.is_file()) => {
                        found.push(path);
                    }
                    false => {}
                }
            }
            Ok::<(), Error>(())
        };
        match look() {
            Err(why) if !nofollow::is_absent(&why) => unread.push(path),
            _ => {}
        }
    }
    found
}

/// Whether a folder has links to files in another; what cannot be read is added to `unread`.
fn leads(from: &Path, to: &Path, unread: &mut Vec<PathBuf>) -> bool {
    for path in below(from, to, unread) {
        match path.canonicalize() {
            Ok(real) if real.starts_with(to) => return true,
            Err(why) if !nofollow::is_absent(&why) => unread.push(path),
            _ => {}
        }
    }
    false
}

/// Files of inputs that records of runs have: the folder, and the hashes.
fn files_of_runs(root: &Path) -> Result<Vec<(String, Vec<String>)>> {
    let mut all = Vec::new();
    for id in past::all_ids(root)? {
        if let Some(head) = past::read_head(root, &id)? {
            all.extend(files_of_run(root, &id, &head)?);
        }
    }
    Ok(all)
}

/// The same of one of them.
fn files_of_run(root: &Path, id: &str, head: &past::Head) -> Result<Vec<(String, Vec<String>)>> {
    let lists = past::read_file_lists(root, id, head)?.unwrap_or_default();
    let of = |(input, files): (String, Vec<(String, String)>)| {
        let hashes = files.into_iter().map(|(_, hash)| hash).collect();
        Some((head.of.inputs.get(&input)?.clone(), hashes))
    };
    Ok(lists.into_iter().filter_map(of).collect())
}

impl Store {
    /// What here came of a folder, which may be gone.
    ///
    /// # Errors
    ///
    /// The disk refuses: then nobody knows what did.
    pub fn trace(&self, folder: &Path) -> std::result::Result<Trace, StoreError> {
        let (real, answer) = (whole(folder), std::path::absolute(folder));
        let mut trace = Trace::default();
        trace.folders.push(real.clone());
        let notes = self.notes()?;
        if let Some(answer) = answer
            .ok()
            .filter(|answer| !answer.exists() && *answer != real)
        {
            trace.folders.push(answer);
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
        for path in below(&real, &store, &mut trace.unread) {
            let mut hasher = blake3::Hasher::new();
            let read = std::fs::File::open(&path).and_then(|f| hasher.update_reader(f).map(|_| ()));
            match read {
                Ok(()) => _ = trace.here.insert(hasher.finalize().to_hex().to_string()),
                Err(_) => trace.unread.push(path),
            }
        }
        // Where the same files lay: gone since, they were moved; there, they are somebody's of their own.
        let of_runs = files_of_runs(self.root()).map_err(at(&self.root().join("runs")))?;
        let alike = of_runs.iter().filter(|(_, files)| trace.is_of(files));
        let mut alike: BTreeSet<String> = alike.map(|(folder, _)| folder.clone()).collect();
        let noted = notes.iter().filter_map(|(_, note)| note.as_ref());
        for note in noted.filter(|note| trace.is_of(note.files())) {
            alike.extend(note.folders().iter().cloned());
        }
        let (there, moved): (Vec<String>, Vec<String>) =
            alike.into_iter().partition(|f| Path::new(f).exists());
        trace.folders.extend(moved.iter().map(PathBuf::from));
        for folder in there {
            if leads(Path::new(&folder), &real, &mut trace.unread) {
                trace.linked.insert(folder);
            }
        }
        // What leads to other notes goes after them, when all goes: notes of these files, and links.
        let rank = |note: &Option<Note>| match note {
            Some(Note::Link { .. }) => 2,
            Some(note) => u8::from(trace.is_of(note.files())),
            None => 0,
        };
        let mut notes = notes;
        notes.sort_by_cached_key(|(_, note)| rank(note));
        for (name, note) in notes {
            trace.broken += usize::from(note.is_none());
            trace.sort_in(name, note);
        }
        Ok(trace)
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
            self.remaining.insert(name, theirs);
        }
    }
}

/// The names of all notes of captures, hexadecimal: contents of inputs that somebody accounts for.
///
/// # Errors
///
/// They cannot be listed.
pub(super) fn accounted(store: &Store) -> std::result::Result<BTreeSet<String>, StoreError> {
    let names = store.files(super::captures::FOLDER, own::is_hash)?;
    Ok(names.into_iter().collect())
}
