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

mod believed;
mod beside;
mod forget;
mod framed;
mod handshake;
mod inventory;
mod joined;
mod known;
mod link;
mod listing;
mod paused;
mod plans;
mod reads;
mod sweep;
mod upload;
mod uploads;
mod waiting;

#[cfg(test)]
pub(crate) use beside::working_beside;
#[cfg(test)]
pub(crate) use framed::{SMALL, readable};
pub use handshake::Honest;
pub(super) use handshake::fresh;
pub(super) use joined::of;
pub use link::{Link, Report};
pub(super) use paused::Paused;
pub use sweep::{Looked, SweptThere};
#[cfg(test)]
pub(crate) use uploads::drain;
pub use uploads::{Left, Manner, NoSharing, Sharing};
