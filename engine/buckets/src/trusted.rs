//! Lists of public keys: who is trusted, until when, and who is not any more.
//!
//! A line is `ed25519 HEX`, or `ed25519 HEX until 2027-11-25`; `#` begins a comment. A file `revoked` beside the list of
//! those who are trusted has lines of the same form: what they signed counts no longer, whenever they did.

use crate::day;
use crate::key_file::{METHOD, NoKey, text, unhex};
use std::path::Path;

/// A public key, and the last day that it counts.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Public {
    /// In hexadecimal.
    pub key: String,
    /// The day, if there is one. \[days since 1970\]
    pub until: Option<i64>,
}

impl Public {
    /// Its line in a list.
    pub fn line(&self) -> String {
        let until = self.until.map(stage::day_text);
        let until = until.map_or(String::new(), |day| format!(" until {day}"));
        format!("{METHOD} {}{until}", self.key)
    }

    /// Whether it counts on a day.
    pub(crate) fn counts(&self, today: i64) -> bool {
        self.until.is_none_or(|until| today <= until)
    }
}

/// Those who are trusted.
pub struct Trusted {
    keys: Vec<Public>,
    revoked: Vec<String>,
}

impl Trusted {
    /// From a list, and the file `revoked` beside it, if there is one.
    ///
    /// # Errors
    ///
    /// One of them cannot be read or is no such list; or no key of the first counts today.
    pub fn read(path: &Path) -> Result<Trusted, NoKey> {
        let keys = listed(path)?;
        let beside = path.with_file_name("revoked");
        let revoked = match beside.exists() {
            true => listed(&beside)?
                .into_iter()
                .map(|public| public.key)
                .collect(),
            false => vec![],
        };
        let trusted = Trusted { keys, revoked };
        let wrong = |what: &str| NoKey::Wrong {
            path: path.into(),
            what: what.into(),
        };
        match &trusted.keys[..] {
            [] => Err(wrong("has no public key: nothing could be believed")),
            keys if keys.iter().all(|public| !trusted.has(&public.key)) => Err(wrong(
                "has no key that counts today: all are expired or revoked",
            )),
            _ => Ok(trusted),
        }
    }

    /// Whether somebody is trusted today.
    pub(crate) fn has(&self, key: &str) -> bool {
        let today = day::today();
        let known = self.keys.iter().any(|p| p.key == key && p.counts(today));
        known && !self.is_revoked(key)
    }

    /// Whether somebody is trusted no longer.
    pub(crate) fn is_revoked(&self, key: &str) -> bool {
        self.revoked.iter().any(|revoked| revoked == key)
    }

    /// Trusts one more.
    pub(crate) fn add(&mut self, public: Public) {
        self.keys.push(public);
    }
}

/// A public key out of the words of a line; none if it is no such line.
pub(crate) fn public(line: &str) -> Option<Public> {
    let words: Vec<&str> = line.split_whitespace().collect();
    let (key, until) = match words[..] {
        [METHOD, key] => (key, None),
        [METHOD, key, "until", until] => (key, Some(stage::day_number(until)?)),
        _ => return None,
    };
    unhex::<32>(key)?;
    let key = key.to_lowercase();
    Some(Public { key, until })
}

/// The keys of a list.
fn listed(path: &Path) -> Result<Vec<Public>, NoKey> {
    let mut keys = Vec::new();
    for (at, line) in text(path)?.lines().enumerate() {
        let line = line.split('#').next().unwrap_or_default();
        if line.trim().is_empty() {
            continue;
        }
        keys.push(public(line).ok_or_else(|| NoKey::Wrong {
            path: path.into(),
            what: format!(
                "line {} is no public key: write `{METHOD} HEX` or `{METHOD} HEX until 2027-11-25`, as in the file `.pub` beside a signing key",
                at + 1
            ),
        })?);
    }
    Ok(keys)
}
