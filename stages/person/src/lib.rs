//! Where a person is on each photo, by networks that were trained elsewhere.
//!
//! `photos` → [`FindPeople`] → `people` → [`InView`] → the same, if feet are in view
//! `masks`, `people`, `photos` → [`Alarm`] → `lost_parts`
//!
//! `net/` runs a network of `models/person/`; `body/` finds people on a photo with two of them, and
//! `turn.rs` combines the finds of all photos (`same.rs`: whether two are one person); `odd.rs` has what is odd about it.

mod alarm;
mod body;
mod find;
mod in_view;
mod net;
mod odd;
mod regions;
mod same;
mod turn;

pub use alarm::{Alarm, AlarmInput, AlarmParams};
pub use body::Networks;
pub use find::{FindPeople, FindPeopleInput, FindPeopleParams};
pub use in_view::{InView, InViewError, InViewInput, InViewParams};
pub use net::{Network, Tensor, Unreadable};
pub use regions::{Disagreement, disagreement};

/// Every stage of this crate.
pub const STAGES: &[&dyn stage::AnyStage] = &[
    &stage::erase::<FindPeople>().failing(CODED),
    &stage::erase::<InView>().failing(CODED),
    &stage::erase::<Alarm>().failing(CODED),
];

/// Every kind of message of this crate.
pub const MESSAGES: &[&[stage::Template]] = &[
    alarm::MESSAGES,
    in_view::MESSAGES,
    odd::MESSAGES,
    InViewError::MESSAGES,
];

/// The errors that have codes.
const CODED: &[stage::Recognise] = &[
    stage::recognise::<InViewError>,
    stage::recognise::<shape::PhotoError>,
];
