//! The records of a store: reading and writing them.

use super::error::StoreError;
use super::files::{self, Care};
use super::folder::Store;
use super::record::{Origin, Record, Unread, parse_with_origin};
use stage::Hash;
use std::io::ErrorKind;

impl Store {
    /// The record of a key. What is torn, corrupt, another key's or of another version is a miss.
    pub fn record(&self, key: Hash) -> Option<Record> {
        self.read_record(key).ok()
    }

    /// As [`Store::record`].
    ///
    /// # Errors
    ///
    /// The disk refuses: then nobody knows whether there is one.
    pub(super) fn record_on_disk(&self, key: Hash) -> Result<Option<Record>, StoreError> {
        match self.read_record(key) {
            Err(Unread::Disk(why)) => Err(files::at(&self.place("ac", key))(why)),
            record => Ok(record.ok()),
        }
    }

    /// Whether the record of a key is valid, as far as this version of the program knows.
    ///
    /// # Errors
    ///
    /// The disk refuses.
    pub(super) fn is_sound(&self, key: Hash) -> Result<bool, StoreError> {
        match self.read_record(key) {
            Err(Unread::Disk(why)) => Err(files::at(&self.place("ac", key))(why)),
            read => Ok(!matches!(read, Err(Unread::Corrupt))),
        }
    }

    /// What is corrupt is put aside; what another version of the program wrote is left as it is.
    pub(super) fn read_record(&self, key: Hash) -> Result<Record, Unread> {
        self.read_with_origin(key).map(|(record, _)| record)
    }

    /// The record of a key, and the origin that it names.
    pub(super) fn read_with_origin(&self, key: Hash) -> Result<(Record, Option<Origin>), Unread> {
        let path = self.place("ac", key);
        let file = std::fs::read(&path).map_err(|why| match why.kind() {
            ErrorKind::NotFound => Unread::Absent,
            _ => Unread::Disk(why),
        })?;
        // The key is the hash of the provenance, and the provenance is in what was hashed.
        let own = |read: (Record, Option<Origin>)| match read.0.key() == key {
            true => Ok(read),
            false => Err(Unread::Corrupt),
        };
        let read = parse_with_origin(&file).and_then(own);
        if let Err(Unread::Corrupt) = read {
            self.quarantine(&path);
        }
        read
    }

    /// Writes the record of a key, if there is none: the last step of publishing a result. Returns the
    /// record of somebody who was first, if its result is there.
    ///
    /// # Errors
    ///
    /// The disk refuses.
    pub fn create_record(&self, key: Hash, record: &Record) -> Result<Option<Record>, StoreError> {
        let (file, path) = (self.file_here(record), self.place("ac", key));
        let care = Care::worth(record.seconds);
        let shared = self.will_share_made(key);
        for _ in 0..2 {
            if files::publish_new(self.disk(), &self.fresh(), &path, file.as_bytes(), care)? {
                self.note_made(key, record);
                if shared {
                    self.offer(key);
                }
                return Ok(None);
            }
            match self.record(key) {
                Some(first) if self.holds(first.content) => {
                    self.secure(key, &first, record.seconds)?;
                    return Ok(Some(first));
                }
                // Its result went away: this one counts.
                Some(_) => break,
                // Torn or corrupt, and put aside by now.
                None => {}
            }
        }
        self.write_record(key, record).map(|()| None)
    }

    /// Makes the result of somebody who was first, and who may have left it to the system, as safe as one that took so
    /// long to make. \[s\]
    ///
    /// # Errors
    ///
    /// The disk refuses.
    pub fn secure(&self, key: Hash, first: &Record, seconds: f64) -> Result<(), StoreError> {
        if Care::worth(seconds) == Care::Durable {
            files::secure(self.disk(), &self.place("cas", first.content))?;
            files::secure(self.disk(), &self.place("ac", key))?;
        }
        Ok(())
    }

    /// Writes the record of a key, over what is there.
    ///
    /// # Errors
    ///
    /// The disk refuses.
    pub fn write_record(&self, key: Hash, record: &Record) -> Result<(), StoreError> {
        let file = self.file_here(record);
        let (tmp, path) = (self.fresh(), self.place("ac", key));
        let care = Care::worth(record.seconds);
        // Noted first: whoever is killed in between leaves a note too many, not one too few.
        let shared = self.will_share_made(key);
        files::publish(self.disk(), &tmp, &path, file.as_bytes(), care)?;
        self.note_made(key, record);
        if shared {
            self.offer(key);
        }
        Ok(())
    }
}
