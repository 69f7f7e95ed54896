//! What a program wrote, as a user's files: plain files of the names that its kind has, or why not.

use super::error::ForeignError;
use super::weight::too_much;
use crate::kind::Importer;
use crate::pattern::{fits, natural};
use stage::{FileEntry, Files};
use std::path::{Path, PathBuf};

/// Where `{out}` is: a file of the kind's name, or the folder itself.
pub(super) fn place(results: &Path, importer: &Importer) -> PathBuf {
    match importer.files {
        [one] if !one.contains(['*', '{']) => results.join(one),
        _ => results.to_owned(),
    }
}

/// The files of a result. What is read later must be what is hashed here.
pub(super) fn collected(
    name: &str,
    results: &Path,
    importer: &'static Importer,
    most: (u64, usize),
) -> Result<Files, ForeignError> {
    let kind = importer.stage.yields();
    let mut entries: Vec<FileEntry> = Vec::new();
    let mut bytes = 0u64;
    let mut open = vec![String::new()];
    while let Some(inner) = open.pop() {
        let folder = results.join(&inner);
        let at = |why| ForeignError::Folder {
            path: folder.clone(),
            why,
        };
        for entry in std::fs::read_dir(&folder).map_err(at)? {
            let entry = entry.map_err(at)?;
            let raw = entry.file_name();
            let file = match inner.is_empty() {
                true => raw.to_string_lossy().into_owned(),
                false => format!("{inner}/{}", raw.to_string_lossy()),
            };
            let shown = file.escape_debug().to_string();
            let strange = |what| ForeignError::Strange {
                program: name.into(),
                name: shown.clone(),
                what,
            };
            let meta = std::fs::symlink_metadata(entry.path()).map_err(at)?;
            if raw.to_str().is_none_or(|n| n.contains(char::is_control)) {
                return Err(strange("of a name that is no plain UTF-8"));
            }
            if meta.is_symlink() {
                return Err(strange("a link"));
            }
            if meta.is_dir() {
                open.push(file);
                continue;
            }
            if !meta.is_file() {
                return Err(strange("a device, a pipe or a socket"));
            }
            if !importer.files.iter().any(|pattern| fits(pattern, &file)) {
                return Err(ForeignError::Extra {
                    program: name.into(),
                    name: shown,
                    kind,
                    wants: importer.files.join(", "),
                });
            }
            bytes = bytes.saturating_add(meta.len());
            if bytes > most.0 || entries.len() >= most.1 {
                return Err(too_much(name, bytes, entries.len() + 1, most));
            }
            let content = stage::hash(&std::fs::read(entry.path()).map_err(at)?);
            entries.push(FileEntry {
                name: file,
                content,
                size: meta.len(),
            });
        }
    }
    if entries.is_empty() {
        return Err(ForeignError::Nothing {
            program: name.into(),
            tail: String::new(),
        });
    }
    entries.sort_by_cached_key(|e| (natural(&e.name), e.name.clone()));
    let root = results.to_owned();
    Ok(Files { root, entries })
}
