//! Where captures are on the disk, for their owner only.
//!
//! ```text
//! captures/ID/record.json   name, files, facts
//! captures/ID/photos/       0001.jpg … in turning order; masks/ once they were corrected
//! captures/ID/look.json     what was seen of them
//! captures/ID/ended.json    what became of the measuring
//! captures/ID/painted/      strokes of the brush, by photo
//! captures/ID/small/        pictures to look at, made when asked for
//! captures/ID/out/          the results, as `tailor measure` writes them
//! lock                      taken by the server
//! ```
//!
//! An ID is sixteen hex digits that the server chose. No name of a user's gets into a path.

use super::guard::random;
use super::record::{Ended, Record, tidy};
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::fs::DirBuilder;
use std::io::{Error, ErrorKind, Result, Write};
use std::os::unix::fs::{DirBuilderExt, OpenOptionsExt};
use std::path::{Path, PathBuf};
use std::sync::Mutex;

/// All captures.
pub(super) struct Home {
    root: PathBuf,
    /// Records are read, changed and written by one at a time.
    changing: Mutex<()>,
    /// Locked as long as this lives: one server a folder.
    _lock: std::fs::File,
}

/// A capture's folder.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Place {
    pub(super) id: String,
    pub(super) folder: PathBuf,
}

/// Digits of an ID.
const DIGITS: usize = 16;

/// Whether a text is an ID.
fn is_id(text: &str) -> bool {
    let digit = |b: u8| b.is_ascii_digit() || (b'a'..=b'f').contains(&b);
    text.len() == DIGITS && text.bytes().all(digit)
}

/// Makes a folder, for its owner only.
pub(super) fn make(folder: &Path) -> Result<()> {
    DirBuilder::new().recursive(true).mode(0o700).create(folder)
}

/// Writes a file, for its owner only, whole or not at all.
pub(super) fn write(path: &Path, bytes: &[u8]) -> Result<()> {
    let beside = path.with_extension(format!("{}.part", random(4)?));
    let mut options = std::fs::OpenOptions::new();
    let options = options.write(true).create_new(true).mode(0o600);
    let written = options.open(&beside).and_then(|mut file| {
        file.write_all(bytes)?;
        std::fs::rename(&beside, path)
    });
    written.inspect_err(|_| _ = std::fs::remove_file(&beside))
}

fn read<T: DeserializeOwned>(path: &Path) -> Option<T> {
    serde_json::from_slice(&std::fs::read(path).ok()?).ok()
}

fn json(value: &impl Serialize) -> Vec<u8> {
    serde_json::to_vec_pretty(value).expect("bug: JSON")
}

impl Home {
    /// In a folder, which is made if it is not there. What was coming in when a server was killed goes.
    pub(super) fn open(root: &Path) -> Result<Home> {
        make(&root.join("captures"))?;
        let root = root.canonicalize()?;
        let mut options = std::fs::OpenOptions::new();
        let options = options.write(true).create(true).truncate(false).mode(0o600);
        let lock = options.open(root.join("lock"))?;
        let other = |_| Error::other("another `tailor serve` uses this folder");
        lock.try_lock().map_err(other)?;
        let home = Home {
            root,
            changing: Mutex::new(()),
            _lock: lock,
        };
        for (place, _) in home.all() {
            let _ = std::fs::remove_dir_all(place.folder.join("incoming"));
        }
        Ok(home)
    }

    /// A new capture.
    pub(super) fn create(&self, name: &str) -> Result<Place> {
        let id = random(DIGITS / 2)?;
        let folder = self.root.join("captures").join(&id);
        let place = Place { id, folder };
        make(&place.photos())?;
        let begun = (system::clock::now_ns() / 1_000_000_000) as u64;
        let name = tidy(name);
        let record = Record {
            name,
            begun,
            ..Record::default()
        };
        write(&place.folder.join(RECORD), &json(&record))?;
        Ok(place)
    }

    /// The capture of an ID, if there is one.
    pub(super) fn place(&self, id: &str) -> Option<Place> {
        let folder = is_id(id).then(|| self.root.join("captures").join(id))?;
        let there = folder.join(RECORD).is_file();
        there.then(|| Place {
            id: id.to_owned(),
            folder,
        })
    }

    /// All captures with their records, the newest first.
    pub(super) fn all(&self) -> Vec<(Place, Record)> {
        let entries = std::fs::read_dir(self.root.join("captures"));
        let names = entries.into_iter().flatten().flatten();
        let names = names.filter_map(|e| e.file_name().into_string().ok());
        let one = |id: String| {
            let place = self.place(&id)?;
            let record = place.record().ok()?;
            Some((place, record))
        };
        let mut all: Vec<_> = names.filter_map(one).collect();
        all.sort_by(|(a, x), (b, y)| y.begun.cmp(&x.begun).then(a.id.cmp(&b.id)));
        all
    }

    /// Changes a record.
    pub(super) fn change<T>(&self, place: &Place, how: impl FnOnce(&mut Record) -> T) -> Result<T> {
        let _alone = self.changing.lock().unwrap_or_else(|e| e.into_inner());
        let mut record = place.record()?;
        let answer = how(&mut record);
        write(&place.folder.join(RECORD), &json(&record))?;
        Ok(answer)
    }

    /// Removes all files of a capture.
    pub(super) fn remove(&self, place: &Place) -> Result<()> {
        std::fs::remove_dir_all(&place.folder)
    }

    /// Free space on the disk. \[bytes\]
    pub(super) fn free(&self) -> Option<u64> {
        let disk = rustix::fs::statvfs(&self.root).ok()?;
        Some(disk.f_bavail * disk.f_frsize)
    }
}

const RECORD: &str = "record.json";

impl Place {
    /// The folder that is measured.
    pub(super) fn photos(&self) -> PathBuf {
        self.folder.join("photos")
    }

    /// The folder of the results.
    pub(super) fn out(&self) -> PathBuf {
        self.folder.join("out")
    }

    /// What is remembered.
    pub(super) fn record(&self) -> Result<Record> {
        let broken = || {
            Error::new(
                ErrorKind::InvalidData,
                "the record of this capture is broken",
            )
        };
        read(&self.folder.join(RECORD)).ok_or_else(broken)
    }

    /// What was seen of the photos, if somebody looked since they changed.
    pub(super) fn look(&self) -> Option<serde_json::Value> {
        read(&self.folder.join("look.json"))
    }

    /// Keeps what was seen.
    pub(super) fn keep_look(&self, look: &serde_json::Value) -> Result<()> {
        write(&self.folder.join("look.json"), &json(look))
    }

    /// What became of the measuring.
    pub(super) fn ended(&self) -> Option<Ended> {
        read(&self.folder.join("ended.json"))
    }

    /// Keeps what became of it.
    pub(super) fn keep_ended(&self, ended: &Ended) -> Result<()> {
        write(&self.folder.join("ended.json"), &json(ended))
    }

    /// The girths that were measured, if the last measuring came to its end.
    pub(super) fn girths(&self, state: &str) -> Option<serde_json::Value> {
        (state == "done").then_some(())?;
        read(&self.out().join("girths.json"))
    }

    /// Photos changed: what was seen of them, painted on them and made small of them is no more.
    pub(super) fn outdated(&self) {
        let _ = std::fs::remove_file(self.folder.join("look.json"));
        let _ = std::fs::remove_dir_all(self.folder.join("painted"));
        let _ = std::fs::remove_dir_all(self.photos().join("masks"));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::os::unix::fs::PermissionsExt;

    #[test]
    fn captures_are_kept_for_their_owner_and_ids_are_no_paths() {
        let root = tempfile::tempdir().unwrap();
        let home = Home::open(&root.path().join("home")).unwrap();
        assert!(
            Home::open(&root.path().join("home")).is_err(),
            "one server a folder"
        );
        let place = home.create("<b>anna</b>\n").unwrap();
        assert_eq!(home.place(&place.id), Some(place.clone()));
        for id in [
            "..",
            "../../etc",
            "",
            "ABCDEFABCDEFABCD",
            "0123456789abcdef/",
        ] {
            assert_eq!(home.place(id), None, "{id}");
        }
        home.change(&place, |r| r.facts.walk = true).unwrap();
        let all = home.all();
        assert!(all.len() == 1 && all[0].1.facts.walk && all[0].1.name == "<b>anna</b>");
        let mode = |path: &Path| std::fs::metadata(path).unwrap().permissions().mode() & 0o777;
        assert_eq!(mode(&place.folder), 0o700);
        assert_eq!(mode(&place.folder.join(RECORD)), 0o600);
        home.remove(&place).unwrap();
        assert!(home.all().is_empty() && !place.folder.exists());
    }
}
