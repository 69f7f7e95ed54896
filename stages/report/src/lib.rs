//! From results to documents for people.
//!
//! ```text
//! photos, masks, cameras (a scan has none of them), surfaces, landmarks, girths → [`Html`] → document
//! files → [`Take`] → document
//! ```
//!
//! The page is one file: no request leaves the machine, and it carries no metadata of the photos.

mod answer;
mod derived;
mod face;
mod html;
mod labels;
mod lengths;
mod overlay;
mod packing;
mod page;
mod paint;
mod profile;
mod scene;
mod sides;
mod tables;
mod take;
mod tape;
mod ticks;

pub use answer::Answer;
pub use html::{Html, HtmlInput, HtmlParams, TurnError};
pub use lengths::ShownIn;
pub use page::titled;
pub use take::{Take, TakeError, TakeInput};

/// Every stage of this crate, in the order in which data flows through it.
pub const STAGES: &[&dyn stage::AnyStage] = &[
    &stage::erase::<Html>().failing(CODED),
    &stage::erase::<Take>().failing(CODED),
];

/// Every kind of message of this crate.
pub const MESSAGES: &[&[stage::Template]] = &[html::MESSAGES];

/// The errors that have codes.
const CODED: &[stage::Recognise] = &[stage::recognise::<shape::PhotoError>];
