//! Signatures by ed25519, and the files of their keys.
//!
//! A signing key: the line `stage signing key 1`, then 32 bytes in hexadecimal, then `until` and the last day that it is
//! good for; for its owner only. Beside it `.pub`: `ed25519 HEX until DAY`. Lists of those who are trusted: `trusted.rs`.
//! A signature is the word `ed25519:WHO:SIGNATURE`, both hexadecimal. Who is believed: `keys.rs`.

use crate::day;
use crate::key_file::{NoKey, disk, hex, text, unhex};
use crate::keys::{Lapsed, Pair};
use crate::trusted::{Public, Trusted};
use ring::rand::{SecureRandom, SystemRandom};
use ring::signature::{ED25519, Ed25519KeyPair, KeyPair, UnparsedPublicKey};
use std::io::Write;
use std::path::{Path, PathBuf};
use system::{is_private, private_file};

const HEAD: &str = "stage signing key 1";

/// What it was while the engine bore the name of its first product.
const FORMER: &str = "tailor signing key 1";

/// Makes a signing key in a new file that is good for so many days, and `.pub` beside it; returns the line of the latter.
///
/// # Errors
///
/// One of the files is there already, or cannot be written.
pub fn keygen(path: &Path, days: u32) -> Result<String, NoKey> {
    let until = day::today() + i64::from(days);
    let mut seed = [0; 32];
    let random = SystemRandom::new().fill(&mut seed);
    random.map_err(|_| disk(path)(std::io::Error::other("this system gives no random numbers")))?;
    let pair = Ed25519KeyPair::from_seed_unchecked(&seed).expect("bug: any 32 bytes are a seed");
    let public = Public {
        key: hex(pair.public_key().as_ref()),
        until: Some(until),
    };
    let (line, until) = (public.line(), stage::day_text(until));
    let mut beside = path.as_os_str().to_owned();
    beside.push(".pub");
    let beside = PathBuf::from(beside);
    let secret = format!("{HEAD}\n{}\nuntil {until}\n", hex(&seed));
    fresh(path, &secret)?;
    if let Err(why) = fresh(&beside, &format!("{line}\n")) {
        // A key that nobody could trust is not left behind.
        let _ = std::fs::remove_file(path);
        return Err(why);
    }
    Ok(line)
}

/// Writes a file for the owner only that is not there yet.
fn fresh(path: &Path, text: &str) -> Result<(), NoKey> {
    let mut open = std::fs::OpenOptions::new();
    let open = private_file(open.write(true).create_new(true)).open(path);
    let written = open.and_then(|mut file| file.write_all(text.as_bytes()));
    written.map_err(disk(path))
}

/// Who signs with ed25519, and who is believed.
pub type Keys = crate::keys::Keys<Ed25519KeyPair>;

impl Keys {
    /// From the file of a signing key, and from a list of those who are trusted. Who signs trusts itself.
    ///
    /// # Errors
    ///
    /// A file cannot be read, is none, or other users may read what is secret; the signing key is expired or revoked.
    pub fn read(sign: Option<&Path>, trust: Option<&Path>) -> Result<Keys, NoKey> {
        let own = sign.map(signing).transpose()?;
        let until = own.as_ref().and_then(|(_, public)| public.until);
        let trusted = trust.map(Trusted::read).transpose()?;
        Keys::of(own, trusted).map_err(|lapsed| NoKey::Wrong {
            path: sign.unwrap_or(Path::new("")).into(),
            what: match lapsed {
                Lapsed::Expired => format!(
                    "was good until {}: make a new one with `cache keygen`, and give its `.pub` to those who trust you",
                    until.map_or(String::new(), stage::day_text)
                ),
                Lapsed::Revoked => {
                    "is revoked by the file `revoked` beside the list of --trust".into()
                }
            },
        })
    }
}

fn signing(path: &Path) -> Result<(Ed25519KeyPair, Public), NoKey> {
    let text = text(path)?;
    if !is_private(path) {
        return Err(NoKey::Open(path.into()));
    }
    let mut lines = text.lines();
    let seed = match (lines.next(), lines.next()) {
        (Some(HEAD | FORMER), Some(seed)) => unhex::<32>(seed.trim()),
        _ => None,
    };
    let pair = seed.and_then(|seed| Ed25519KeyPair::from_seed_unchecked(&seed).ok());
    let none = || NoKey::Wrong {
        path: path.into(),
        what: "is no signing key: `cache keygen FILE` makes one".into(),
    };
    let pair = pair.ok_or_else(none)?;
    // Keys of earlier programs are good without end.
    let until = match lines.next() {
        None => None,
        Some(line) => {
            let until = line.trim().strip_prefix("until ").ok_or_else(none)?;
            Some(stage::day_number(until).ok_or_else(none)?)
        }
    };
    let key = hex(pair.public_key().as_ref());
    Ok((pair, Public { key, until }))
}

impl Pair for Ed25519KeyPair {
    fn sign(&self, message: &[u8]) -> [u8; 64] {
        let signature = Ed25519KeyPair::sign(self, message);
        signature.as_ref().try_into().expect("bug: 64 bytes")
    }

    fn is_by(key: &[u8; 32], message: &[u8], signature: &[u8; 64]) -> bool {
        UnparsedPublicKey::new(&ED25519, key)
            .verify(message, signature)
            .is_ok()
    }
}

#[cfg(test)]
#[path = "signature_tests.rs"]
mod tests;
