//! Keys of a story: whose they are, until which day they count, and the lists of those who are trusted, as files that the
//! engine reads. Signatures alone are made otherwise: they cost nothing.

use super::seam;
use buckets::{KeysOf, Pair, Public, Trusted};
use std::path::Path;

/// A key.
#[derive(Clone)]
pub(super) struct Key {
    pub(super) bytes: [u8; 32],
    /// The last day that it counts, since 1970.
    pub(super) until: Option<i64>,
}

impl Key {
    /// The key of a number, of whoever has that name.
    pub(super) fn of(name: &str, number: usize, until: Option<i64>) -> Key {
        let bytes = *blake3::hash(format!("{name} {number}").as_bytes()).as_bytes();
        Key { bytes, until }
    }

    fn public(&self) -> Public {
        Public {
            key: blake3::Hash::from_bytes(self.bytes).to_hex().to_string(),
            until: self.until,
        }
    }
}

/// Who signs with a key, and believes those in a list.
pub(super) fn seal(own: &Key, list: &Path) -> Result<KeysOf<Word>, String> {
    let trusted = Trusted::read(list).map_err(|why| why.to_string())?;
    let own = (Word(own.bytes), own.public());
    KeysOf::of(Some(own), Some(trusted)).map_err(|lapsed| format!("a key is {lapsed:?}"))
}

/// A stranger, who signs with a key on any day, and believes everybody.
pub(super) fn strange(own: &Key) -> KeysOf<Word> {
    let until = None;
    let own = (
        Word(own.bytes),
        Public {
            until,
            ..own.public()
        },
    );
    KeysOf::of(Some(own), None).unwrap_or_else(|lapsed| panic!("a key is {lapsed:?}"))
}

/// Writes a list, and beside it another of those who are trusted no longer.
pub(super) fn list(at: &Path, keys: &[Key], revoked: &[Key]) {
    let lines = |keys: &[Key]| {
        let lines = keys.iter().map(|key| key.public().line() + "\n");
        lines.collect::<String>()
    };
    std::fs::write(at, lines(keys)).expect("a list");
    std::fs::write(at.with_file_name("revoked"), lines(revoked)).expect("a list");
}

/// A key whose signature is a hash of it and the message.
pub(super) struct Word([u8; 32]);

fn word(key: &[u8; 32], message: &[u8]) -> [u8; 64] {
    let mut bytes = [0; 64];
    let mut hasher = blake3::Hasher::new_keyed(key);
    hasher.update(message).finalize_xof().fill(&mut bytes);
    bytes
}

impl Pair for Word {
    fn sign(&self, message: &[u8]) -> [u8; 64] {
        seam::signed(&self.0);
        word(&self.0, message)
    }

    fn is_by(key: &[u8; 32], message: &[u8], signature: &[u8; 64]) -> bool {
        let is = word(key, message) == *signature;
        if is {
            seam::believed(key);
        }
        is
    }
}
