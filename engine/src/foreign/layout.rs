//! The folder of a program that runs: its files, what it reads, what it writes, and room to work.
//! For the owner only; gone when the program has ended.

use super::error::ForeignError;
use super::leftover::{FOLDER, LOCK, remove};
use super::program::Script;
use crate::pattern::stays_inside;
use crate::system::{Use, can_start, permit, private_folder};
use stage::Files;
use std::fs::File;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

/// The folder. Its path is in nothing that lasts.
pub(super) struct Layout {
    root: PathBuf,
    /// Held while the program may run: other machines share the store, and know none of its processes.
    _lock: File,
}

/// Its folders.
const INNER: [&str; 4] = ["here", "in", "out", "work"];

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

impl Layout {
    /// A new one in a store's folder.
    pub(super) fn new(store: &Path) -> Result<Layout, ForeignError> {
        static COUNT: AtomicU64 = AtomicU64::new(0);
        let (id, now) = (std::process::id(), crate::clock::now_ns());
        let count = COUNT.fetch_add(1, Ordering::Relaxed);
        let root = store.join(FOLDER).join(format!("{id}-{count}-{now:x}"));
        folder(&root)?;
        let path = root.join(LOCK);
        let lock = File::create(&path).and_then(|file| file.lock().map(|()| file));
        let _lock = lock.map_err(at(&path))?;
        let layout = Layout { root, _lock };
        for inner in INNER {
            folder(&layout.root.join(inner))?;
        }
        Ok(layout)
    }

    /// Empties its folders for the next job.
    pub(super) fn emptied(&self) -> Result<(), ForeignError> {
        for inner in INNER {
            let inner = self.root.join(inner);
            for entry in std::fs::read_dir(&inner).map_err(at(&inner))? {
                let path = entry.map_err(at(&inner))?.path();
                match std::fs::symlink_metadata(&path).is_ok_and(|m| m.is_dir()) {
                    true => remove(&path),
                    false => std::fs::remove_file(&path).map_err(at(&path))?,
                }
            }
        }
        Ok(())
    }

    /// All of it.
    pub(super) fn root(&self) -> &Path {
        &self.root
    }

    /// Copies of the program's files.
    pub(super) fn here(&self) -> PathBuf {
        self.root.join("here")
    }

    /// What it reads.
    pub(super) fn inputs(&self) -> PathBuf {
        self.root.join("in")
    }

    /// Where results lie.
    pub(super) fn results(&self) -> PathBuf {
        self.root.join("out")
    }

    /// Copies the program's files, as they were when the pipeline was read.
    pub(super) fn files(&self, files: &[Script]) -> Result<(), ForeignError> {
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
    pub(super) fn user_files(&self, port: &str, files: &Files) -> Result<PathBuf, ForeignError> {
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
    pub(super) fn written(
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

impl Drop for Layout {
    fn drop(&mut self) {
        remove(&self.root);
    }
}
