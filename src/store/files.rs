//! Files that are whole or not there, for the owner only.

use super::StoreError;
use std::fs::{self, File, OpenOptions};
use std::io::Write;
use std::os::unix::fs::{DirBuilderExt, OpenOptionsExt};
use std::path::Path;

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

/// Writes a file under another name, syncs it, and renames it: whole or not at all. Mode 0600.
pub(super) fn publish(tmp: &Path, path: &Path, bytes: &[u8]) -> Result<(), StoreError> {
    if let Some(parent) = path.parent() {
        folder(parent)?;
    }
    let written = (|| {
        let mut file = OpenOptions::new()
            .write(true)
            .create_new(true)
            .mode(0o600)
            .open(tmp)?;
        file.write_all(bytes)?;
        file.sync_data()?;
        fs::rename(tmp, path)?;
        path.parent()
            .map_or(Ok(()), |parent| File::open(parent)?.sync_all())
    })();
    written.map_err(|why| {
        let _ = fs::remove_file(tmp);
        StoreError::Disk {
            path: path.into(),
            why,
        }
    })
}
