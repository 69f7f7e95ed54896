//! Files that are whole or not there, for the owner only.

use super::StoreError;
use std::fs::{self, File, OpenOptions};
use std::io::{ErrorKind, Write};
use std::os::unix::fs::{DirBuilderExt, OpenOptionsExt};
use std::path::Path;

/// Whether a file must outlive a loss of power. A file that need not is found torn or missing
/// after one, which is a miss. The syncs of a result and its record cost some 30 ms: they are worth
/// it for what took a hundred times as long, so that the engine stays below a hundredth.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Care {
    /// Synced before it gets its name.
    Durable,
    /// Left to the system.
    Cheap,
}

impl Care {
    /// For what took so long to make. \[s\]
    pub(super) fn worth(seconds: f64) -> Care {
        if seconds < 3.0 {
            Care::Cheap
        } else {
            Care::Durable
        }
    }
}

fn disk(path: &Path) -> impl FnOnce(std::io::Error) -> StoreError + '_ {
    move |why| StoreError::Disk {
        path: path.into(),
        why,
    }
}

/// Makes a folder with all above it, mode 0700.
pub(super) fn folder(path: &Path) -> Result<(), StoreError> {
    if path.is_dir() {
        return Ok(());
    }
    fs::DirBuilder::new()
        .recursive(true)
        .mode(0o700)
        .create(path)
        .map_err(disk(path))
}

/// Makes the folder that a file is to lie in, mode 0700.
fn above(path: &Path) -> std::io::Result<()> {
    let mut make = fs::DirBuilder::new();
    let make = make.recursive(true).mode(0o700);
    path.parent().map_or(Ok(()), |folder| make.create(folder))
}

/// Writes a file under another name and renames it: whole or not at all. Mode 0600.
pub(super) fn publish(tmp: &Path, path: &Path, bytes: &[u8], care: Care) -> Result<(), StoreError> {
    let written = (|| {
        let mut open = OpenOptions::new();
        let open = open.write(true).create_new(true).mode(0o600);
        let mut file = match open.open(tmp) {
            Err(error) if error.kind() == ErrorKind::NotFound => {
                above(tmp)?;
                open.open(tmp)?
            }
            opened => opened?,
        };
        file.write_all(bytes)?;
        if care == Care::Durable {
            file.sync_data()?;
        }
        drop(file);
        if let Err(error) = fs::rename(tmp, path) {
            // The folder of a new prefix is made when it is missed, which is rare.
            if error.kind() != ErrorKind::NotFound {
                return Err(error);
            }
            above(path)?;
            fs::rename(tmp, path)?;
        }
        match (care, path.parent()) {
            (Care::Durable, Some(parent)) => File::open(parent)?.sync_all(),
            _ => Ok(()),
        }
    })();
    written.map_err(|why| {
        let _ = fs::remove_file(tmp);
        StoreError::Disk {
            path: path.into(),
            why,
        }
    })
}
