//! The records of a store: reading and writing them.

use super::error::StoreError;
use super::files::{self, Care};
use super::folder::Store;
use super::record::{Record, Unread, parse};
use stage::Hash;

impl Store {
    /// The record of a key. What is torn, corrupt, another key's or of another version is a miss.
    pub fn record(&self, key: Hash) -> Option<Record> {
        self.read_record(key).ok()
    }

    /// Whether the record of a key is what it says, as far as this version of the program knows.
    pub(super) fn is_sound(&self, key: Hash) -> bool {
        !matches!(self.read_record(key), Err(Unread::Corrupt))
    }

    /// What is corrupt is put aside; what another version of the program wrote is left as it is.
    fn read_record(&self, key: Hash) -> Result<Record, Unread> {
        let path = self.place("ac", key);
        let file = std::fs::read(&path).map_err(|_| Unread::Absent)?;
        // The key is the hash of the provenance, and the provenance is in what was hashed.
        let own = |record: Record| match record.key() == key {
            true => Ok(record),
            false => Err(Unread::Corrupt),
        };
        let read = parse(&file).and_then(own);
        if let Err(Unread::Corrupt) = read {
            self.quarantine(&path);
        }
        read
    }

    /// Writes the record of a key: the last step of publishing a result.
    ///
    /// # Errors
    ///
    /// The disk refuses.
    pub fn write_record(&self, key: Hash, record: &Record) -> Result<(), StoreError> {
        let file = record.file();
        let (tmp, path) = (self.fresh(), self.place("ac", key));
        let care = Care::worth(record.seconds);
        files::publish(self.disk(), &tmp, &path, file.as_bytes(), care)?;
        self.note_made(key, record);
        Ok(())
    }
}
