//! Results by key, written whole or not at all.
//!
//! ```text
//! format                one line: the version of this layout
//! cas/ab/abcdef…        blobs, named by the hash of their bytes; never changed
//! ac/ab/abcdef…         records by key: what was made, from what, how long it took
//! parts/ab/abcdef…      parts and checkpoints of unfinished work
//! lease/…               locked while a result is made; see `lease.rs`
//! runs/…                one record a run
//! pins/…                names of runs whose results stay
//! in-use                locked by whoever runs, and by who sweeps; see `lease.rs`
//! origin                marks what was made in this folder; see `origin.rs`
//! index                 what was verified; see `index.rs`; may go at any time
//! shared/…              which results a shared store has; see `remote/known.rs`
//! waiting/…             what waits to be uploaded; see `remote/waiting.rs`
//! plans/…               what `plan --strands` wrote, named by its hash
//! captures/…            which folders had files of this content; see `captures.rs`
//! quarantine/…          what was found corrupt
//! tmp/…                 what is being written
//! ```
//!
//! A blob is written to `tmp` and renamed; a record likewise, and after its blob. So a kill
//! at any moment leaves whole files or litter in `tmp`. Nothing persisted means "running" or "locked".
//! What is read is verified; what is corrupt or missing is a miss. What took long enough to be
//! worth it is synced to the disk before it gets its name.

mod blob;
mod captures;
mod delivered;
mod disk;
pub(crate) mod error;
mod files;
mod folder;
mod forget;
mod found;
mod index;
mod lease;
mod links;
#[cfg(test)]
mod losses;
mod metrics;
mod origin;
mod part;
mod pins;
mod prefetch;
mod record;
mod records;
pub mod remote;
mod removal;
pub mod retention;
#[cfg(test)]
mod simulated;
mod trace;

#[cfg(test)]
pub(crate) use disk::Real;
#[cfg(test)]
pub(crate) use simulated::{Simulated, Step, Steps, User, after_loss, below, in_memory, laid};

pub use blob::Blob;
pub use delivered::Delivered;
pub use error::StoreError;
pub use folder::Store;
pub use forget::{Forgotten, forget};
pub use found::Found;
pub use lease::{Claim, InUse, Lease};
pub use pins::PinError;
pub use prefetch::Prefetch;
pub use record::Record;
pub use trace::Trace;
