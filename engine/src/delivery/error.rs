//! Why results cannot be delivered.

use stage::{Coded, Message, message};
use std::path::PathBuf;
use system::text::shown;

stage::messages! {
    DISK = "cli-out-disk": "{path}: {why}";
    LINK = "cli-out-link": "{path} is a link, and nothing is written through a link; remove it, or give another folder";
    NO_FOLDER = "cli-out-no-folder": "{path} is no folder; give another with --out";
    NO_NAME = "cli-out-name": "{path} is no name of a file in a folder of results";
}

/// Why results cannot be delivered.
#[derive(Debug, thiserror::Error)]
pub enum DeliveryError {
    /// The disk refuses.
    #[error("{}", self.message())]
    Disk {
        /// The file.
        path: PathBuf,
        /// The system's error.
        why: std::io::Error,
    },
    /// A folder that is a link.
    #[error("{}", self.message())]
    Link(PathBuf),
    /// Something else where a folder is wanted.
    #[error("{}", self.message())]
    NoFolder(PathBuf),
    /// A file that would be elsewhere.
    #[error("{}", self.message())]
    Name(PathBuf),
}

impl Coded for DeliveryError {
    fn message(&self) -> Message {
        match self {
            Self::Disk { path, why } => message!(DISK, path = shown(path), why = why.to_string()),
            Self::Link(path) => message!(LINK, path = shown(path)),
            Self::NoFolder(path) => message!(NO_FOLDER, path = shown(path)),
            Self::Name(path) => message!(NO_NAME, path = shown(path)),
        }
    }
}
