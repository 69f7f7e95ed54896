//! The user's folders become names and content hashes.
//!
//! A file is hashed once and remembered by size, inode and the times of modification and of change.
//! A file modified within two seconds of being remembered is hashed again (the racy-timestamp rule
//! of git's index).

use crate::graph::InputDecl;
use serde::{Deserialize, Serialize};
use stage::{Coded, FileEntry, Files, Hash, Message, Template, message};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use system::pattern::{fits, natural};
use system::text::shown;

stage::messages! {
    UNREADABLE = "cli-input-unreadable": "{path}: {why}; give a folder that is there and readable";
    NO_TEXT = "cli-input-utf8": "{path} has a name that is not UTF-8; give it another name";
    CONTROL = "cli-input-control": "{path} has a name that has control characters in it; give it another name";
    EMPTY = "cli-input-empty": "{path} has no file that fits {patterns}";
}

/// A folder that cannot be an input.
#[derive(Debug, thiserror::Error)]
pub enum SourceError {
    /// It cannot be read.
    #[error("{}", self.message())]
    Unreadable {
        /// The file or folder.
        path: PathBuf,
        /// The system's error.
        why: std::io::Error,
    },
    /// A file that would be left out, or named in a way that misleads.
    #[error("{}", self.message())]
    Name {
        /// The file or folder.
        path: PathBuf,
        /// What is wrong with the name.
        why: &'static Template,
    },
    /// None of its files fits.
    #[error("{}", self.message())]
    Empty {
        /// The folder.
        path: PathBuf,
        /// What would fit.
        patterns: String,
    },
}

impl Coded for SourceError {
    fn message(&self) -> Message {
        match self {
            SourceError::Unreadable { path, why } => {
                message!(UNREADABLE, path = shown(path), why = why.to_string())
            }
            SourceError::Name { path, why } => Message::new(why, [("path", shown(path).into())]),
            SourceError::Empty { path, patterns } => {
                message!(EMPTY, path = shown(path), patterns = patterns)
            }
        }
    }
}

/// What is remembered of files, so that they need not be hashed again.
#[derive(Debug, Default)]
pub struct Memo {
    files: BTreeMap<PathBuf, Stamp>,
    /// Folders as they were given, and where they are.
    roots: BTreeMap<PathBuf, PathBuf>,
    fresh: bool,
}

#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
struct Stamp {
    size: u64,
    modified_ns: i128,
    changed_ns: i128,
    inode: u64,
    seen_ns: i128,
    content: String,
}

const RACY_NS: i128 = 2_000_000_000;

/// The files of an input in natural order.
///
/// # Errors
///
/// No file fits, one cannot be read, or changed while it was hashed.
pub fn files(folder: &Path, input: &InputDecl, memo: &mut Memo) -> Result<Files, SourceError> {
    let unreadable = |path: &Path| {
        let path = path.to_owned();
        move |why| SourceError::Unreadable { path, why }
    };
    let root = memo.root(folder).map_err(unreadable(folder))?;
    // Plain names need no look around, unless one is written otherwise on the disk.
    if input.files.iter().all(|p| !p.contains(['*', '{'])) {
        let entry = |name: &String| {
            let path = root.join(name);
            let meta = std::fs::metadata(&path).ok().filter(|m| m.is_file())?;
            Some(memo.entry(name, &path, &meta))
        };
        if let Some(entries) = input.files.iter().map(entry).collect::<Option<Vec<_>>>() {
            let mut entries = entries.into_iter().collect::<Result<Vec<_>, _>>()?;
            order(&mut entries, |e| &e.name);
            return Ok(Files { root, entries });
        }
    }
    let (mut names, mut open) = (Vec::<String>::new(), vec![String::new()]);
    while let Some(inner) = open.pop() {
        let here = root.join(&inner);
        for entry in std::fs::read_dir(&here).map_err(unreadable(&here))? {
            let entry = entry.map_err(unreadable(&here))?;
            let raw = entry.file_name();
            let name = match inner.is_empty() {
                true => raw.to_string_lossy().into_owned(),
                false => format!("{inner}/{}", raw.to_string_lossy()),
            };
            let kind = std::fs::metadata(entry.path()).map_err(unreadable(&entry.path()))?;
            let deep = name.matches('/').count();
            let inner = kind.is_dir() && input.files.iter().any(|p| p.matches('/').count() > deep);
            let wanted = kind.is_file() && input.files.iter().any(|p| fits(p, &name));
            if !inner && !wanted {
                continue;
            }
            if let Some(why) = odd(&raw) {
                let path = entry.path();
                return Err(SourceError::Name { path, why });
            }
            if inner {
                open.push(name);
            } else if !names.contains(&name) {
                names.push(name);
            }
        }
    }
    if names.is_empty() {
        let patterns = input.files.join(", ");
        return Err(SourceError::Empty {
            path: folder.into(),
            patterns,
        });
    }
    order(&mut names, |name| name);
    let entry = |name: &String| {
        let path = root.join(name);
        let meta = std::fs::metadata(&path).map_err(unreadable(&path))?;
        memo.entry(name, &path, &meta)
    };
    let entries = names.iter().map(entry).collect::<Result<_, _>>()?;
    Ok(Files { root, entries })
}

/// What is wrong with the name of a file.
fn odd(name: &std::ffi::OsStr) -> Option<&'static Template> {
    match name.to_str() {
        None => Some(&NO_TEXT),
        Some(name) if name.contains(char::is_control) => Some(&CONTROL),
        Some(_) => None,
    }
}

/// Brings names into natural order.
fn order<T>(all: &mut [T], name: impl Fn(&T) -> &String) {
    if all.len() > 1 {
        all.sort_by_cached_key(|x| (natural(name(x)), name(x).clone()));
    }
}

impl Memo {
    /// From a file of the store: a line with the hash of the rest, and the rest. A torn or changed
    /// one is as good as none.
    pub fn load(path: &Path) -> Memo {
        let file = std::fs::read(path).unwrap_or_default();
        Memo {
            files: parse(&file).unwrap_or_default(),
            ..Memo::default()
        }
    }

    /// Without the files that fit, by path and content (hexadecimal).
    pub fn without(mut self, fits: impl Fn(&Path, &str) -> bool) -> Memo {
        self.files.retain(|path, stamp| !fits(path, &stamp.content));
        self
    }

    /// How many files are remembered.
    pub(crate) fn len(&self) -> usize {
        self.files.len()
    }

    /// Whether there is something new since it was loaded.
    pub fn is_fresh(&self) -> bool {
        self.fresh
    }

    /// Where a folder is.
    fn root(&mut self, folder: &Path) -> std::io::Result<PathBuf> {
        if let Some(root) = self.roots.get(folder) {
            return Ok(root.clone());
        }
        let root = folder.canonicalize()?;
        self.roots.insert(folder.into(), root.clone());
        Ok(root)
    }

    /// As bytes of a file.
    pub fn bytes(&self) -> Vec<u8> {
        let body = serde_json::to_vec(&self.files).expect("bug: a memo JSON cannot hold");
        let mut file = format!("{}\n", blake3::hash(&body).to_hex()).into_bytes();
        file.extend(body);
        file
    }

    fn entry(
        &mut self,
        name: &str,
        path: &Path,
        meta: &std::fs::Metadata,
    ) -> Result<FileEntry, SourceError> {
        let unreadable = |why| SourceError::Unreadable {
            path: path.into(),
            why,
        };
        let (content, size) = self.content(path, meta).map_err(unreadable)?;
        let name = name.to_owned();
        Ok(FileEntry {
            name,
            content,
            size,
        })
    }

    fn content(&mut self, path: &Path, meta: &std::fs::Metadata) -> std::io::Result<(Hash, u64)> {
        let now = system::Stamp::of(meta);
        if let Some(stamp) = self.files.get(path)
            && (stamp.size, stamp.modified_ns, stamp.changed_ns, stamp.inode)
                == (now.size, now.modified_ns, now.changed_ns, now.inode)
            && stamp.seen_ns - now.modified_ns.max(now.changed_ns) > RACY_NS
            && let Ok(content) = Hash::from_hex(&stamp.content)
        {
            return Ok((content, stamp.size));
        }
        // A video may be larger than memory.
        let mut hasher = blake3::Hasher::new();
        hasher.update_reader(std::fs::File::open(path)?)?;
        let (content, size) = (hasher.finalize(), hasher.count());
        let stamp = Stamp {
            size,
            modified_ns: now.modified_ns,
            changed_ns: now.changed_ns,
            inode: now.inode,
            seen_ns: system::clock::now_ns(),
            content: content.to_hex().to_string(),
        };
        self.files.insert(path.to_owned(), stamp);
        self.fresh = true;
        Ok((content, size))
    }
}

/// What the file of a memo holds, if it is whole.
fn parse(file: &[u8]) -> Option<BTreeMap<PathBuf, Stamp>> {
    let (hash, body) = file.split_at_checked(64)?;
    let body = body.strip_prefix(b"\n")?;
    let whole = blake3::hash(body).to_hex().as_bytes() == hash;
    serde_json::from_slice(body).ok().filter(|_| whole)
}
