//! Who signs and who is believed, and for how long: whatever keys are made of.

use crate::day;
use crate::key_file::{METHOD, hex, unhex};
use crate::seal::Seal;
use crate::trusted::{Public, Trusted};

/// A signing key, and how what was signed with any such key is checked.
pub trait Pair: Send + Sync {
    /// Signs a message.
    fn sign(&self, message: &[u8]) -> [u8; 64];

    /// Whether a message was signed with a key.
    fn is_by(key: &[u8; 32], message: &[u8], signature: &[u8; 64]) -> bool;
}

/// Why a key signs nothing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Lapsed {
    /// Its last day is over.
    Expired,
    /// It counts no longer.
    Revoked,
}

/// Who signs, and who is believed. The day is asked for each time: who goes on over a key's last day signs with it no
/// longer, and believes it no longer.
pub struct Keys<P> {
    own: Option<(P, Public)>,
    /// `None` believes everybody.
    trusted: Option<Trusted>,
}

impl<P: Pair> Keys<P> {
    /// From a signing key, and those who are trusted. Who signs trusts itself.
    ///
    /// # Errors
    ///
    /// The signing key does not count today.
    pub fn of(own: Option<(P, Public)>, mut trusted: Option<Trusted>) -> Result<Keys<P>, Lapsed> {
        if let Some((_, public)) = &own {
            if !public.counts(day::today()) {
                return Err(Lapsed::Expired);
            }
            if let Some(trusted) = &mut trusted {
                if trusted.is_revoked(&public.key) {
                    return Err(Lapsed::Revoked);
                }
                trusted.add(public.clone());
            }
        }
        Ok(Keys { own, trusted })
    }
}

impl<P: Pair> Seal for Keys<P> {
    fn signer(&self) -> Option<&str> {
        self.own.as_ref().map(|(_, public)| public.key.as_str())
    }

    fn sign(&self, message: &[u8]) -> Option<String> {
        let own = self.own.as_ref();
        let (pair, public) = own.filter(|(_, public)| public.counts(day::today()))?;
        let signature = pair.sign(message);
        Some(format!("{METHOD}:{}:{}", public.key, hex(&signature)))
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
        trusted.is_none_or(|all| all.has(&hex(&key))) && P::is_by(&key, message, &signature)
    }
}
