//! What waits to be uploaded, on disk: `waiting/KEY-TAG` in the store, written before the record itself,
//! removed when the shared store has it. So whatever is killed or cut off, the next one goes on.

use super::link::{Link, MOST_QUEUED};
use crate::own;
use crate::store::{Record, Store, StoreError};
use stage::Hash;
use std::collections::BTreeSet;

const FOLDER: &str = "waiting";

fn name(key: &[u8; 32], tag: &str) -> String {
    format!("{}-{tag}", Hash::from_bytes(*key).to_hex())
}

fn key(name: &str) -> Option<Hash> {
    Hash::from_hex(name.get(..64)?).ok()
}

/// The keys that wait for the place of a link.
///
/// # Errors
///
/// The disk refuses: then nobody knows what waits.
pub(super) fn of(store: &Store, link: &Link) -> Result<Vec<Hash>, StoreError> {
    let mine = |name: &str| own::is_waiting(name) && name.ends_with(&link.tag);
    let names = store.files(FOLDER, mine)?;
    Ok(names.iter().filter_map(|name| key(name)).collect())
}

/// Whether there is a record of a key, or the disk refuses it, which the upload reports.
pub(super) fn is_made(store: &Store, key: Hash) -> bool {
    !matches!(store.record_on_disk(key), Ok(None))
}

/// It is there now, or never will be.
pub(super) fn remove(store: &Store, link: &Link, key: Hash) {
    own::remove(store.root(), &[FOLDER], &name(key.as_bytes(), &link.tag));
}

impl Store {
    /// Notes that a result is to be uploaded, and offers it; whoever holds the link goes on from there.
    /// What is known to be there already is not noted.
    pub(crate) fn share(&self, key: Hash) {
        if self.will_share(key) {
            self.offer(key);
        }
    }

    /// As [`Store::share`], for a result that was made in so long though its record was known: it is as safe now as one
    /// that nobody knew, and what the shared store lacks of it, or has wrong, goes there. \[s\]
    ///
    /// # Errors
    ///
    /// The disk refuses.
    pub(crate) fn made_again(
        &self,
        key: Hash,
        first: &Record,
        seconds: f64,
    ) -> Result<(), StoreError> {
        self.secure(key, first, seconds)?;
        let (Some(link), content) = (&self.link, first.content) else {
            return Ok(());
        };
        let lacks = {
            let mut queue = link.queue();
            let absent = queue.absent.remove(content.as_bytes());
            absent || queue.bad.contains(content.as_bytes())
        };
        if lacks {
            link.known().lose(key.as_bytes());
        }
        self.share(key);
        Ok(())
    }

    /// As [`Store::will_share`], of what is made here now: whoever signs signs it, whatever was there before.
    pub(in crate::store) fn will_share_made(&self, key: Hash) -> bool {
        if let Some(link) = self.link.as_ref().filter(|link| link.signs()) {
            link.known().lose(key.as_bytes());
        }
        self.will_share(key)
    }

    /// Notes on disk that the result of a key is to be uploaded; whether there is anything to upload.
    pub(in crate::store) fn will_share(&self, key: Hash) -> bool {
        let Some(link) = self.link.as_ref().filter(|link| !link.read_only) else {
            return false;
        };
        if link.known().has(key.as_bytes()) {
            return false;
        }
        // A full disk is reported when the result itself is written.
        let note = format!("{FOLDER}/{}", name(key.as_bytes(), &link.tag));
        self.write(&note, b"").is_ok()
    }

    /// Offers what was noted to who uploads.
    pub(in crate::store) fn offer(&self, key: Hash) {
        let Some(link) = &self.link else { return };
        let mut queue = link.queue();
        match queue.keys.len() < MOST_QUEUED {
            true if queue.queued.insert(*key.as_bytes()) => queue.keys.push_back(*key.as_bytes()),
            true => {}
            false => queue.more = true,
        }
        drop(queue);
        link.bell.notify_all();
    }

    /// The contents of what waits, whatever for: they stay in the store.
    ///
    /// # Errors
    ///
    /// The disk refuses: then nobody knows what waits.
    pub(in crate::store) fn waiting_contents(&self) -> Result<BTreeSet<String>, StoreError> {
        let mut contents = BTreeSet::new();
        for name in self.files(FOLDER, own::is_waiting)? {
            let record = key(&name).map(|key| self.record_on_disk(key));
            let content = record.transpose()?.flatten().map(|record| record.content);
            contents.extend(content.map(|content| content.to_hex().to_string()));
        }
        Ok(contents)
    }

    /// Lets go of what waits of some keys, whatever for.
    pub(in crate::store) fn forget_waiting(&self, keys: &[Hash]) -> Result<(), StoreError> {
        let keys: BTreeSet<String> = keys.iter().map(|k| k.to_hex().to_string()).collect();
        let mine = |name: &str| own::is_waiting(name) && keys.contains(&name[..64]);
        self.all_gone(FOLDER, mine).map(|_| ())
    }
}
