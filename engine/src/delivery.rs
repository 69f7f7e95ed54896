//! Results into a folder of the user's.
//!
//! A delivery lists in `run.json` what it wrote, with hashes. So the next one into the same folder
//! finds what is left of it, and removes that, if asked to, where nobody has changed it since.
//! Two processes deliver one after the other. No file is ever half-written, and none is written or
//! removed through a link.

pub(crate) mod error;
mod withdraw;

use serde_json::{Map, Value, json};
use std::collections::{BTreeMap, BTreeSet};
use std::fs::File;
use std::path::{Component, Path, PathBuf};
use system::{self, Folder, nofollow, private_folder};

pub use error::DeliveryError;
pub(crate) use withdraw::of_readable;
pub use withdraw::{Withdrawn, of, withdraw};

/// The run with its provenance, and what it wrote.
pub const RUN: &str = "run.json";

/// A folder that results are being delivered into.
pub struct Delivery {
    folder: PathBuf,
    /// Whose results they are.
    of: String,
    /// What earlier deliveries left: name and hash.
    before: BTreeMap<String, String>,
    now: BTreeMap<String, String>,
    tidied: BTreeSet<PathBuf>,
    /// Locked as long as this lives.
    _locked: File,
}

/// What a delivery did not write and an earlier one did.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Left {
    /// Still there.
    pub left: Vec<String>,
    /// Removed.
    pub removed: Vec<String>,
}

/// The folders of a file's name, and its own.
fn parts(name: &Path) -> Option<(Vec<&str>, &str)> {
    let part = |part| match part {
        Component::Normal(name) => name.to_str(),
        _ => None,
    };
    let mut names: Vec<&str> = name.components().map(part).collect::<Option<_>>()?;
    let last = names.pop()?;
    Some((names, last))
}

/// Puts a file below a folder.
fn put(folder: &Path, name: &Path, bytes: &[u8]) -> Result<(), DeliveryError> {
    let (folders, last) = parts(name).ok_or_else(|| DeliveryError::Name(name.into()))?;
    let written = nofollow::made(folder, &folders).and_then(|at| {
        nofollow::replace(&at, last, bytes)?;
        Ok(())
    });
    written.map_err(|why| {
        let mut link = folder.to_owned();
        let is_link = |name: &&&str| {
            link.push(name);
            link.is_symlink()
        };
        match folders.iter().find(is_link) {
            Some(_) => DeliveryError::Link(link),
            None => DeliveryError::Disk {
                path: folder.join(name),
                why,
            },
        }
    })
}

/// Makes a folder with all above it, mode 0700.
fn make(folder: &Path) -> Result<(), DeliveryError> {
    private_folder(folder, true).map_err(|why| DeliveryError::Disk {
        path: folder.into(),
        why,
    })
}

/// Writes files for the owner only: one to `path`, several into the folder `path`.
///
/// # Errors
///
/// The disk refuses.
pub fn write(path: &Path, files: &[(String, Vec<u8>)]) -> Result<(), DeliveryError> {
    for (name, bytes) in files {
        let (folder, name) = match (name.is_empty(), path.parent(), path.file_name()) {
            (true, Some(folder), Some(name)) => (folder, Path::new(name)),
            _ => (path, Path::new(name)),
        };
        let folder = match folder.as_os_str().is_empty() {
            true => Path::new("."),
            false => folder,
        };
        make(folder)?;
        put(folder, name, bytes)?;
    }
    Ok(())
}

/// Whether results can be delivered into a folder, which may not be there yet.
///
/// # Errors
///
/// It holds what no run of ours wrote.
pub fn check(folder: &Path) -> Result<(), DeliveryError> {
    let wrong = |path: &Path, why: std::io::Error| DeliveryError::Disk {
        path: path.into(),
        why,
    };
    let here = Path::new(".");
    for path in folder.ancestors() {
        let path = if path.as_os_str().is_empty() {
            here
        } else {
            path
        };
        if path.symlink_metadata().is_err() {
            continue;
        }
        let meta = path.metadata().map_err(|why| wrong(path, why))?;
        if !meta.is_dir() {
            return Err(DeliveryError::NoFolder(path.into()));
        }
        return system::may_write(path).map_err(|why| wrong(path, why));
    }
    Ok(())
}

/// The `run.json` of a folder.
fn answer(folder: &Path) -> Option<Map<String, Value>> {
    let at = nofollow::folder(folder, &[]).ok()?;
    serde_json::from_slice(&nofollow::read(&at, RUN)?).ok()
}

/// Whether a folder holds what is not the results of this: another's, or nobody knows whose.
pub fn is_of_another(folder: &Path, of: &str) -> bool {
    let mut entries = std::fs::read_dir(folder).into_iter().flatten();
    match answer(folder) {
        Some(run) => run.get("of").is_none_or(|whose| whose != of),
        None => entries.next().is_some(),
    }
}

impl Delivery {
    /// Into a folder, which is made if need be; waits while somebody else delivers.
    ///
    /// # Errors
    ///
    /// It cannot be made, or holds what is not ours.
    pub fn open(folder: &Path, of: &str) -> Result<Delivery, DeliveryError> {
        make(folder)?;
        let locked = File::open(folder).map_err(|why| DeliveryError::Disk {
            path: folder.into(),
            why,
        })?;
        // On a disk that knows no locks the files of two deliveries may be mixed, each file whole.
        let _ = locked.lock();
        let run = answer(folder).unwrap_or_default();
        let names = |key: &str| run.get(key).and_then(Value::as_object).cloned();
        let before = ["left", "files"].map(|key| names(key).unwrap_or_default());
        let text = |(name, hash): (String, Value)| Some((name, hash.as_str()?.to_owned()));
        Ok(Delivery {
            folder: folder.into(),
            of: of.into(),
            before: before.into_iter().flatten().filter_map(text).collect(),
            now: BTreeMap::new(),
            tidied: BTreeSet::new(),
            _locked: locked,
        })
    }

    /// Writes whose the folder is before anything else is in it.
    ///
    /// # Errors
    ///
    /// The disk refuses.
    pub fn begin(&mut self) -> Result<(), DeliveryError> {
        let run = json!({ "of": self.of, "files": self.before, "unfinished": true });
        self.write_run(&run)
    }

    fn write_run(&self, run: &Value) -> Result<(), DeliveryError> {
        let text = serde_json::to_vec_pretty(run).expect("bug: JSON");
        put(&self.folder, Path::new(RUN), &text)
    }

    /// Writes files: one of this name, or several into the folder of this name.
    ///
    /// # Errors
    ///
    /// The disk refuses, or a name is taken by somebody else's file.
    pub fn put(&mut self, name: &str, files: &[(String, Vec<u8>)]) -> Result<(), DeliveryError> {
        for (below, bytes) in files {
            let name = match (name.is_empty(), below.is_empty()) {
                (_, true) => name.to_owned(),
                (true, _) => below.clone(),
                _ => format!("{name}/{below}"),
            };
            let path = Path::new(&name);
            put(&self.folder, path, bytes)?;
            let inner = path.parent().unwrap_or(path).to_owned();
            if let Ok(at) = self.inner(&name).and_then(|(at, _)| at.ok_or(()))
                && self.tidied.insert(inner)
            {
                system::tidy(&at);
            }
            let hash = blake3::hash(bytes).to_hex().to_string();
            self.now.insert(name, hash);
        }
        Ok(())
    }

    /// The folder that a file is in, if it is there, and its own name.
    fn inner<'a>(&self, name: &'a str) -> Result<(Option<Folder>, &'a str), ()> {
        let (folders, last) = parts(Path::new(name)).ok_or(())?;
        Ok((nofollow::folder(&self.folder, &folders).ok(), last))
    }

    /// Removes a file that nobody has changed since it was delivered, and folders that are empty
    /// without it.
    fn remove(&self, name: &str, hash: &str) -> bool {
        let Ok((Some(at), last)) = self.inner(name) else {
            return false;
        };
        let same = |bytes: Vec<u8>| blake3::hash(&bytes).to_hex().as_str() == hash;
        let removed = nofollow::read(&at, last).is_some_and(same) && nofollow::remove(&at, last);
        let mut folder = Path::new(name).parent();
        while let Some(inner) = folder.and_then(Path::to_str).filter(|f| !f.is_empty()) {
            if let Ok((Some(at), last)) = self.inner(inner) {
                nofollow::remove_empty(&at, last);
            }
            folder = Path::new(inner).parent();
        }
        removed
    }

    /// Writes the run down. What earlier deliveries left and this one did not write is removed if
    /// that is wanted, and reported in any case.
    ///
    /// # Errors
    ///
    /// The disk refuses.
    pub fn finish(self, run: Value, clean: bool) -> Result<Left, DeliveryError> {
        let mut leftovers = Left::default();
        let mut left = BTreeMap::new();
        for (name, hash) in &self.before {
            if self.now.contains_key(name) || !self.folder.join(name).is_file() {
                continue;
            }
            if clean && self.remove(name, hash) {
                leftovers.removed.push(name.clone());
            } else {
                leftovers.left.push(name.clone());
                left.insert(name, hash);
            }
        }
        let mut run = run;
        run["of"] = json!(self.of);
        run["files"] = json!(self.now);
        run["left"] = json!(left);
        self.write_run(&run)?;
        Ok(leftovers)
    }
}
