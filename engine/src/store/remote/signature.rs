//! Signatures by ed25519, and the files of their keys.
//!
//! A signing key: the line `stage signing key 1`, then 32 bytes in hexadecimal; for its owner only. Beside it
//! `.pub`: `ed25519 HEX`. A list of those who are trusted has such a line for each; `#` begins a comment.
//! A signature is the word `ed25519:WHO:SIGNATURE`, both hexadecimal.

use super::seal::Seal;
use crate::system::{is_private, private_file};
use ring::rand::{SecureRandom, SystemRandom};
use ring::signature::{ED25519, Ed25519KeyPair, KeyPair, UnparsedPublicKey};
use std::io::Write;
use std::path::{Path, PathBuf};

const HEAD: &str = "stage signing key 1";

/// What it was while the engine bore the name of its first product.
const FORMER: &str = "tailor signing key 1";

const METHOD: &str = "ed25519";

/// No file of keys is larger. \[bytes\]
const MOST: u64 = 1 << 20;

/// Why a file gives no key.
#[derive(Debug, thiserror::Error)]
pub enum NoKey {
    /// It cannot be read or written.
    #[error("{}: {why}", path.display())]
    Disk {
        /// The file.
        path: PathBuf,
        /// What the system says.
        why: std::io::Error,
    },
    /// Others may read it.
    #[error("{}: others may read this signing key: make a new one with `cache keygen`, or `chmod 600` it if nobody has", .0.display())]
    Open(PathBuf),
    /// It is none.
    #[error("{}: {what}", path.display())]
    Wrong {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        what: String,
    },
}

fn disk(path: &Path) -> impl FnOnce(std::io::Error) -> NoKey + '_ {
    move |why| NoKey::Disk {
        path: path.into(),
        why,
    }
}

/// Makes a signing key in a new file, and `.pub` beside it; returns the line of the latter.
///
/// # Errors
///
/// One of the files is there already, or cannot be written.
pub fn keygen(path: &Path) -> Result<String, NoKey> {
    let mut seed = [0; 32];
    let random = SystemRandom::new().fill(&mut seed);
    random.map_err(|_| disk(path)(std::io::Error::other("this system gives no random numbers")))?;
    let pair = Ed25519KeyPair::from_seed_unchecked(&seed).expect("bug: any 32 bytes are a seed");
    let line = format!("{METHOD} {}", hex(pair.public_key().as_ref()));
    let mut beside = path.as_os_str().to_owned();
    beside.push(".pub");
    let beside = PathBuf::from(beside);
    let secret = format!("{HEAD}\n{}\n", hex(&seed));
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
    /// Public keys; `None` believes everybody.
    trusted: Option<Vec<String>>,
}

impl Keys {
    /// From the file of a signing key, and from a list of those who are trusted. Who signs trusts itself.
    ///
    /// # Errors
    ///
    /// A file cannot be read, is none, or others may read what is secret.
    pub fn read(sign: Option<&Path>, trust: Option<&Path>) -> Result<Keys, NoKey> {
        let pair = sign.map(signing).transpose()?;
        let mut trusted = trust.map(listed).transpose()?;
        if let (Some((_, own)), Some(trusted)) = (&pair, &mut trusted) {
            trusted.push(own.clone());
        }
        Ok(Keys { pair, trusted })
    }
}

fn text(path: &Path) -> Result<String, NoKey> {
    let size = std::fs::metadata(path).map_err(disk(path))?.len();
    if size > MOST {
        let what = "is larger than any list of keys".into();
        let path = path.into();
        return Err(NoKey::Wrong { path, what });
    }
    std::fs::read_to_string(path).map_err(disk(path))
}

fn signing(path: &Path) -> Result<(Ed25519KeyPair, String), NoKey> {
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
    let pair = pair.ok_or_else(|| NoKey::Wrong {
        path: path.into(),
        what: "is no signing key: `cache keygen FILE` makes one".into(),
    })?;
    let own = hex(pair.public_key().as_ref());
    Ok((pair, own))
}

fn listed(path: &Path) -> Result<Vec<String>, NoKey> {
    let wrong = |what: String| NoKey::Wrong {
        path: path.into(),
        what,
    };
    let mut keys = Vec::new();
    for (at, line) in text(path)?.lines().enumerate() {
        let line = line.split('#').next().unwrap_or_default();
        let mut words = line.split_whitespace();
        match (words.next(), words.next()) {
            (None, _) => {}
            (Some(METHOD), Some(key)) if unhex::<32>(key).is_some() => {
                keys.push(key.to_lowercase())
            }
            _ => {
                let at = at + 1;
                return Err(wrong(format!(
                    "line {at} is no public key: say `{METHOD} HEX`, as in the file `.pub` beside a signing key"
                )));
            }
        }
    }
    match keys.is_empty() {
        true => Err(wrong("has no public key: nothing could be believed".into())),
        false => Ok(keys),
    }
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
        trusted.is_none_or(|all| all.iter().any(|known| *known == hex(&key)))
            && UnparsedPublicKey::new(&ED25519, key)
                .verify(message, &signature)
                .is_ok()
    }
}

fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

fn unhex<const N: usize>(text: &str) -> Option<[u8; N]> {
    let digits = text.as_bytes();
    if digits.len() != 2 * N {
        return None;
    }
    let mut bytes = [0; N];
    for (byte, pair) in bytes.iter_mut().zip(digits.chunks(2)) {
        let digit = |at: usize| (pair[at] as char).to_digit(16);
        *byte = (16 * digit(0)? + digit(1)?) as u8;
    }
    Some(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_signed_is_believed_of_those_who_are_trusted_and_of_nobody_else() {
        let place = tempfile::tempdir().unwrap();
        let file = |name: &str| place.path().join(name);
        let line = keygen(&file("a")).unwrap();
        keygen(&file("b")).unwrap();
        std::fs::write(file("trust"), format!("# ours\n\n{line}  # lab\n")).unwrap();
        let keys = |sign: &str| Keys::read(Some(&file(sign)), None).unwrap();
        let reader = Keys::read(None, Some(&file("trust"))).unwrap();
        let signed = keys("a").sign(b"message").unwrap();
        assert!(reader.believes(b"message", &signed));
        assert!(!reader.believes(b"massage", &signed));
        assert!(!reader.believes(b"message", &keys("b").sign(b"message").unwrap()));
        let last = if signed.ends_with('0') { "1" } else { "0" };
        for wrong in [
            "",
            "ed25519",
            "ed25519::",
            &format!("{}{last}", &signed[..signed.len() - 1]),
        ] {
            assert!(!reader.believes(b"message", wrong), "{wrong}");
        }
        assert!(reader.is_strict() && reader.sign(b"message").is_none());
        // Who signs trusts itself.
        let both = Keys::read(Some(&file("b")), Some(&file("trust"))).unwrap();
        assert!(both.believes(b"message", &both.sign(b"message").unwrap()));
    }

    #[test]
    fn files_that_are_no_keys_are_told_and_none_is_written_over() {
        let place = tempfile::tempdir().unwrap();
        let file = |name: &str| place.path().join(name);
        keygen(&file("a")).unwrap();
        assert!(keygen(&file("a")).is_err(), "it is there already");
        std::fs::write(file("c.pub"), "").unwrap();
        assert!(keygen(&file("c")).is_err() && !file("c").exists());
        let told = |sign: Option<&str>, trust: Option<&str>| {
            let of = |name: Option<&str>| name.map(file);
            let read = Keys::read(of(sign).as_deref(), of(trust).as_deref());
            read.err().map(|why| why.to_string()).unwrap_or_default()
        };
        std::fs::write(file("none"), "# nobody\n").unwrap();
        std::fs::write(file("odd"), "ed25519 xyz\n").unwrap();
        assert!(told(Some("missing"), None).contains("missing"));
        assert!(told(Some("a.pub"), None).contains("is no signing key"));
        assert!(told(None, Some("none")).contains("has no public key"));
        assert!(told(None, Some("odd")).contains("line 1 is no public key"));
        assert_eq!(told(Some("a"), Some("a.pub")), "");
        let secret = std::fs::read_to_string(file("a")).unwrap();
        std::fs::write(file("a"), secret.replace(HEAD, FORMER)).unwrap();
        assert_eq!(told(Some("a"), Some("a.pub")), "");
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            let open = std::fs::Permissions::from_mode(0o644);
            std::fs::set_permissions(file("a"), open).unwrap();
            assert!(told(Some("a"), None).contains("others may read"));
        }
    }
}
