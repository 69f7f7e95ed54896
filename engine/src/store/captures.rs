//! Where captures lay: what `cache forget` begins with, also when the records of the runs are long gone.
//!
//! `captures/HASH` names the folders whose files had this content, and the hashes of these files, as JSON; a list of
//! folders alone is what earlier programs wrote. `captures/HASH` of a path that was a link names its target.

use super::error::StoreError;
use super::folder::Store;
use crate::own;
use serde::{Deserialize, Serialize};
use stage::{Files, Hash};
use std::path::Path;

/// A hash over all folders and contents that the last run noted.
pub(super) const NOTED: &str = "noted";

/// Where the notes are.
pub(super) const FOLDER: &str = "captures";

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub(super) enum Note {
    /// The folders, as earlier programs wrote it.
    Former(Vec<String>),
    /// Folders and their files.
    Capture {
        /// Where files of this content lay.
        folders: Vec<String>,
        /// The hashes of the files, hexadecimal.
        files: Vec<String>,
    },
    /// A path that led elsewhere.
    Link {
        /// The path, as it was given.
        link: String,
        /// Where it led.
        to: String,
    },
}

impl Note {
    /// The folders of a capture.
    pub(super) fn folders(&self) -> &[String] {
        match self {
            Note::Former(folders) | Note::Capture { folders, .. } => folders,
            Note::Link { .. } => &[],
        }
    }

    /// The hashes of its files, as far as they are known.
    pub(super) fn files(&self) -> &[String] {
        match self {
            Note::Capture { files, .. } => files,
            _ => &[],
        }
    }
}

fn place(content: Hash) -> String {
    format!("{FOLDER}/{}", content.to_hex())
}

/// The bytes of a note.
pub(super) fn json(note: &Note) -> Vec<u8> {
    serde_json::to_vec(note).expect("bug: JSON")
}

impl Store {
    /// Notes what the files of each folder had as content. What a run notes as the one before did is looked at
    /// once, not input by input.
    pub(crate) fn note_captures(&self, all: &[(Hash, &Files)]) {
        let mut digest = blake3::Hasher::new();
        digest.update(b"with files\n");
        for (content, files) in all {
            digest.update(content.as_bytes());
            let folder = files.root.as_os_str().as_encoded_bytes();
            digest.update(&(folder.len() as u64).to_le_bytes());
            digest.update(folder);
        }
        let digest = digest.finalize().to_hex();
        let noted = std::fs::read(self.root().join(NOTED)).unwrap_or_default();
        if noted == digest.as_bytes() {
            return;
        }
        let note = |one: &&(Hash, &Files)| self.note_capture(one.0, one.1);
        if all.iter().filter(note).count() == all.len() {
            let _ = self.write(NOTED, digest.as_bytes());
        }
    }

    /// Notes that the files of a folder had this content; whether that is there now.
    pub fn note_capture(&self, content: Hash, files: &Files) -> bool {
        let note = self.note_of(&content.to_hex());
        let mut folders = note.as_ref().map_or(vec![], |note| note.folders().to_vec());
        let folder = files.root.display().to_string();
        let hash = |entry: &stage::FileEntry| entry.content.to_hex().to_string();
        let mut hashes: Vec<String> = files.entries.iter().map(hash).collect();
        hashes.sort();
        if folders.contains(&folder) && note.is_some_and(|note| note.files() == hashes) {
            return true;
        }
        if !folders.contains(&folder) {
            folders.push(folder);
        }
        let files = hashes;
        self.write(&place(content), &json(&Note::Capture { folders, files }))
            .is_ok()
    }

    /// Notes that a folder was named by a path that leads elsewhere.
    pub(crate) fn note_link(&self, answer: &Path, real: &Path) {
        let Ok(link) = std::path::absolute(answer) else {
            return;
        };
        if link == real {
            return;
        }
        let name = blake3::hash(link.as_os_str().as_encoded_bytes());
        let note = Note::Link {
            link: link.display().to_string(),
            to: real.display().to_string(),
        };
        if self.note_of(&name.to_hex()).as_ref() != Some(&note) {
            let _ = self.write(&place(name), &json(&note));
        }
    }

    /// A note, by its name; `None` if it is not there or cannot be read.
    pub(super) fn note_of(&self, name: &str) -> Option<Note> {
        let file = std::fs::read(self.root().join(FOLDER).join(name)).ok()?;
        serde_json::from_slice(&file).ok()
    }

    /// All notes with their names; `None` for those that cannot be read.
    ///
    /// # Errors
    ///
    /// They cannot be listed.
    pub(super) fn notes(&self) -> Result<Vec<(String, Option<Note>)>, StoreError> {
        let names = self.files(FOLDER, own::is_hash)?.into_iter();
        let note = |name: String| {
            let note = self.note_of(&name);
            (name, note)
        };
        Ok(names.map(note).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::store::forget;

    #[test]
    fn what_was_noted_is_not_looked_at_again_until_it_is_forgotten() {
        let place = tempfile::tempdir().unwrap();
        let store = Store::open(&place.path().join("cache")).unwrap();
        let files = |name: &str| Files {
            root: place.path().join(name),
            entries: vec![],
        };
        let (content, here) = (blake3::hash(b"photos"), files("photos"));
        let folders = || {
            store
                .note_of(&content.to_hex())
                .map(|note| note.folders().to_vec())
        };
        let mark = store.root().join(super::place(content));
        store.note_captures(&[(content, &here)]);
        assert_eq!(folders().unwrap().len(), 1);
        std::fs::remove_file(&mark).unwrap();
        store.note_captures(&[(content, &here)]);
        assert!(!mark.exists(), "one look, and no more");
        // Another folder with the same content, and both; it is there, so it is a capture of its own.
        let other = files("other");
        std::fs::create_dir(&other.root).unwrap();
        store.note_captures(&[(content, &here), (content, &other)]);
        assert_eq!(folders().unwrap().len(), 2);
        forget(&store, &here.root).unwrap();
        assert_eq!(folders().unwrap(), [other.root.display().to_string()]);
        store.note_captures(&[(content, &here), (content, &other)]);
        assert_eq!(folders().unwrap().len(), 2);
    }

    #[test]
    fn notes_of_earlier_programs_are_read_and_get_their_files() {
        let place = tempfile::tempdir().unwrap();
        let store = Store::open(&place.path().join("cache")).unwrap();
        let content = blake3::hash(b"photos");
        store.write(&super::place(content), b"[\"/a\"]").unwrap();
        let entry = stage::FileEntry {
            name: "1.jpg".into(),
            content: blake3::hash(b"1"),
            size: 1,
        };
        let files = Files {
            root: "/a".into(),
            entries: vec![entry],
        };
        assert!(store.note_capture(content, &files));
        let note = store.note_of(&content.to_hex()).unwrap();
        assert_eq!(
            (note.folders(), note.files().len()),
            (&["/a".to_owned()][..], 1)
        );
    }
}
