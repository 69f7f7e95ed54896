//! Records: what was made under a key, from what, and how long it took.

use super::files::{self, Care};
use super::{Store, StoreError};
use serde::{Deserialize, Serialize};
use stage::{Hash, Metric};

/// What was made under a key.
#[derive(Debug, Clone, PartialEq)]
pub struct Record {
    /// What the key was made of, line by line.
    pub story: Vec<(String, String)>,
    /// The result: its blob.
    pub content: Hash,
    /// Its size. \[bytes\]
    pub bytes: u64,
    /// How long it took. \[s\]
    pub seconds: f64,
    /// Numbers beside the result.
    pub metrics: Vec<Metric>,
    /// What the user should know.
    pub warnings: Vec<String>,
}

/// As it lies on disk, under a line with the hash of the rest.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    version: u32,
    story: Vec<(String, String)>,
    content: String,
    bytes: u64,
    seconds: f64,
    metrics: Vec<(String, f64, String)>,
    warnings: Vec<String>,
}

const VERSION: u32 = 1;

/// What every version of a record says first.
#[derive(Deserialize)]
struct Version {
    version: u32,
}

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
        // The key is the hash of the story, and the story is in what was hashed.
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
    pub fn write_record(&self, key: Hash, record: &Record) -> Result<(), StoreError> {
        let metric = |m: &Metric| (m.name.clone(), m.value, m.unit.clone());
        let written = Written {
            version: VERSION,
            story: record.story.clone(),
            content: record.content.to_hex().to_string(),
            bytes: record.bytes,
            seconds: record.seconds,
            metrics: record.metrics.iter().map(metric).collect(),
            warnings: record.warnings.clone(),
        };
        let body = serde_json::to_string_pretty(&written).expect("bug: a record JSON cannot hold");
        let file = format!(
            "{}\n{body}\n",
            blake3::hash(format!("{body}\n").as_bytes()).to_hex()
        );
        let (tmp, path) = (self.fresh(), self.place("ac", key));
        let care = Care::worth(record.seconds);
        files::publish(self.disk(), &tmp, &path, file.as_bytes(), care)?;
        self.note_made(key, record);
        Ok(())
    }
}

impl Record {
    /// The key that it is of.
    fn key(&self) -> Hash {
        crate::key::of(&self.story)
    }
}

/// Why a file gives no record.
enum Unread {
    Absent,
    Corrupt,
    OtherVersion,
}

/// A record from the bytes of its file.
fn parse(file: &[u8]) -> Result<Record, Unread> {
    let end = file.iter().position(|b| *b == b'\n');
    let (hash, body) = file.split_at(end.ok_or(Unread::Corrupt)?);
    let body = &body[1..];
    if blake3::hash(body).to_hex().as_bytes() != hash {
        return Err(Unread::Corrupt);
    }
    let Ok(written) = serde_json::from_slice::<Written>(body) else {
        let version = serde_json::from_slice::<Version>(body).map(|v| v.version);
        return Err(match version {
            Ok(version) if version != VERSION => Unread::OtherVersion,
            _ => Unread::Corrupt,
        });
    };
    if written.version != VERSION {
        return Err(Unread::OtherVersion);
    }
    let metric = |(name, value, unit)| Metric { name, value, unit };
    Ok(Record {
        story: written.story,
        content: Hash::from_hex(&written.content).map_err(|_| Unread::Corrupt)?,
        bytes: written.bytes,
        seconds: written.seconds,
        metrics: written.metrics.into_iter().map(metric).collect(),
        warnings: written.warnings,
    })
}
