//! A place that machines share: its objects by name, how long its answers may take, whose signatures are believed. What
//! the engine keeps there is its own business (`engine::store::remote`).
//!
//! The places themselves, buckets and folders, and signatures by ed25519 come with the feature `remote`.

#[cfg(feature = "remote")]
mod answer;
#[cfg(feature = "remote")]
mod bucket;
#[cfg(feature = "remote")]
mod clients;
#[cfg(feature = "remote")]
mod cut_off;
mod day;
mod key_file;
mod keys;
#[cfg(feature = "remote")]
mod network;
mod objects;
#[cfg(feature = "remote")]
mod pace;
mod patience;
#[cfg(feature = "remote")]
mod profile;
mod seal;
#[cfg(feature = "remote")]
mod signature;
mod trusted;

#[cfg(feature = "remote")]
pub use bucket::open;
pub use key_file::NoKey;
pub use keys::{Keys as KeysOf, Lapsed, Pair};
pub use objects::{Created, FOLDERS, Got, Object, Objects, SMALL_BYTES, Trouble, at_most, whole};
pub use patience::Patience;
pub use seal::Seal;
#[cfg(feature = "remote")]
pub use signature::{Keys, keygen};
pub use trusted::{Public, Trusted};
