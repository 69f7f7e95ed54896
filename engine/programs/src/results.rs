//! What a program wrote, as a user's files: plain files of the names that its kind has, or why not.

use crate::Importer;
use crate::error::ForeignError;
use crate::layout::Job;
use crate::weight::too_much;
use stage::{FileEntry, Files, Hash};
use std::fs::{File, OpenOptions};
use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use system::pattern::{fits, natural};
use system::{FileKind, Met, nofollow, private_file, private_folder};

/// Where `{out}` is: a file of the kind's name, or the folder itself.
pub(crate) fn place(results: &Path, importer: &Importer) -> PathBuf {
    match importer.files {
        [one] if !one.contains(['*', '{']) => results.join(one),
        _ => results.to_owned(),
    }
}

/// The files of a result. What is read later must be what is hashed here: those of a program that stays are
/// copied out of its reach.
pub(crate) fn collected(
    name: &str,
    job: &Job,
    importer: &'static Importer,
    most: (u64, usize),
    stays: bool,
) -> Result<Files, ForeignError> {
    let names = listed(name, job, importer, most)?;
    if names.is_empty() {
        return Err(ForeignError::Nothing {
            program: name.into(),
            tail: String::new(),
        });
    }
    let root = match stays {
        true => job.taken()?,
        false if job.in_place() => job.results(),
        false => return Err(strange(name, "{out}", "a folder that was put in its place")),
    };
    let mut entries = Vec::new();
    for (file, size) in names {
        let copy = stays.then(|| root.join(&file));
        let content = content(name, job, &file, size, copy.as_deref())?;
        entries.push(FileEntry {
            name: file,
            content,
            size,
        });
    }
    entries.sort_by_cached_key(|e| (natural(&e.name), e.name.clone()));
    Ok(Files { root, entries })
}

fn strange(program: &str, name: &str, what: &'static str) -> ForeignError {
    ForeignError::Strange {
        program: program.into(),
        name: name.escape_debug().to_string(),
        what,
    }
}

/// Names and sizes of what is there, if all of it may be taken; nothing is read yet.
fn listed(
    program: &str,
    job: &Job,
    importer: &'static Importer,
    most: (u64, usize),
) -> Result<Vec<(String, u64)>, ForeignError> {
    let (mut names, mut bytes) = (Vec::new(), 0u64);
    let mut wrong = None;
    let mut meet = |met: &Met| {
        if let Some(what) = odd(met) {
            wrong = Some(strange(program, &met.path, what));
        } else if met.kind == Some(FileKind::File) {
            bytes = bytes.saturating_add(met.stamp.size);
            names.push((met.path.clone(), met.stamp.size));
            if !importer
                .files
                .iter()
                .any(|pattern| fits(pattern, &met.path))
            {
                wrong = Some(ForeignError::Extra {
                    program: program.into(),
                    name: met.path.escape_debug().to_string(),
                    kind: importer.stage.yields(),
                    wants: importer.files.join(", "),
                });
            } else if bytes > most.0 || names.len() > most.1 {
                wrong = Some(too_much(program, bytes, names.len(), most));
            }
        }
        wrong.is_none()
    };
    let looked = nofollow::walk(job.made(), &mut meet);
    match wrong {
        Some(wrong) => Err(wrong),
        None => looked.map(|()| names).map_err(|why| ForeignError::Folder {
            path: job.results(),
            why,
        }),
    }
}

fn odd(met: &Met) -> Option<&'static str> {
    match met.kind {
        _ if !met.named || met.path.contains(char::is_control) => {
            Some("of a name that is no plain UTF-8")
        }
        _ if met.link => Some("a link"),
        None => Some("a device, a pipe or a socket"),
        Some(_) => None,
    }
}

/// How much is read at once. \[bytes\]
const AT_ONCE_BYTES: usize = 1 << 20;

/// The hash of a file, which is copied on the way if that is wanted.
fn content(
    program: &str,
    job: &Job,
    name: &str,
    size: u64,
    copy: Option<&Path>,
) -> Result<Hash, ForeignError> {
    let wrong = |why| ForeignError::Folder {
        path: job.results().join(name),
        why,
    };
    let mut file = nofollow::open_file(job.made(), name).map_err(wrong)?;
    if nofollow::has_hole(&file, size) {
        let what = "a file with holes, of which less is on the disk than its size: write it whole";
        return Err(strange(program, name, what));
    }
    let mut copy = copy.map(made).transpose().map_err(wrong)?;
    let (mut hasher, mut buffer) = (blake3::Hasher::new(), vec![0; AT_ONCE_BYTES]);
    let mut left = size;
    loop {
        let read = file.read(&mut buffer).map_err(wrong)?;
        let Some(rest) = left
            .checked_sub(read as u64)
            .filter(|rest| read > 0 || *rest == 0)
        else {
            return Err(strange(program, name, "still being written to"));
        };
        if read == 0 {
            return Ok(hasher.finalize());
        }
        left = rest;
        hasher.update(&buffer[..read]);
        if let Some(copy) = &mut copy {
            copy.write_all(&buffer[..read]).map_err(wrong)?;
        }
    }
}

fn made(path: &Path) -> std::io::Result<File> {
    if let Some(above) = path.parent() {
        private_folder(above, true)?;
    }
    let mut open = OpenOptions::new();
    private_file(open.write(true).create_new(true)).open(path)
}
