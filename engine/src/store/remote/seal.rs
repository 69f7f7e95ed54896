//! Whose records are believed: what a signature covers, and who knows how to make and check one.

use stage::Hash;

/// Signs records, and knows whose signatures are believed.
pub trait Seal: Send + Sync {
    /// Names who signs, if somebody does.
    fn signer(&self) -> Option<&str>;

    /// A signature of a message, as a word without spaces; `None` where nothing is signed.
    fn sign(&self, message: &[u8]) -> Option<String>;

    /// Whether nothing is believed but what somebody who is trusted signed.
    fn is_strict(&self) -> bool;

    /// Whether this signature of a message is by somebody who is trusted.
    fn believes(&self, message: &[u8], signature: &str) -> bool;
}

/// What is signed of a record: its key and its file, in which the hash of its result is.
pub(super) fn message(key: Hash, file: &[u8]) -> Vec<u8> {
    let head = b"stage shared record 1\n";
    [head, key.as_bytes().as_slice(), file].concat()
}

/// What is signed of a plan: its name, which is its hash.
pub(super) fn plan_message(name: &str) -> Vec<u8> {
    [b"stage shared plan 1\n", name.as_bytes()].concat()
}

/// What was signed while the engine bore the name of its first product.
pub(super) fn former_message(key: Hash, file: &[u8]) -> Vec<u8> {
    let head = b"tailor shared record 1\n";
    [head, key.as_bytes().as_slice(), file].concat()
}
