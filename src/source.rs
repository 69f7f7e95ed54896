//! The user's folders become names and content hashes.
//!
//! A file is hashed once and remembered by size, inode and the times of modification and of change.
//! A file modified within two seconds of being remembered is hashed again (the racy-timestamp rule
//! of git's index).

use crate::graph::InputDecl;
use serde::{Deserialize, Serialize};
use stage::{FileEntry, Files, Hash};
use std::collections::BTreeMap;
use std::os::unix::fs::MetadataExt;
use std::path::{Path, PathBuf};

/// A folder that cannot be an input.
#[derive(Debug, thiserror::Error)]
pub enum SourceError {
    /// It cannot be read.
    #[error("{}: {why}; give a folder that is there and readable", path.display())]
    Unreadable {
        /// The file or folder.
        path: PathBuf,
        /// What the system says.
        why: std::io::Error,
    },
    /// None of its files fits.
    #[error("{} has no file that fits {patterns}", path.display())]
    Empty {
        /// The folder.
        path: PathBuf,
        /// What would fit.
        patterns: String,
    },
}

/// What is remembered of files, so that they need not be hashed again.
#[derive(Debug, Default)]
pub struct Memo {
    files: BTreeMap<PathBuf, Stamp>,
    /// Folders as they were said, and where they are.
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
            let Ok(name) = entry.file_name().into_string() else {
                continue;
            };
            let name = if inner.is_empty() {
                name
            } else {
                format!("{inner}/{name}")
            };
            let kind = std::fs::metadata(entry.path()).map_err(unreadable(&entry.path()))?;
            let deep = name.matches('/').count();
            if kind.is_dir() && input.files.iter().any(|p| p.matches('/').count() > deep) {
                open.push(name);
            } else if kind.is_file()
                && input.files.iter().any(|p| fits(p, &name))
                && !names.contains(&name)
            {
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

/// Brings names into natural order.
fn order<T>(all: &mut [T], name: impl Fn(&T) -> &String) {
    if all.len() > 1 {
        all.sort_by_cached_key(|x| (natural(name(x)), name(x).clone()));
    }
}

impl Memo {
    /// From a file of the store; a torn one is as good as none.
    pub fn load(path: &Path) -> Memo {
        let bytes = std::fs::read(path).unwrap_or_default();
        Memo {
            files: serde_json::from_slice(&bytes).unwrap_or_default(),
            ..Memo::default()
        }
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
        serde_json::to_vec(&self.files).expect("bug: a memo JSON cannot hold")
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
        let ns = |s: i64, ns: i64| i128::from(s) * 1_000_000_000 + i128::from(ns);
        let modified_ns = ns(meta.mtime(), meta.mtime_nsec());
        let changed_ns = ns(meta.ctime(), meta.ctime_nsec());
        if let Some(stamp) = self.files.get(path)
            && (stamp.size, stamp.modified_ns, stamp.changed_ns, stamp.inode)
                == (meta.size(), modified_ns, changed_ns, meta.ino())
            && stamp.seen_ns - modified_ns.max(changed_ns) > RACY_NS
            && let Ok(content) = Hash::from_hex(&stamp.content)
        {
            return Ok((content, stamp.size));
        }
        let bytes = std::fs::read(path)?;
        let content = blake3::hash(&bytes);
        let stamp = Stamp {
            size: bytes.len() as u64,
            modified_ns,
            changed_ns,
            inode: meta.ino(),
            seen_ns: crate::clock::now_ns(),
            content: content.to_hex().to_string(),
        };
        self.files.insert(path.to_owned(), stamp);
        self.fresh = true;
        Ok((content, bytes.len() as u64))
    }
}

/// Whether a name fits a pattern: `*` is any run of characters within a folder, `{a,b}` either;
/// letters of the extension may be of either case.
fn fits(pattern: &str, name: &str) -> bool {
    if let (Some(open), Some(close)) = (pattern.find('{'), pattern.find('}'))
        && open < close
    {
        let (head, tail) = (&pattern[..open], &pattern[close + 1..]);
        return pattern[open + 1..close]
            .split(',')
            .any(|w| fits(&format!("{head}{w}{tail}"), name));
    }
    fn glob(p: &[u8], n: &[u8]) -> bool {
        match (p.first(), n.first()) {
            (None, None) => true,
            (Some(b'*'), _) => {
                glob(&p[1..], n) || n.first().is_some_and(|c| *c != b'/') && glob(p, &n[1..])
            }
            (Some(a), Some(b)) => a.eq_ignore_ascii_case(b) && glob(&p[1..], &n[1..]),
            _ => false,
        }
    }
    glob(pattern.as_bytes(), name.as_bytes())
}

/// A name as texts and numbers, so that `2.jpg` comes before `10.jpg`.
fn natural(name: &str) -> Vec<(String, u128)> {
    let mut parts = Vec::new();
    let mut rest = name;
    while !rest.is_empty() {
        let text = rest
            .find(|c: char| c.is_ascii_digit())
            .unwrap_or(rest.len());
        let tail = &rest[text..];
        let digits = tail
            .find(|c: char| !c.is_ascii_digit())
            .unwrap_or(tail.len());
        parts.push((
            rest[..text].to_lowercase(),
            tail[..digits].parse().unwrap_or(0),
        ));
        rest = &tail[digits..];
    }
    parts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_comes_before_ten() {
        let mut names = vec!["image_10.jpg", "image_2.jpg", "image_0.jpg"];
        names.sort_by_key(|n| natural(n));
        assert_eq!(names, ["image_0.jpg", "image_2.jpg", "image_10.jpg"]);
    }

    #[test]
    fn patterns_fit_what_they_say() {
        assert!(fits("images/*.{jpg,jpeg,png}", "images/a.b.JPG"));
        assert!(!fits("*.jpg", "images/a.jpg"));
        assert!(!fits("*.{jpg,png}", "a.tif"));
    }
}
