//! The one file that knows bincode: small typed metadata, little-endian, fixed-size integers.
//!
//! Legacy configuration: byte for byte bincode 1.3 (and wincode), so that the crate may be
//! swapped without losing a cached artifact. Bulk arrays never come here.

use serde::{Serialize, de::DeserializeOwned};

/// No metadata of ours comes near; a hostile length fails here instead of allocating (structural: a bound of memory).
const LIMIT: usize = 256 << 20;

/// Bytes that are no artifact of the wanted kind; the text names why.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("not a whole artifact: {0}")]
pub struct Corrupt(pub String);

/// To bytes.
pub(crate) fn encode(value: &impl Serialize) -> Vec<u8> {
    bincode::serde::encode_to_vec(value, bincode::config::legacy())
        .expect("bug: metadata that serde cannot write")
}

/// From bytes, all of them.
pub(crate) fn decode<T: DeserializeOwned>(bytes: &[u8]) -> Result<T, Corrupt> {
    let config = bincode::config::legacy().with_limit::<LIMIT>();
    match bincode::serde::decode_from_slice(bytes, config) {
        Ok((value, used)) if used == bytes.len() => Ok(value),
        Ok(_) => Err(Corrupt("metadata with bytes left over".into())),
        Err(e) => Err(Corrupt(format!("metadata: {e}"))),
    }
}
