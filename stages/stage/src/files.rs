//! What the user hands over: names and content hashes, with the folder outside of the key.

use crate::{Artifact, Corrupt, Hash, Packer, Unpacker};
use std::path::PathBuf;

/// One file of the user's.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FileEntry {
    /// Its name relative to the folder, with `/` between parts.
    pub name: String,
    /// The hash of its bytes.
    pub content: Hash,
    /// Its size. \[bytes\]
    pub size: u64,
}

/// A folder's files, in natural order of their names (`2.jpg` before `10.jpg`).
#[derive(Debug, Clone, Default)]
pub struct Files {
    /// Where they are on this machine; no part of the content.
    pub root: PathBuf,
    /// The files.
    pub entries: Vec<FileEntry>,
}

/// A file that cannot be read as it was when the run began.
#[derive(Debug, thiserror::Error)]
pub enum FilesError {
    /// It is gone, or may not be read.
    #[error("cannot read {path}: {why}; put it back or make it readable, then run again")]
    Unreadable {
        /// The file.
        path: String,
        /// The system's message.
        why: std::io::Error,
    },
    /// Its bytes are not those that the run began with.
    #[error("{path} changed while the run was reading it; run again once it no longer changes")]
    Changed {
        /// The file.
        path: String,
    },
}

impl Files {
    /// The file's bytes, if they still are what was hashed when the run began.
    ///
    /// # Errors
    ///
    /// The file cannot be read, or is no longer what was hashed.
    pub fn read(&self, entry: &FileEntry) -> Result<Vec<u8>, FilesError> {
        let path = self.root.join(&entry.name);
        let shown = || path.display().to_string();
        let bytes =
            std::fs::read(&path).map_err(|why| FilesError::Unreadable { path: shown(), why })?;
        if blake3::hash(&bytes) != entry.content {
            return Err(FilesError::Changed { path: shown() });
        }
        Ok(bytes)
    }

    /// Where the file is, if its bytes still are what was hashed when the run began; they are never
    /// read whole. For foreign programs, which read it themselves: ask again when they are done.
    ///
    /// # Errors
    ///
    /// As [`Files::read`].
    pub fn path(&self, entry: &FileEntry) -> Result<PathBuf, FilesError> {
        let path = self.root.join(&entry.name);
        let shown = || path.display().to_string();
        let hash = |file: std::fs::File| -> std::io::Result<Hash> {
            Ok(blake3::Hasher::new().update_reader(file)?.finalize())
        };
        let content = std::fs::File::open(&path).and_then(hash);
        match content.map_err(|why| FilesError::Unreadable { path: shown(), why })? == entry.content
        {
            true => Ok(path),
            false => Err(FilesError::Changed { path: shown() }),
        }
    }
}

impl Artifact for Files {
    const KIND: &'static str = "files";
    const FORMAT: u32 = 1;

    fn pack(&self, to: &mut Packer) {
        let entries: Vec<_> = self
            .entries
            .iter()
            .map(|e| (&e.name, e.content.as_bytes(), e.size))
            .collect();
        to.meta(&entries);
    }

    fn unpack(from: &Unpacker<'_>) -> Result<Self, Corrupt> {
        let entries: Vec<(String, [u8; 32], u64)> = from.meta()?;
        let entry = |(name, hash, size)| FileEntry {
            name,
            content: Hash::from_bytes(hash),
            size,
        };
        Ok(Files {
            root: PathBuf::new(),
            entries: entries.into_iter().map(entry).collect(),
        })
    }
}
