//! Reading from a shared store: what is not here is brought here, verified as data from strangers.

use super::super::files::{self, Care};
use super::super::record::{Origin, Unread};
use super::framed::{self, Framed, MOST_BLOB};
use super::link::Link;
use crate::own;
use crate::store::Store;
use buckets::{Got, Trouble, at_most};
use stage::Hash;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread::Builder;
use system::clock;

/// Requests under way at a time, where many records are wanted.
const AT_A_TIME: usize = 16;

/// How many threads ask for so many records.
pub(super) fn askers(records: usize) -> usize {
    match clock::is_simulated() {
        true => 1,
        false => AT_A_TIME.min(records),
    }
}

/// The name of what is on a shelf under a hash.
pub(super) fn object(shelf: &str, hash: Hash) -> String {
    own::name(shelf, hash)
}

/// What came of reading a record there.
pub(super) enum Theirs {
    Absent,
    Whole(Framed),
    /// Corrupt: to be written over.
    Corrupt,
    /// Of another version of the program: left as it is.
    Other,
    /// Not signed by anybody who is trusted.
    Stranger,
}

impl Link {
    /// The record of a key.
    pub(super) fn record(&self, key: Hash) -> Result<Theirs, Trouble> {
        let name = object("ac", key);
        let found = match self.ask(&|| at_most(&*self.objects, &name, framed::MOST))? {
            (Got::Whole, found) => framed::parse(&found, key),
            (Got::Absent, _) => return Ok(Theirs::Absent),
            // Too large to be one.
            (Got::Stopped, _) => Err(Unread::Corrupt),
        };
        Ok(match found {
            Ok(framed) if self.believes(key, &framed) => Theirs::Whole(framed),
            Ok(_) => Theirs::Stranger,
            Err(Unread::OtherVersion) => Theirs::Other,
            Err(_) => Theirs::Corrupt,
        })
    }
}

impl Store {
    /// Whether the store is linked to a shared one.
    pub(crate) fn is_shared(&self) -> bool {
        self.link.is_some()
    }

    /// Brings the record of a key here, with its result if that is small; whether it did.
    pub(in crate::store) fn bring(&self, key: Hash) -> bool {
        let Some(link) = self
            .link
            .as_ref()
            .filter(|link| link.may_have(key.as_bytes()))
        else {
            return false;
        };
        match link.record(key) {
            Ok(Theirs::Whole(framed)) => self.take(link, key, &framed),
            Ok(Theirs::Absent | Theirs::Other) => {
                link.is_absent(*key.as_bytes());
                link.known().lose(key.as_bytes());
                false
            }
            Ok(Theirs::Stranger) => {
                link.is_absent(*key.as_bytes());
                link.known().lose(key.as_bytes());
                link.report_stranger(&object("ac", key));
                false
            }
            Ok(Theirs::Corrupt) => {
                link.is_absent(*key.as_bytes());
                link.report(&format!(
                    "{} is not what its name promises: it is not believed, and made again",
                    object("ac", key)
                ));
                false
            }
            Err(Trouble::Down(_)) => false,
            Err(Trouble::Refused(why)) => {
                link.is_absent(*key.as_bytes());
                link.report(&why);
                false
            }
        }
    }

    fn take(&self, link: &Link, key: Hash, framed: &Framed) -> bool {
        let write = |path: &Path, bytes: &[u8]| {
            files::publish(self.disk(), &self.fresh(), path, bytes, Care::Cheap).is_ok()
        };
        let blob = framed.blob.as_ref();
        let content = framed.record.content;
        // What is there may be synced: it is not written over.
        let there = || self.blob_here(content).is_some();
        let kept = blob.is_none_or(|blob| there() || write(&self.place("cas", content), blob));
        let file = framed.record.file();
        // A signature is of the bytes that came; where these cannot be written again, it proves nothing any more.
        let signature = framed.signature.clone();
        let origin = Origin::Brought {
            from: link.name().to_owned(),
            signature: signature.filter(|_| file.as_bytes() == framed.file),
        };
        let file = framed.record.file_of(Some(origin));
        let taken = kept && write(&self.place("ac", key), file.as_bytes());
        if taken {
            link.known().add(*key.as_bytes());
        }
        taken
    }

    /// Brings the records of keys that are not here, several at a time.
    pub fn bring_all(&self, keys: &[Hash]) {
        if !self.is_shared() {
            return;
        }
        let missing = |key: &&Hash| self.found_here(**key).is_none();
        let keys: Vec<&Hash> = keys.iter().filter(missing).collect();
        let next = AtomicUsize::new(0);
        let work = || {
            while let Some(key) = keys.get(next.fetch_add(1, Ordering::Relaxed)) {
                self.bring(**key);
            }
        };
        std::thread::scope(|scope| {
            for _ in 1..askers(keys.len()) {
                // Where the system gives no more threads, those that there are ask it all.
                let _ = Builder::new().spawn_scoped(scope, work);
            }
            work();
        });
    }

    /// Whether a result that is not here is in the shared store.
    pub(crate) fn is_elsewhere(&self, content: Hash) -> bool {
        let size = |link: &std::sync::Arc<Link>| {
            let name = object("cas", content);
            link.ask(&|| link.objects.size(&name)).ok().flatten()
        };
        self.link.as_ref().and_then(size).is_some()
    }

    /// Brings a result here, hashed while it comes; whether it is here now.
    pub(crate) fn fetch(&self, content: Hash) -> bool {
        if self.holds(content) {
            return true;
        }
        let Some(link) = &self.link else { return false };
        if link.queue().bad.contains(content.as_bytes()) {
            return false;
        }
        let (name, tmp) = (object("cas", content), self.fresh());
        let came = link.ask(&|| self.stream(link, &name, &tmp));
        let right = match came {
            // Still open, and so locked.
            Ok(Some((hash, _file))) if hash == content => {
                files::rename(&*self.disk, &tmp, &self.place("cas", content)).is_ok()
            }
            Ok(Some(_)) => {
                link.queue().bad.insert(*content.as_bytes());
                link.report(&format!(
                    "{name} has other bytes than its name promises: it is not believed, and made again"
                ));
                false
            }
            Ok(None) => {
                link.queue().absent.insert(*content.as_bytes());
                false
            }
            Err(Trouble::Down(_)) => false,
            Err(Trouble::Refused(why)) => {
                link.report(&why);
                false
            }
        };
        if !right {
            let _ = self.disk.remove(&tmp);
        }
        right
    }

    /// Writes an object into a file; the hash of its bytes, if there is one.
    fn stream(
        &self,
        link: &Link,
        name: &str,
        tmp: &Path,
    ) -> Result<Option<(Hash, std::fs::File)>, Trouble> {
        let _ = self.disk.remove(tmp);
        let disk = |why: std::io::Error| Trouble::Refused(format!("{}: {why}", tmp.display()));
        let mut file = files::create(&*self.disk, tmp).map_err(disk)?;
        let (mut hasher, mut failed, mut size) = (blake3::Hasher::new(), None, 0);
        let got = link.objects.get(name, &mut |part| {
            hasher.update(part);
            size += part.len() as u64;
            failed = self.disk.write(&mut file, tmp, part).err();
            failed.is_none() && size <= MOST_BLOB
        })?;
        match (got, failed) {
            (Got::Whole, None) => Ok(Some((hasher.finalize(), file))),
            (Got::Absent, _) => Ok(None),
            (_, Some(why)) => Err(disk(why)),
            (Got::Stopped, None) => Err(Trouble::Refused(format!(
                "{name} is larger than any result"
            ))),
        }
    }
}
