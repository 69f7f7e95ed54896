//! What a store knows of a key, from its index or from the record.

use super::files::{self, Care};
use super::folder::Store;
use super::index::{Entry, Index, Stamp};
use super::record::Record;
use stage::Hash;

/// What is known of a key.
#[derive(Debug, Clone, PartialEq)]
pub struct Found {
    /// What was made. Its provenance is empty where the index knew the answer.
    pub record: Record,
    /// Whether the result is there. If not, its content is known all the same, and it need not be
    /// made again before somebody reads it.
    pub present: bool,
}

impl Store {
    /// The record of a key, and whether its result is there: the one question of a walk. A result
    /// that is there but corrupt is a miss. A record that is not here and is in a shared store is brought
    /// here.
    pub fn found(&self, key: Hash) -> Option<Found> {
        let here = self.found_here(key);
        here.or_else(|| self.bring(key).then(|| self.found_here(key)).flatten())
    }

    /// As [`Store::found`], of what is here.
    pub fn found_here(&self, key: Hash) -> Option<Found> {
        let known = {
            let mut index = self.index();
            let entry = index.entries.get_mut(key.as_bytes());
            entry.map(|e| (e.seen.take(), e.clone()))
        };
        if let Some((seen, entry)) = known {
            let content = Hash::from_bytes(entry.content);
            let stamp = seen.unwrap_or_else(|| Stamp::of(&self.place("cas", content)));
            // The index may know a record that went because its result was corrupt.
            let counts = match stamp {
                Some(stamp) => entry.is_of(stamp),
                None => self.place("ac", key).is_file(),
            };
            if counts {
                let present = stamp.is_some();
                let record = entry.record();
                return Some(Found { record, present });
            }
        }
        let record = self.record(key)?;
        let stamp = Stamp::of(&self.place("cas", record.content));
        if let Some(stamp) = stamp {
            if self.blob_here(record.content).is_none() {
                // Corrupt: made again at once, so that the store is whole again.
                let _ = self.disk.remove(&self.place("ac", key));
                return None;
            }
            self.note(key, &record, stamp);
        }
        let present = stamp.is_some();
        Some(Found { record, present })
    }

    /// Remembers that the blob of a record was found whole.
    fn note(&self, key: Hash, record: &Record, stamp: Stamp) {
        let entry = Entry::of(record, stamp);
        let mut index = self.index();
        index.entries.insert(*key.as_bytes(), entry);
        index.fresh = true;
    }

    /// Remembers a result that was just published.
    pub(super) fn note_made(&self, key: Hash, record: &Record) {
        if let Some(stamp) = Stamp::of(&self.place("cas", record.content)) {
            self.note(key, record, stamp);
        }
    }

    /// Writes the index if there is something new, with what other processes wrote meanwhile.
    /// Best effort: without an index the next run reads more.
    pub fn save_index(&self) {
        let path = self.root().join("index");
        let mut index = self.index();
        if !std::mem::replace(&mut index.fresh, false) {
            return;
        }
        let theirs = Index::load(&path).entries.into_iter();
        theirs.for_each(|(key, entry)| _ = index.entries.entry(key).or_insert(entry));
        let bytes = index.bytes(system::clock::now_ns() as i64);
        let _ = files::publish(self.disk(), &self.fresh(), &path, &bytes, Care::Cheap);
    }
}

impl Store {
    /// Looks at the blobs of all entries on several threads, ahead of a walk of so many nodes
    /// that is going to ask for most of them.
    pub(crate) fn look_around(&self, nodes: usize) {
        let mut index = self.index();
        index.look_around(self.root(), nodes);
    }
}
