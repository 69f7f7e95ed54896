//! A store that cannot be used.

use std::path::PathBuf;

/// A store that cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum StoreError {
    /// The disk refuses.
    #[error("the cache at {}: {why}; free space or make it writable, or give another with --cache", path.display())]
    Disk {
        /// The file or folder.
        path: PathBuf,
        /// The system's error.
        why: std::io::Error,
    },
    /// Written by another version of the program.
    #[error("the cache at {} has another layout ({found}): another version of the program made it, use that or give another folder with --cache", root.display())]
    Format {
        /// The store.
        root: PathBuf,
        /// The layout that it names.
        found: String,
    },
    /// Somebody else's folder.
    #[error(
        "{} is not empty and is no cache ({} is not of one): nothing was written; \
         give another folder, or an empty one, with --cache", root.display(), strange.display()
    )]
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
