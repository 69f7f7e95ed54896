//! Where a person is on each photo, by networks that were trained elsewhere.
//!
//! `photos` → [`FindPeople`] → `people`
//!
//! `net/` runs a network of `models/person/`; `body/` finds people on a photo with two of them, and
//! `turn.rs` says what all photos say together, `odd.rs` what
//! is odd about it.

mod body;
mod find;
mod net;
mod odd;
mod turn;

pub use body::Networks;
pub use find::{FindPeople, FindPeopleInput, FindPeopleParams};
pub use net::{Network, Tensor, Unreadable};

/// Every stage of this crate.
pub const STAGES: &[&dyn stage::AnyStage] = &[&stage::erase::<FindPeople>()];
