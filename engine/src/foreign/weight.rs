//! What a program holds in memory and has written, against what it may.

use super::error::ForeignError;
use super::family;
use std::path::Path;

/// Whether it holds or has written too much.
pub(super) fn weigh(
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
    let mut open = vec![root.join("out"), root.join("work")];
    while let Some(folder) = open.pop() {
        for entry in std::fs::read_dir(&folder).into_iter().flatten().flatten() {
            files += 1;
            match entry.metadata() {
                Ok(meta) if meta.is_dir() => open.push(entry.path()),
                Ok(meta) => bytes = bytes.saturating_add(meta.len()),
                Err(_) => {}
            }
            if files > most.1 || bytes > most.0 {
                return Err(too_much(name, bytes, files, most));
            }
        }
    }
    Ok(())
}

pub(super) fn too_much(name: &str, bytes: u64, files: usize, most: (u64, usize)) -> ForeignError {
    ForeignError::TooMuch {
        program: name.into(),
        what: format!("{} MB in {files} files", bytes / 1_000_000),
        most: format!("{} MB in {} files", most.0 / 1_000_000, most.1),
        tail: String::new(),
    }
}
