//! Records: what was made under a key, from what, and how long it took.

use super::metrics::MetricText;
use serde::{Deserialize, Serialize};
use stage::{Hash, Message, Metric};

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
    pub warnings: Vec<Message>,
}

/// Where a record was made. No key and no result has any of it, and no other store gets it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase", deny_unknown_fields)]
pub(super) enum Origin {
    /// In the store of this mark (`origin.rs`).
    Here(String),
    /// Elsewhere, and brought.
    Brought {
        /// By which shared store.
        from: String,
        /// The signature that it came with.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        signature: Option<String>,
    },
}

/// As it is on disk, under a line with the hash of the rest.
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
    /// Before version 4 sentences only.
    warnings: Vec<Message>,
    /// Since version 3; without it, it is not known where it was made.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    origin: Option<Origin>,
}

const VERSION: u32 = 4;

/// Without a warning that has a code, programs read it that know none.
const WITHOUT_CODES: u32 = 3;

/// What other stores get, without where it was made.
const SHARED_VERSION: u32 = 2;

/// No stage takes longer: some thirty years, so that sums of what strangers send stay numbers. \[s\]
const LONGEST_S: f64 = 1e9;

/// Versions that are read.
const READABLE: std::ops::RangeInclusive<u32> = 1..=VERSION;

/// What every version of a record has first.
#[derive(Deserialize)]
struct Version {
    version: u32,
}

impl Record {
    /// The key that it is of.
    pub(super) fn key(&self) -> Hash {
        crate::key::of(&self.provenance)
    }

    /// The bytes of its file in a shared store, as they are signed.
    pub(super) fn file(&self) -> String {
        self.written(self.version(SHARED_VERSION), None)
    }

    /// The bytes of its file here.
    pub(super) fn file_of(&self, origin: Option<Origin>) -> String {
        self.written(self.version(WITHOUT_CODES), origin)
    }

    /// The version that it is written as, where that without codes of warnings is another.
    fn version(&self, without_codes: u32) -> u32 {
        let coded = self.warnings.iter().any(|w| !w.code().is_empty());
        if coded { VERSION } else { without_codes }
    }

    fn written(&self, version: u32, origin: Option<Origin>) -> String {
        let written = Written {
            version,
            origin,
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
    /// The disk refuses.
    Disk(std::io::Error),
}

/// A record from the bytes of its file.
pub(super) fn parse(file: &[u8]) -> Result<Record, Unread> {
    parse_with_origin(file).map(|(record, _)| record)
}

/// A record from the bytes of its file, and the origin that it names.
pub(super) fn parse_with_origin(file: &[u8]) -> Result<(Record, Option<Origin>), Unread> {
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
    if !(0.0..=LONGEST_S).contains(&written.seconds) {
        return Err(Unread::Corrupt);
    }
    let record = Record {
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
    };
    Ok((record, written.origin))
}
