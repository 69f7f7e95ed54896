//! Signatures by ed25519, and the files of their keys.
//!
//! A signing key: the line `stage signing key 1`, then 32 bytes in hexadecimal, then `until` and the last day that it is
//! good for; for its owner only. Beside it `.pub`: `ed25519 HEX until DAY`. Lists of those who are trusted: `trusted.rs`.
//! A signature is the word `ed25519:WHO:SIGNATURE`, both hexadecimal.

use super::day;
use super::key_file::{METHOD, NoKey, disk, hex, text, unhex};
use super::seal::Seal;
use super::trusted::{Public, Trusted};
use crate::system::{is_private, private_file};
use ring::rand::{SecureRandom, SystemRandom};
use ring::signature::{ED25519, Ed25519KeyPair, KeyPair, UnparsedPublicKey};
use std::io::Write;
use std::path::{Path, PathBuf};

const HEAD: &str = "stage signing key 1";

/// What it was while the engine bore the name of its first product.
const FORMER: &str = "tailor signing key 1";

/// Makes a signing key in a new file that is good for so many days, and `.pub` beside it; returns the line of the latter.
///
/// # Errors
///
/// One of the files is there already, or cannot be written.
pub fn keygen(path: &Path, days: u32) -> Result<String, NoKey> {
    let until = day::text(day::today() + i64::from(days));
    let mut seed = [0; 32];
    let random = SystemRandom::new().fill(&mut seed);
    random.map_err(|_| disk(path)(std::io::Error::other("this system gives no random numbers")))?;
    let pair = Ed25519KeyPair::from_seed_unchecked(&seed).expect("bug: any 32 bytes are a seed");
    let line = format!("{METHOD} {} until {until}", hex(pair.public_key().as_ref()));
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

/// Who signs, and who is believed.
pub struct Keys {
    pair: Option<(Ed25519KeyPair, String)>,
    /// `None` believes everybody.
    trusted: Option<Trusted>,
}

impl Keys {
    /// From the file of a signing key, and from a list of those who are trusted. Who signs trusts itself.
    ///
    /// # Errors
    ///
    /// A file cannot be read, is none, or others may read what is secret; the signing key is expired or revoked.
    pub fn read(sign: Option<&Path>, trust: Option<&Path>) -> Result<Keys, NoKey> {
        Keys::read_on(day::today(), sign, trust)
    }

    /// As [`Keys::read`], on a day.
    fn read_on(today: i64, sign: Option<&Path>, trust: Option<&Path>) -> Result<Keys, NoKey> {
        let pair = sign.map(|path| signing(path, today)).transpose()?;
        let mut trusted = trust.map(|path| Trusted::read(path, today)).transpose()?;
        if let (Some((_, own)), Some(trusted), Some(path)) = (&pair, &mut trusted, sign) {
            if trusted.is_revoked(own) {
                return Err(NoKey::Wrong {
                    path: path.into(),
                    what: "is revoked by the file `revoked` beside the list of --trust".into(),
                });
            }
            trusted.add(Public {
                key: own.clone(),
                until: None,
            });
        }
        Ok(Keys { pair, trusted })
    }
}

fn signing(path: &Path, today: i64) -> Result<(Ed25519KeyPair, String), NoKey> {
    let text = text(path)?;
    if !is_private(path) {
        return Err(NoKey::Open(path.into()));
    }
    let wrong = |what: String| NoKey::Wrong {
        path: path.into(),
        what,
    };
    let mut lines = text.lines();
    let seed = match (lines.next(), lines.next()) {
        (Some(HEAD | FORMER), Some(seed)) => unhex::<32>(seed.trim()),
        _ => None,
    };
    let pair = seed.and_then(|seed| Ed25519KeyPair::from_seed_unchecked(&seed).ok());
    let none = || wrong("is no signing key: `cache keygen FILE` makes one".into());
    let pair = pair.ok_or_else(none)?;
    // Keys of earlier programs are good without end.
    if let Some(line) = lines.next() {
        let until = line.trim().strip_prefix("until ").ok_or_else(none)?;
        if day::parse(until).ok_or_else(none)? < today {
            return Err(wrong(format!(
                "was good until {until}: make a new one with `cache keygen`, and give its `.pub` to those who trust you"
            )));
        }
    }
    let own = hex(pair.public_key().as_ref());
    Ok((pair, own))
}

impl Seal for Keys {
    fn signer(&self) -> Option<&str> {
        self.pair.as_ref().map(|(_, own)| own.as_str())
    }

    fn sign(&self, message: &[u8]) -> Option<String> {
        let (pair, own) = self.pair.as_ref()?;
        let signature = pair.sign(message);
        Some(format!("{METHOD}:{own}:{}", hex(signature.as_ref())))
    }

    fn is_strict(&self) -> bool {
        self.trusted.is_some()
    }

    fn believes(&self, message: &[u8], signature: &str) -> bool {
        let words: Vec<&str> = signature.split(':').collect();
        let [METHOD, who, signature] = words[..] else {
            return false;
        };
        let trusted = self.trusted.as_ref();
        let (Some(key), Some(signature)) = (unhex::<32>(who), unhex::<64>(signature)) else {
            return false;
        };
        trusted.is_none_or(|all| all.has(&hex(&key)))
            && UnparsedPublicKey::new(&ED25519, key)
                .verify(message, &signature)
                .is_ok()
    }
}

#[cfg(test)]
#[path = "signature_tests.rs"]
mod tests;
