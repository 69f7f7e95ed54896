//! A store that cannot be used.

use stage::{Coded, Message, message};
use std::path::PathBuf;
use system::text::shown;

stage::messages! {
    DISK = "cli-cache-disk": "the cache at {path}: {why}; free space or make it writable, or give another with --cache";
    FORMAT = "cli-cache-format": "the cache at {root} has another layout ({found}): another version of the program made it, use that or give another folder with --cache";
    STRANGE = "cli-cache-strange": "{root} is not empty and is no cache ({strange} is not of one): nothing was written; give another folder, or an empty one, with --cache";
}

/// A store that cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum StoreError {
    /// The disk refuses.
    #[error("{}", self.message())]
    Disk {
        /// The file or folder.
        path: PathBuf,
        /// The system's error.
        why: std::io::Error,
    },
    /// Written by another version of the program.
    #[error("{}", self.message())]
    Format {
        /// The store.
        root: PathBuf,
        /// The layout that it names.
        found: String,
    },
    /// Somebody else's folder.
    #[error("{}", self.message())]
    Strange {
        /// The folder.
        root: PathBuf,
        /// What no store has.
        strange: PathBuf,
    },
    /// A folder of the store that is elsewhere.
    #[error("{} is a link, and nothing is removed through a link: nothing was removed; put the folder itself there", .0.display())]
    Link(PathBuf),
    /// The store that machines share.
    #[error("the store {name}: {why}")]
    Shared {
        /// What the user calls it.
        name: String,
        /// What is wrong, and what to do about it.
        why: String,
    },
    /// What was to be removed is still there.
    #[error("{} could not be removed: is it in use, or not yours? What is known of it stays; give the command again when that is mended", .0.display())]
    Left(PathBuf),
    /// Not to be swept now.
    #[error("a run or an upload is using the cache at {}: nothing was removed; give the command again when it is done", .0.display())]
    Busy(PathBuf),
}

impl Coded for StoreError {
    fn message(&self) -> Message {
        match self {
            StoreError::Disk { path, why } => {
                message!(DISK, path = shown(path), why = why.to_string())
            }
            StoreError::Format { root, found } => {
                message!(FORMAT, root = shown(root), found = found)
            }
            StoreError::Strange { root, strange } => {
                message!(STRANGE, root = shown(root), strange = shown(strange))
            }
            rest => rest.to_string().into(),
        }
    }
}
