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

impl Store {
    /// The record of a key. What is torn, corrupt or of another version is a miss.
    pub fn record(&self, key: Hash) -> Option<Record> {
        let path = self.place("ac", key);
        let file = std::fs::read(&path).ok()?;
        let record = parse(&file);
        if record.is_none() {
            self.quarantine(&path);
        }
        record
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
        files::publish(&tmp, &path, file.as_bytes(), Care::worth(record.seconds))?;
        self.note_made(key, record);
        Ok(())
    }
}

/// A record from the bytes of its file.
fn parse(file: &[u8]) -> Option<Record> {
    let end = file.iter().position(|b| *b == b'\n')?;
    let (hash, body) = (std::str::from_utf8(&file[..end]).ok()?, &file[end + 1..]);
    if blake3::hash(body).to_hex().as_str() != hash {
        return None;
    }
    let written: Written = serde_json::from_slice(body).ok()?;
    if written.version != VERSION {
        return None;
    }
    let metric = |(name, value, unit)| Metric { name, value, unit };
    Some(Record {
        story: written.story,
        content: Hash::from_hex(&written.content).ok()?,
        bytes: written.bytes,
        seconds: written.seconds,
        metrics: written.metrics.into_iter().map(metric).collect(),
        warnings: written.warnings,
    })
}
