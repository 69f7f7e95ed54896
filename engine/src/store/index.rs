//! What was verified, remembered by the stamp of its file: a run that makes nothing opens no blob.
//!
//! The index holds copies of records and may be deleted at any time. An entry counts while the
//! blob's size, inode and time of change are those of when it was last read and found whole.
//! Unlike the time of modification, the time of change cannot be set back by a program. What
//! changed within a second of the index being written is left out (the racy-timestamp rule), and
//! what is loaded to be used is verified whatever the index has.
//!
//! ```text
//! 0    magic "STAGEIDX"     8 bytes (before version 0.2.0 "TAILORIX": the same layout)
//! 8    blake3 of the rest   32 bytes
//! 40   entries: key 32, content 32, size u64, inode u64, changed i64, seconds f64,
//!      length of notes u32, notes (JSON: metrics and warnings; empty for none)
//! ```

use super::metrics::MetricText;
use super::record::Record;
use stage::{Hash, Message};
use std::collections::HashMap;
use std::hash::{BuildHasherDefault, Hasher};
use std::path::Path;

const MAGIC: &[u8; 8] = b"STAGEIDX";

/// What it was before the engine was a crate of its own: the same layout.
const FORMER: &[u8; 8] = b"TAILORIX";

const RACY_NS: i64 = 1_000_000_000;
/// Of an entry without notes.
const LEAST_ENTRY_BYTES: usize = 100;

/// A file's size, inode and time of change. \[bytes, 1, ns\]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Stamp(u64, u64, i64);

impl Stamp {
    pub(super) fn of(path: &Path) -> Option<Stamp> {
        let now = system::Stamp::of(&std::fs::metadata(path).ok()?);
        Some(Stamp(now.size, now.inode, now.changed_ns as i64))
    }
}

#[derive(Debug, Clone)]
pub(super) struct Entry {
    pub(super) content: [u8; 32],
    stamp: Stamp,
    seconds: f64,
    notes: Vec<u8>,
    /// The blob's stamp as it was seen a moment ago, to be used once; see [`super::prefetch`].
    pub(super) seen: Option<Option<Stamp>>,
}

impl Entry {
    /// Of a record whose blob was found whole.
    pub(super) fn of(record: &Record, stamp: Stamp) -> Entry {
        Entry {
            content: *record.content.as_bytes(),
            stamp,
            seconds: record.seconds,
            notes: notes(record),
            seen: None,
        }
    }

    /// Whether its blob is still the one that was read.
    pub(super) fn is_of(&self, stamp: Stamp) -> bool {
        self.stamp == stamp
    }

    pub(super) fn record(&self) -> Record {
        let (metrics, warnings): Notes = match self.notes.is_empty() {
            true => Notes::default(),
            false => serde_json::from_slice(&self.notes).unwrap_or_default(),
        };
        Record {
            provenance: vec![],
            content: Hash::from_bytes(self.content),
            bytes: self.stamp.0,
            seconds: self.seconds,
            metrics: metrics.into_iter().map(MetricText::metric).collect(),
            warnings,
        }
    }
}

/// What was noted of a result: its metrics and warnings.
type Notes = (Vec<MetricText>, Vec<Message>);

/// A key is a hash: its first bits are as good as any.
#[derive(Default)]
pub(super) struct FirstBits(u64);

impl Hasher for FirstBits {
    fn finish(&self) -> u64 {
        self.0
    }
    fn write_usize(&mut self, _length: usize) {}
    fn write(&mut self, key: &[u8]) {
        if let Some(first) = key.first_chunk() {
            self.0 = u64::from_le_bytes(*first);
        }
    }
}

type Entries = HashMap<[u8; 32], Entry, BuildHasherDefault<FirstBits>>;

/// All entries by key, and whether there are new ones.
#[derive(Debug, Default)]
pub(super) struct Index {
    pub(super) entries: Entries,
    pub(super) fresh: bool,
    /// Whether the blobs of all entries have been looked at.
    pub(super) looked: bool,
}

impl Index {
    /// From its file; a torn one is as good as none.
    pub(super) fn load(path: &Path) -> Index {
        let file = std::fs::read(path).unwrap_or_default();
        Index {
            entries: parse(&file).unwrap_or_default(),
            ..Index::default()
        }
    }

    /// As if every blob of the size that it had were the file that it was: a disk may come back with
    /// size, inode and time of a file, and without its bytes.
    #[cfg(test)]
    pub(super) fn trust(&mut self, root: &Path) {
        self.entries.values_mut().for_each(|entry| {
            let path = crate::own::place(root, "cas", Hash::from_bytes(entry.content));
            let there = Stamp::of(&path).filter(|there| there.0 == entry.stamp.0);
            entry.stamp = there.unwrap_or(entry.stamp);
        });
    }

    pub(super) fn bytes(&self, now_ns: i64) -> Vec<u8> {
        let mut file = vec![0; 40];
        let steady = |e: &&Entry| now_ns - e.stamp.2 > RACY_NS;
        let mut entries: Vec<_> = self.entries.iter().filter(|(_, e)| steady(e)).collect();
        entries.sort_unstable_by_key(|(key, _)| **key);
        for (key, e) in entries {
            file.extend_from_slice(key);
            file.extend_from_slice(&e.content);
            file.extend_from_slice(&e.stamp.0.to_le_bytes());
            file.extend_from_slice(&e.stamp.1.to_le_bytes());
            file.extend_from_slice(&e.stamp.2.to_le_bytes());
            file.extend_from_slice(&e.seconds.to_le_bytes());
            file.extend_from_slice(&(e.notes.len() as u32).to_le_bytes());
            file.extend_from_slice(&e.notes);
        }
        file[..8].copy_from_slice(MAGIC);
        let hash = blake3::hash(&file[40..]);
        file[8..40].copy_from_slice(hash.as_bytes());
        file
    }
}

fn parse(file: &[u8]) -> Option<Entries> {
    let mut rest = file.get(40..)?;
    let known = [MAGIC, FORMER].iter().any(|magic| file[..8] == **magic);
    if !known || blake3::hash(rest).as_bytes() != &file[8..40] {
        return None;
    }
    fn take<const N: usize>(rest: &mut &[u8]) -> Option<[u8; N]> {
        let (head, tail) = rest.split_first_chunk::<N>()?;
        *rest = tail;
        Some(*head)
    }
    let mut entries = Entries::default();
    entries.reserve(rest.len() / LEAST_ENTRY_BYTES);
    while !rest.is_empty() {
        let (key, content) = (take::<32>(&mut rest)?, take::<32>(&mut rest)?);
        let (size, inode) = (take(&mut rest)?, take(&mut rest)?);
        let stamp = Stamp(
            u64::from_le_bytes(size),
            u64::from_le_bytes(inode),
            i64::from_le_bytes(take(&mut rest)?),
        );
        let seconds = f64::from_le_bytes(take(&mut rest)?);
        let length = u32::from_le_bytes(take(&mut rest)?) as usize;
        let (notes, tail) = rest.split_at_checked(length)?;
        let notes = notes.to_vec();
        rest = tail;
        entries.insert(
            key,
            Entry {
                content,
                stamp,
                seconds,
                notes,
                seen: None,
            },
        );
    }
    Some(entries)
}

fn notes(record: &Record) -> Vec<u8> {
    if record.metrics.is_empty() && record.warnings.is_empty() {
        return vec![];
    }
    let metrics = record.metrics.iter().map(MetricText::of).collect();
    let notes: Notes = (metrics, record.warnings.clone());
    serde_json::to_vec(&notes).expect("bug: notes JSON cannot hold")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_torn_index_is_none_and_a_whole_one_comes_back() {
        let entry = |n: u8| Entry {
            content: [n; 32],
            stamp: Stamp(7, 8, 9),
            seconds: 0.5,
            notes: vec![n; usize::from(n)],
            seen: None,
        };
        let mut index = Index::default();
        for n in 0..3 {
            index.entries.insert([n; 32], entry(n));
        }
        let bytes = index.bytes(i64::MAX);
        assert_eq!(parse(&bytes).unwrap().len(), 3);
        let former = [FORMER.as_slice(), &bytes[MAGIC.len()..]].concat();
        assert_eq!(parse(&former).unwrap().len(), 3);
        for end in 0..bytes.len() {
            assert!(parse(&bytes[..end]).is_none(), "{end}");
        }
        assert_eq!(
            parse(&index.bytes(9)).unwrap().len(),
            0,
            "racy ones stay out"
        );
    }
}
