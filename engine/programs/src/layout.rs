//! The folder of a program that runs, and in it a new one for each job: the program's files, what it reads,
//! what it writes. For the owner only; gone when the program has ended.
//!
//! What the program may write to is entered once and kept open: whatever it puts in its place is not gone to.

use crate::error::ForeignError;
use crate::leftover::{FOLDER, LOCK, remove, remove_program};
use crate::places::{ETC, READ, SHM, TAKEN, TMP, WORK, WRITE};
use crate::pretended::is_killed;
use crate::program::Script;
use crate::sandbox;
use stage::Files;
use std::borrow::Cow;
use std::fs::File;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use system::pattern::stays_inside;
use system::{Folder, Use, can_start, nofollow, numbered, permit, private_folder};

/// The folder. Its path is in nothing that lasts.
pub(crate) struct Layout {
    root: PathBuf,
    jobs: AtomicU64,
    /// Locked while the program may run: other machines share the store, and know none of its processes.
    _lock: File,
}

/// A job's folders in it.
pub(crate) struct Job {
    layout: Arc<Layout>,
    number: String,
    /// Where results are, whatever is called so by now.
    results: Folder,
}

const OUT: &str = "out";

fn at(path: &Path) -> impl FnOnce(std::io::Error) -> ForeignError + '_ {
    move |why| ForeignError::Folder {
        path: path.into(),
        why,
    }
}

fn folder(path: &Path) -> Result<(), ForeignError> {
    private_folder(path, true).map_err(at(path))
}

/// A file that nobody writes to by mistake.
fn put(path: &Path, bytes: &[u8], what: Use) -> Result<(), ForeignError> {
    if let Some(above) = path.parent() {
        folder(above)?;
    }
    std::fs::write(path, bytes).map_err(at(path))?;
    permit(path, what).map_err(at(path))
}

/// A folder's lock, which has its name only once it is locked: whoever finds one that is not, finds what was left.
fn locked(folder: &Path) -> std::io::Result<File> {
    let path = folder.join("new-lock");
    let file = File::create(&path)?;
    file.lock()?;
    std::fs::rename(&path, folder.join(LOCK))?;
    Ok(file)
}

impl Layout {
    /// A new one in a store's folder.
    pub(crate) fn new(store: &Path) -> Result<Layout, ForeignError> {
        static COUNT: AtomicU64 = AtomicU64::new(0);
        let name = numbered(COUNT.fetch_add(1, Ordering::Relaxed));
        let root = store.join(FOLDER).join(name);
        folder(&root)?;
        let lock = locked(&root);
        let layout = Layout {
            _lock: lock.map_err(at(&root.join(LOCK)))?,
            jobs: AtomicU64::new(0),
            root,
        };
        for inner in [READ, WRITE, WORK, TMP, SHM] {
            folder(&layout.root.join(inner))?;
        }
        // Whoever runs is called alike, and has no home.
        let (user, group) = system::user();
        let work = sandbox::shown(&layout.root, &layout.root.join(WORK));
        let account = format!("program:x:{user}:{group}::{}:/bin/sh\n", work.display());
        put(
            &layout.root.join(ETC).join("passwd"),
            account.as_bytes(),
            Use::Read,
        )?;
        let group = format!("program:x:{group}:\n");
        put(
            &layout.root.join(ETC).join("group"),
            group.as_bytes(),
            Use::Read,
        )?;
        Ok(layout)
    }
}

impl Layout {
    /// The folder that all programs' folders are in, and its name there.
    fn named(&self) -> Option<(&Path, Cow<'_, str>)> {
        let name = self.root.file_name()?;
        Some((self.root.parent()?, name.to_string_lossy()))
    }
}

impl Job {
    /// New folders for a job.
    pub(crate) fn new(layout: &Arc<Layout>) -> Result<Job, ForeignError> {
        let number = (layout.jobs.fetch_add(1, Ordering::Relaxed) + 1).to_string();
        let read = layout.root.join(READ).join(&number);
        for inner in ["here", "in"] {
            folder(&read.join(inner))?;
        }
        let write = layout.root.join(WRITE);
        let fresh = || {
            // What the job before left where the program works.
            nofollow::empty(&nofollow::folder(&layout.root, &[WORK])?)?;
            let write = nofollow::folder(&layout.root, &[WRITE])?;
            nofollow::fresh(&nofollow::fresh(&write, &number)?, OUT)
        };
        let results = fresh().map_err(at(&write))?;
        Ok(Job {
            layout: layout.clone(),
            number,
            results,
        })
    }

    /// The program's whole folder.
    pub(crate) fn root(&self) -> &Path {
        &self.layout.root
    }

    /// Where the program sees what is in its folder.
    pub(crate) fn shown(&self, path: &Path) -> PathBuf {
        sandbox::shown(&self.layout.root, path)
    }

    fn read(&self) -> PathBuf {
        self.layout.root.join(READ).join(&self.number)
    }

    /// Copies of the program's files.
    pub(crate) fn here(&self) -> PathBuf {
        self.read().join("here")
    }

    /// What it reads.
    pub(crate) fn inputs(&self) -> PathBuf {
        self.read().join("in")
    }

    /// Where results are.
    pub(crate) fn results(&self) -> PathBuf {
        self.layout.root.join(WRITE).join(&self.number).join(OUT)
    }

    /// The same, as it was made.
    pub(crate) fn made(&self) -> &Folder {
        &self.results
    }

    /// Whether results still are where they should.
    pub(crate) fn in_place(&self) -> bool {
        let there = nofollow::folder(&self.layout.root, &[WRITE, &self.number, OUT]);
        there.is_ok_and(|there| nofollow::same(&there, &self.results))
    }

    /// A folder for results out of the program's reach.
    pub(crate) fn taken(&self) -> Result<PathBuf, ForeignError> {
        let path = self.layout.root.join(TAKEN).join(&self.number);
        folder(&path).map(|()| path)
    }

    /// Copies the program's files, as they were when the pipeline was read.
    pub(crate) fn files(&self, files: &[Script]) -> Result<(), ForeignError> {
        for file in files {
            let bytes = std::fs::read(&file.path).map_err(at(&file.path))?;
            if stage::hash(&bytes) != file.content {
                return Err(ForeignError::Changed(file.path.clone()));
            }
            let meta = std::fs::metadata(&file.path).map_err(at(&file.path))?;
            let what = match can_start(&meta) {
                true => Use::Start,
                false => Use::Read,
            };
            put(&self.here().join(&file.name), &bytes, what)?;
        }
        Ok(())
    }

    /// A user's files, in a folder of the port's name.
    pub(crate) fn user_files(&self, port: &str, files: &Files) -> Result<PathBuf, ForeignError> {
        let path = self.inputs().join(port);
        folder(&path)?;
        for entry in &files.entries {
            let bytes = files.read(entry).map_err(|why| ForeignError::Input {
                port: port.into(),
                why: why.to_string(),
            })?;
            put(&path.join(&entry.name), &bytes, Use::Read)?;
        }
        Ok(path)
    }

    /// An artifact's files: one nameless file with an ending, or several in a folder.
    pub(crate) fn written(
        &self,
        name: &str,
        extension: &str,
        files: &[(String, Vec<u8>)],
    ) -> Result<PathBuf, ForeignError> {
        if let [(nameless, bytes)] = files
            && nameless.is_empty()
        {
            let path = self.inputs().join(format!("{name}.{extension}"));
            put(&path, bytes, Use::Read)?;
            return Ok(path);
        }
        let path = self.inputs().join(name);
        folder(&path)?;
        for (file, bytes) in files {
            if file.is_empty() || !stays_inside(file) {
                let why = format!("{file:?} is no name of a file");
                let port = name.to_owned();
                return Err(ForeignError::Input { port, why });
            }
            put(&path.join(file), bytes, Use::Read)?;
        }
        Ok(path)
    }
}

impl Drop for Job {
    fn drop(&mut self) {
        if let Some((all, name)) = self.layout.named().filter(|_| !is_killed()) {
            for inner in [READ, WRITE, TAKEN] {
                remove(all, &[&name, inner], &self.number);
            }
        }
    }
}

impl Drop for Layout {
    fn drop(&mut self) {
        if let Some((all, name)) = self.named().filter(|_| !is_killed()) {
            remove_program(all, &name);
        }
    }
}

#[cfg(test)]
#[path = "layout_tests.rs"]
mod tests;
