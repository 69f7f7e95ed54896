//! Files of keys: read within bounds, and what is wrong with them.

use std::path::{Path, PathBuf};

/// What keys are of.
pub(crate) const METHOD: &str = "ed25519";

/// No file of keys is larger. \[bytes\]
const MOST: u64 = 1 << 20;

/// Why a file gives no key.
#[derive(Debug, thiserror::Error)]
pub enum NoKey {
    /// It cannot be read or written.
    #[error("{}: {why}", path.display())]
    Disk {
        /// The file.
        path: PathBuf,
        /// The system's error.
        why: std::io::Error,
    },
    /// Other users may read it.
    #[error("{}: other users may read this signing key: make a new one with `cache keygen`, or `chmod 600` it if nobody has", .0.display())]
    Open(PathBuf),
    /// It is none.
    #[error("{}: {what}", path.display())]
    Wrong {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        what: String,
    },
}

pub(crate) fn disk(path: &Path) -> impl FnOnce(std::io::Error) -> NoKey + '_ {
    move |why| NoKey::Disk {
        path: path.into(),
        why,
    }
}

/// A file of keys.
pub(crate) fn text(path: &Path) -> Result<String, NoKey> {
    let size = std::fs::metadata(path).map_err(disk(path))?.len();
    if size > MOST {
        let what = "is larger than any list of keys".into();
        let path = path.into();
        return Err(NoKey::Wrong { path, what });
    }
    std::fs::read_to_string(path).map_err(disk(path))
}

/// Bytes in hexadecimal.
pub(crate) fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

/// So many bytes in hexadecimal.
pub(crate) fn unhex<const N: usize>(text: &str) -> Option<[u8; N]> {
    let digits = text.as_bytes();
    if digits.len() != 2 * N {
        return None;
    }
    let mut bytes = [0; N];
    for (byte, pair) in bytes.iter_mut().zip(digits.chunks(2)) {
        let digit = |at: usize| (pair[at] as char).to_digit(16);
        *byte = (16 * digit(0)? + digit(1)?) as u8;
    }
    Some(bytes)
}
