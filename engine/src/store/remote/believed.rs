//! Who is believed by a link, and what is signed over it.

use super::framed::Framed;
use super::link::Link;
use stage::Hash;
use std::sync::atomic::Ordering;

impl Link {
    /// A signature of a record, if somebody signs.
    pub(super) fn sign(&self, key: Hash, file: &[u8]) -> Option<String> {
        self.seal.as_ref()?.sign(&message(key, file))
    }

    /// Whether what is written is signed.
    pub(super) fn signs(&self) -> bool {
        self.seal.as_ref().is_some_and(|s| s.signer().is_some())
    }

    /// Whether nothing is believed but what somebody who is trusted signed.
    pub(super) fn is_strict(&self) -> bool {
        self.seal.as_ref().is_some_and(|seal| seal.is_strict())
    }

    /// Whether a record is by somebody who is believed.
    pub(super) fn believes(&self, key: Hash, theirs: &Framed) -> bool {
        let signature = theirs.signature.as_deref();
        !self.is_strict() || signature.is_some_and(|word| self.vouched(key, &theirs.file, word))
    }

    /// Whether somebody who is trusted by name signed the file of a record.
    pub(super) fn vouched(&self, key: Hash, file: &[u8], signature: &str) -> bool {
        let Some(seal) = self.seal.as_ref().filter(|seal| seal.is_strict()) else {
            return false;
        };
        let messages = [message, former_message].map(|of| of(key, file));
        messages.iter().any(|m| seal.believes(m, signature))
    }

    /// A signature of a plan, if somebody signs.
    pub(super) fn sign_plan(&self, name: &str) -> Option<String> {
        self.seal.as_ref()?.sign(&plan_message(name))
    }

    /// Whether somebody who is believed signed a plan.
    pub(super) fn believes_plan(&self, name: &str, signature: &str) -> bool {
        let seal = self.seal.as_ref().filter(|seal| seal.is_strict());
        seal.is_none_or(|seal| seal.believes(&plan_message(name), signature))
    }

    /// Reports once that something here is not signed.
    pub(super) fn report_unsigned(&self) {
        if !self.unsigned.swap(true, Ordering::Relaxed) {
            self.report(
                "what in this cache was brought without a signature that --trust knows, or made by an earlier program or in another folder, goes there unsigned: to sign it, make it again in an empty cache",
            );
        }
    }

    /// Warns once that the key does not sign any more.
    pub(super) fn warn_expired(&self) {
        if !self.unsigned.swap(true, Ordering::Relaxed) {
            self.report(
                "the last day of the signing key is over: what is made goes there unsigned until this is started again with a new key (`cache keygen`)",
            );
        }
    }

    /// Reports once that somebody is not believed.
    pub(super) fn report_stranger(&self, name: &str) {
        if !self.strangers.swap(true, Ordering::Relaxed) {
            self.report(&format!(
                "{name} is not signed by anybody in the list of --trust: nothing like it is used"
            ));
        }
    }
}

/// What is signed of a record: its key and its file, in which the hash of its result is.
fn message(key: Hash, file: &[u8]) -> Vec<u8> {
    let head = b"stage shared record 1\n";
    [head, key.as_bytes().as_slice(), file].concat()
}

/// What is signed of a plan: its name, which is its hash.
fn plan_message(name: &str) -> Vec<u8> {
    [b"stage shared plan 1\n", name.as_bytes()].concat()
}

/// What was signed while the engine bore the name of its first product.
fn former_message(key: Hash, file: &[u8]) -> Vec<u8> {
    let head = b"tailor shared record 1\n";
    [head, key.as_bytes().as_slice(), file].concat()
}
