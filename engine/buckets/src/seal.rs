//! Whose records are believed: what a signature covers, and who knows how to make and check one.

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
