//! A disk that fails at a step, and one that loses power: what of a store may be left.
//!
//! Steps are done on the real disk, but for its syncs, and written down. [`after_loss`] replays the first of them in memory
//! and lets go of what POSIX does not promise: bytes that were not synced are there, torn, zeros or
//! missing; each change of a name that was not synced with its folder is there or not, by itself, so
//! that changes come in any order and a renamed file may have both names or none.

use super::disk::{Disk, Real};
use proof::Dice;
pub(crate) use proof::in_memory;
use std::collections::BTreeMap;
use std::fs::File;
use std::io::{Error, ErrorKind, Result};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};

/// A step that was done.
#[derive(Debug, Clone)]
pub(crate) enum Step {
    Folder(PathBuf),
    Create(PathBuf),
    Write(PathBuf, Vec<u8>),
    Sync(PathBuf),
    Rename(PathBuf, PathBuf),
    Link(PathBuf, PathBuf),
    SyncNames(PathBuf),
    Remove(PathBuf),
}

/// The steps of a disk since it was last known what is on it.
pub(crate) type Steps = Arc<Mutex<Vec<Step>>>;

/// Whose disk it is: what happens before a step.
pub(crate) trait User: Send + Sync {
    /// Whether the step is done; one that `grows` takes space.
    fn step(&self, grows: bool) -> Result<()>;
    /// Whether the next step is the last, or fails.
    fn ends_next(&self) -> bool;
}

/// The real disk with its steps counted and written down.
#[derive(Clone, Default)]
pub(crate) struct Simulated<U> {
    pub(crate) user: U,
    pub(crate) steps: Steps,
}

impl<U: User> Simulated<U> {
    fn step<T>(&self, step: Step, grows: bool, real: impl FnOnce() -> Result<T>) -> Result<T> {
        self.user.step(grows)?;
        let done = real()?;
        self.note(step);
        Ok(done)
    }

    fn note(&self, step: Step) {
        self.steps.lock().expect("no panic").push(step);
    }
}

impl<U: User> Disk for Simulated<U> {
    fn folder(&self, path: &Path) -> Result<()> {
        self.step(Step::Folder(path.into()), true, || Real.folder(path))
    }
    fn create(&self, path: &Path) -> Result<File> {
        self.step(Step::Create(path.into()), true, || Real.create(path))
    }
    fn write(&self, file: &mut File, path: &Path, bytes: &[u8]) -> Result<()> {
        if self.user.ends_next() {
            // Torn: what fails may have written half.
            let half = &bytes[..bytes.len() / 2];
            Real.write(file, path, half)?;
            self.note(Step::Write(path.into(), half.to_vec()));
        }
        let step = Step::Write(path.into(), bytes.to_vec());
        self.step(step, true, || Real.write(file, path, bytes))
    }
    fn sync(&self, _: &File, path: &Path) -> Result<()> {
        self.step(Step::Sync(path.into()), false, || Ok(()))
    }
    fn rename(&self, from: &Path, to: &Path) -> Result<()> {
        let step = Step::Rename(from.into(), to.into());
        self.step(step, false, || Real.rename(from, to))
    }
    fn link(&self, from: &Path, to: &Path) -> Result<()> {
        let step = Step::Link(from.into(), to.into());
        self.step(step, true, || Real.link(from, to))
    }
    fn sync_names(&self, folder: &Path) -> Result<()> {
        self.step(Step::SyncNames(folder.into()), false, || Ok(()))
    }
    fn remove(&self, path: &Path) -> Result<()> {
        self.step(Step::Remove(path.into()), false, || Real.remove(path))
    }
    fn unlink(&self, root: &Path, folders: &[&str], name: &str) -> bool {
        let path = folders.iter().fold(root.to_owned(), |at, f| at.join(f));
        let path = path.join(name);
        if !path.is_file() {
            return false;
        }
        let removed = self.step(Step::Remove(path), false, || {
            match Real.unlink(root, folders, name) {
                true => Ok(()),
                false => Err(Error::from(ErrorKind::NotFound)),
            }
        });
        removed.is_ok()
    }
}

/// What has a name.
#[derive(Debug, Clone, Copy)]
enum Entry {
    Folder,
    File(usize),
}

#[derive(Default)]
struct Content {
    written: Vec<u8>,
    synced: Vec<u8>,
}

/// The disk in memory: what was done, and what of it is safe.
#[derive(Default)]
struct Memory {
    files: Vec<Content>,
    /// Names as everybody sees them.
    names: BTreeMap<PathBuf, usize>,
    /// Names that outlive a loss.
    safe: BTreeMap<PathBuf, Entry>,
    /// Changes of names since their folder was synced.
    open: Vec<(PathBuf, Option<Entry>)>,
}

impl Memory {
    fn take(&mut self, step: &Step) {
        match step {
            Step::Folder(path) => self.open.push((path.clone(), Some(Entry::Folder))),
            Step::Create(path) => {
                self.files.push(Content::default());
                let file = self.files.len() - 1;
                self.names.insert(path.clone(), file);
                self.open.push((path.clone(), Some(Entry::File(file))));
            }
            Step::Write(path, bytes) => {
                if let Some(file) = self.names.get(path) {
                    self.files[*file].written.extend_from_slice(bytes);
                }
            }
            Step::Sync(path) => {
                if let Some(file) = self.names.get(path) {
                    let file = &mut self.files[*file];
                    file.synced = file.written.clone();
                }
            }
            Step::Rename(from, to) => {
                // Made by nobody who asks the disk in steps: not promised to be there.
                let Some(file) = self.names.remove(from) else {
                    return;
                };
                self.names.insert(to.clone(), file);
                self.open.push((to.clone(), Some(Entry::File(file))));
                self.open.push((from.clone(), None));
            }
            Step::Link(from, to) => {
                let Some(file) = self.names.get(from).copied() else {
                    return;
                };
                self.names.insert(to.clone(), file);
                self.open.push((to.clone(), Some(Entry::File(file))));
            }
            Step::SyncNames(folder) => {
                let open = std::mem::take(&mut self.open);
                let (safe, open) = open
                    .into_iter()
                    .partition(|(path, _)| path.parent() == Some(folder));
                self.open = open;
                self.keep(safe);
            }
            Step::Remove(path) => {
                self.names.remove(path);
                self.open.push((path.clone(), None));
            }
        }
    }

    fn keep(&mut self, changes: Vec<(PathBuf, Option<Entry>)>) {
        for (path, entry) in changes {
            match entry {
                Some(entry) => _ = self.safe.insert(path, entry),
                None => _ = self.safe.remove(&path),
            }
        }
    }
}

/// What a disk may have kept of a file.
fn left(file: &Content, dice: &mut Dice) -> Vec<u8> {
    if file.synced == file.written {
        return file.synced.clone();
    }
    let mut bytes = file.written.clone();
    let cut = dice.bits() as usize % (bytes.len() + 1);
    match dice.bits() % 5 {
        0 => bytes = file.synced.clone(),
        1 => bytes.truncate(cut),
        2 => bytes[cut..].fill(0),
        3 => bytes[..cut].fill(0),
        _ => {}
    }
    bytes
}

/// What may be left below `root` after these steps and a loss of power: folders (`None`) and files, each
/// after what it is in.
pub(crate) fn after_loss(
    steps: &[Step],
    root: &Path,
    dice: &mut Dice,
) -> Vec<(PathBuf, Option<Vec<u8>>)> {
    let mut memory = Memory::default();
    steps.iter().for_each(|step| memory.take(step));
    let share = dice.unit();
    let open = std::mem::take(&mut memory.open);
    let kept = open.into_iter().filter(|_| dice.unit() < share).collect();
    memory.keep(kept);
    let mut there: Vec<(PathBuf, Option<Vec<u8>>)> = vec![];
    for (path, entry) in &memory.safe {
        let above = path.parent().expect("bug: the root itself");
        let is_above =
            |(folder, file): &(PathBuf, Option<Vec<u8>>)| folder == above && file.is_none();
        if above == root || there.iter().any(is_above) {
            let file = match entry {
                Entry::Folder => None,
                Entry::File(file) => Some(left(&memory.files[*file], dice)),
            };
            there.push((path.clone(), file));
        }
    }
    there
}

/// Lays on the real disk below `at` what was left below `root`.
pub(crate) fn laid(left: &[(PathBuf, Option<Vec<u8>>)], root: &Path, at: &Path) {
    for (path, file) in left {
        let path = at.join(path.strip_prefix(root).expect("below the root"));
        match file {
            None => std::fs::create_dir(path).expect("a folder"),
            Some(bytes) => std::fs::write(path, bytes).expect("a file"),
        }
    }
}

/// All files below a folder, in their order.
pub(crate) fn below(folder: &Path) -> Vec<PathBuf> {
    let (mut open, mut found) = (vec![folder.to_owned()], vec![]);
    while let Some(path) = open.pop() {
        for entry in std::fs::read_dir(&path).into_iter().flatten().flatten() {
            match entry.file_type().is_ok_and(|kind| kind.is_dir()) {
                true => open.push(entry.path()),
                false => found.push(entry.path()),
            }
        }
    }
    found.sort();
    found
}
