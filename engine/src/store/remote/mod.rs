//! A store that machines share, beside the one here, which is always first.
//!
//! ```text
//! format                one line: version and identity
//! ac/ab/abcdef…         records by key, small results within (`framed.rs`)
//! cas/ab/abcdef…        larger results, named by the hash of their bytes
//! plans/…               plans, named by their hash
//! ```
//!
//! Read: record here, record there, blob here, blob there, hashed while it comes. Written: here first,
//! then by threads beside the work, the blob before its record, the record only where there is none.
//! Whatever the place does, a run goes on with the store here: what cannot be read is made, what cannot
//! be uploaded waits on disk (`waiting.rs`).

#[cfg(feature = "remote")]
mod answer;
mod believed;
#[cfg(feature = "remote")]
mod bucket;
#[cfg(feature = "remote")]
mod clients;
#[cfg(feature = "remote")]
mod cut_off;
#[cfg(any(test, feature = "remote"))]
mod day;
mod forget;
mod framed;
mod handshake;
mod inventory;
mod joined;
#[cfg(any(test, feature = "remote"))]
mod key_file;
#[cfg(any(test, feature = "remote"))]
#[cfg_attr(not(feature = "remote"), allow(unreachable_pub))]
mod keys;
mod known;
mod link;
mod listing;
#[cfg(feature = "remote")]
mod network;
mod objects;
#[cfg(feature = "remote")]
mod pace;
mod patience;
mod paused;
mod plans;
#[cfg(feature = "remote")]
mod profile;
mod reads;
mod seal;
#[cfg(feature = "remote")]
mod signature;
mod sweep;
#[cfg(any(test, feature = "remote"))]
mod trusted;
mod upload;
mod uploads;
mod waiting;

#[cfg(feature = "remote")]
pub use bucket::open;
#[cfg(test)]
pub(crate) use framed::{SMALL, readable};
pub use handshake::Honest;
pub(super) use handshake::fresh;
pub(super) use joined::of;
#[cfg(any(test, feature = "remote"))]
pub use key_file::NoKey;
#[cfg(test)]
pub(crate) use keys::{Keys as KeysOf, Pair};
pub use link::{Link, Report};
pub use objects::{Created, Got, Object, Objects, Trouble};
pub use patience::Patience;
#[cfg(test)]
pub(crate) use patience::working_beside;
pub(super) use paused::Paused;
pub use seal::Seal;
#[cfg(feature = "remote")]
pub use signature::{Keys, keygen};
pub use sweep::{Looked, SweptThere};
#[cfg(test)]
pub(crate) use trusted::{Public, Trusted};
#[cfg(test)]
pub(crate) use uploads::drain;
pub use uploads::{Left, Manner, NoSharing, Sharing};
