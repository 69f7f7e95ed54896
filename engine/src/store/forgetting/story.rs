//! A store with captures in it, made up: what runs leave, and what goes wrong on a disk.

use super::super::record::Record;
use super::super::simulated::{Simulated, below, in_memory};
use super::super::{Store, StoreError};
use proof::Dice;
use stage::{FileEntry, Files, Hash};
use std::path::PathBuf;
use std::sync::OnceLock;

/// A capture, with words that nothing else has.
pub(super) struct Capture {
    pub(super) folder: PathBuf,
    pub(super) name: String,
    photos: String,
}

/// A store, its captures, and where they are.
pub(super) struct Story {
    pub(super) place: tempfile::TempDir,
    pub(super) captures: Vec<Capture>,
}

fn hex(hash: Hash) -> String {
    hash.to_hex().to_string()
}

impl Story {
    pub(super) fn new(dice: &mut Dice) -> Story {
        let place = in_memory();
        let count = 2 + dice.bits() as usize % 2;
        let capture = |i: usize| Capture {
            folder: place.path().join(format!("needle-name-{i}")),
            name: format!("needle-name-{i}"),
            photos: format!("needle-photo-{i}-"),
        };
        let captures: Vec<Capture> = (0..count).map(capture).collect();
        for capture in &captures {
            std::fs::create_dir(&capture.folder).unwrap();
            for photo in 0..3 {
                let bytes = format!("{}{photo}", capture.photos);
                std::fs::write(capture.folder.join(format!("{photo}.jpg")), bytes).unwrap();
            }
            std::fs::write(capture.folder.join("plate.jpg"), "of all").unwrap();
        }
        Story { place, captures }
    }

    pub(super) fn root(&self) -> PathBuf {
        self.place.path().join("cache")
    }

    pub(super) fn store(&self, disk: &Simulated) -> Result<Store, StoreError> {
        Store::with(&self.root(), Box::new(disk.clone()), OnceLock::new())
    }

    /// As a run of a capture leaves it, as far as the disk goes: notes, parts, results with records, the run's own.
    pub(super) fn run(
        &self,
        store: &Store,
        capture: &Capture,
        dice: &mut Dice,
    ) -> Result<(), StoreError> {
        let mut entries = Vec::new();
        for name in ["0.jpg", "1.jpg", "2.jpg", "plate.jpg"] {
            let bytes = std::fs::read(capture.folder.join(name)).unwrap();
            entries.push(FileEntry {
                name: name.into(),
                content: blake3::hash(&bytes),
                size: bytes.len() as u64,
            });
        }
        let hashes: Vec<(&str, String)> = entries
            .iter()
            .map(|e| (e.name.as_str(), hex(e.content)))
            .collect();
        let files = Files {
            root: capture.folder.clone(),
            entries: entries.clone(),
        };
        let content = stage::content(&files);
        store.note_captures(&[(content, &files)]);
        let folder = capture.folder.display().to_string();
        store.note_delivery(
            &self.place.path().join("out"),
            "x",
            &[("turn".into(), capture.folder.clone())],
        );
        // With whether it shows the capture: equal inputs come to equal results, whoever had them.
        let (mut made, mut lines) = (vec![(hex(content), true)], vec![]);
        for n in 0..3 + dice.bits() % 3 {
            let (from, shows) = made[dice.bits() as usize % made.len()].clone();
            // Some results are of equal bytes, whatever they were made of.
            let (bytes, shows) = match dice.bits() % 4 {
                1.. if shows => (format!("{} result {n}", capture.photos), true),
                _ => (format!("equal {}", n % 2), false),
            };
            let provenance = vec![
                ("stage".to_owned(), format!("toy.{n} v1")),
                ("from x".to_owned(), from.clone()),
            ];
            let record = Record {
                content: blake3::hash(bytes.as_bytes()),
                bytes: bytes.len() as u64,
                seconds: if dice.unit() < 0.8 { 0.1 } else { 5.0 },
                metrics: vec![],
                warnings: match from == made[0].0 {
                    true => vec![format!("{} is odd", capture.name).into()],
                    false => vec![],
                },
                provenance,
            };
            let key = record.key();
            store.remember(key, bytes.as_bytes())?;
            store.keep(bytes.as_bytes(), record.seconds)?;
            store.create_record(key, &record)?;
            made.push((hex(record.content), shows));
            lines.push(serde_json::json!({ "node": n, "content": hex(record.content) }));
        }
        let head = serde_json::json!({ "program": "toy", "seconds": 1.0,
            "of": { "pipeline": "p", "variant": null, "inputs": { "turn": folder } } });
        let lists = serde_json::json!({ "turn": hashes });
        let text = format!("{head}\n{lists}\n");
        let id = store.next_run()?;
        store.write(&format!("runs/{id}.jsonl"), capture.name.as_bytes())?;
        store.write(&format!("runs/{id}.json"), text.as_bytes())?;
        let plan = serde_json::json!({ "inputs": [{ "folder": folder, "files": [] }] }).to_string();
        let name = hex(blake3::hash(plan.as_bytes()));
        store.write(&format!("plans/{name}"), plan.as_bytes())?;
        let index = store.index().bytes(i64::MAX);
        store.write("index", &index)
    }

    /// One thing that goes wrong on a disk.
    pub(super) fn spoil(&self, dice: &mut Dice) {
        let all: Vec<PathBuf> = below(&self.root())
            .into_iter()
            .filter(|p| p.file_name().is_some_and(|n| n != "format"))
            .collect();
        if all.is_empty() {
            return;
        }
        let path = &all[dice.bits() as usize % all.len()];
        let mut bytes = std::fs::read(path).unwrap();
        match dice.bits() % 4 {
            0 => std::fs::remove_file(path).unwrap(),
            1 if !bytes.is_empty() => {
                let at = dice.bits() as usize % bytes.len();
                bytes[at] ^= 1 << (dice.bits() % 8);
                std::fs::write(path, bytes).unwrap();
            }
            2 => std::fs::write(path, &bytes[..bytes.len() / 2]).unwrap(),
            _ => {
                // What a killed run was writing; this process has its number now.
                let name = format!("tmp/{}-0-{:x}", std::process::id(), dice.bits());
                let photos = &self.captures[0].photos;
                std::fs::create_dir_all(self.root().join("tmp")).unwrap();
                std::fs::write(self.root().join(name), photos).unwrap();
            }
        }
    }

    /// Holds the store to having nothing of the first capture.
    pub(super) fn clean(&self, round: &str) {
        assert_eq!(self.left(), None, "{round}");
    }

    /// What the store has of the first capture.
    pub(super) fn left(&self) -> Option<String> {
        for path in below(&self.root()) {
            let bytes = std::fs::read(&path).unwrap();
            let text = String::from_utf8_lossy(&bytes);
            let capture = &self.captures[0];
            for needle in [&capture.photos, &capture.name] {
                if text.contains(needle) {
                    return Some(format!("{needle} in {}", path.display()));
                }
            }
        }
        None
    }
}
