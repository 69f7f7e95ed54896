//! What a program holds in memory and has written, against what it may.

use crate::error::ForeignError;
use crate::family;
use crate::places::WRITTEN;
use std::path::Path;
use system::{FileKind, nofollow};

/// Whether it holds or has written too much, anywhere that it may write to.
pub(crate) fn weigh(
    name: &str,
    root: &Path,
    memory_mb: Option<u64>,
    most: (u64, usize),
) -> Result<(), ForeignError> {
    if let Some(limit_mb) = memory_mb
        && family::memory_mb(root) > limit_mb
    {
        return Err(ForeignError::Memory {
            program: name.into(),
            limit_mb,
            tail: String::new(),
        });
    }
    let (mut bytes, mut files) = (0u64, 0usize);
    for inner in WRITTEN {
        let at = nofollow::folder(root, &[inner]);
        let looked = at.and_then(|at| {
            nofollow::walk(&at, &mut |met| {
                files += 1;
                if met.kind == Some(FileKind::File) {
                    bytes = bytes.saturating_add(met.stamp.size);
                }
                files <= most.1 && bytes <= most.0
            })
        });
        if files > most.1 || bytes > most.0 {
            return Err(too_much(name, bytes, files, most));
        }
        looked.map_err(|why| ForeignError::Folder {
            path: root.join(inner),
            why,
        })?;
    }
    Ok(())
}

pub(crate) fn too_much(name: &str, bytes: u64, files: usize, most: (u64, usize)) -> ForeignError {
    ForeignError::TooMuch {
        program: name.into(),
        what: format!("{} MB in {files} files", bytes / 1_000_000),
        most: format!("{} MB in {} files", most.0 / 1_000_000, most.1),
        tail: String::new(),
    }
}
