//! Records: what was made under a key, from what, and how long it took.

use super::metrics::MetricText;
use serde::{Deserialize, Serialize};
use stage::{Hash, Metric};

/// What was made under a key.
#[derive(Debug, Clone, PartialEq)]
pub struct Record {
    /// What the key was made of, line by line.
    pub provenance: Vec<(String, String)>,
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
    /// `story` in version 1.
    #[serde(alias = "story")]
    provenance: Vec<(String, String)>,
    content: String,
    bytes: u64,
    seconds: f64,
    metrics: Vec<MetricText>,
    warnings: Vec<String>,
}

const VERSION: u32 = 2;

/// Versions that are read.
const READABLE: std::ops::RangeInclusive<u32> = 1..=VERSION;

/// What every version of a record says first.
#[derive(Deserialize)]
struct Version {
    version: u32,
}

impl Record {
    /// The key that it is of.
    pub(super) fn key(&self) -> Hash {
        crate::key::of(&self.provenance)
    }

    /// The bytes of its file.
    pub(super) fn file(&self) -> String {
        let written = Written {
            version: VERSION,
            provenance: self.provenance.clone(),
            content: self.content.to_hex().to_string(),
            bytes: self.bytes,
            seconds: self.seconds,
            metrics: self.metrics.iter().map(MetricText::of).collect(),
            warnings: self.warnings.clone(),
        };
        let body = serde_json::to_string_pretty(&written).expect("bug: a record JSON cannot hold");
        let hash = blake3::hash(format!("{body}\n").as_bytes()).to_hex();
        format!("{hash}\n{body}\n")
    }
}

/// Why a file gives no record.
pub(super) enum Unread {
    Absent,
    Corrupt,
    OtherVersion,
}

/// A record from the bytes of its file.
pub(super) fn parse(file: &[u8]) -> Result<Record, Unread> {
    let end = file.iter().position(|b| *b == b'\n');
    let (hash, body) = file.split_at(end.ok_or(Unread::Corrupt)?);
    let body = &body[1..];
    if blake3::hash(body).to_hex().as_bytes() != hash {
        return Err(Unread::Corrupt);
    }
    let Ok(written) = serde_json::from_slice::<Written>(body) else {
        let version = serde_json::from_slice::<Version>(body).map(|v| v.version);
        return Err(match version {
            Ok(version) if !READABLE.contains(&version) => Unread::OtherVersion,
            _ => Unread::Corrupt,
        });
    };
    if !READABLE.contains(&written.version) {
        return Err(Unread::OtherVersion);
    }
    Ok(Record {
        provenance: written.provenance,
        content: Hash::from_hex(&written.content).map_err(|_| Unread::Corrupt)?,
        bytes: written.bytes,
        seconds: written.seconds,
        metrics: written
            .metrics
            .into_iter()
            .map(MetricText::metric)
            .collect(),
        warnings: written.warnings,
    })
}
