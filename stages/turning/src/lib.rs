//! Somebody turns on the spot before a standing camera, without a disk: how the body moved, from joints and outlines.
//!
//! ```text
//! photos, people ── motion ─ cameras (by joints and coarse masks) ─ masks ─ motion ─ cameras
//! ```
//!
//! Joints of a learned network tell which way the body faces to some degrees ([`azimuth`], [`joints`]); what outlines tell
//! each other ([`outlines`]) brings that under one. `scene` is the camera, the floor and the step.

mod apart;
pub mod azimuth;
mod error;
mod given;
pub mod joints;
mod motion;
mod odd;
mod outline;
pub mod outlines;
mod points;
mod rays;
mod read;
mod reported;
pub mod scene;
mod score;
mod together;
mod trunk;

pub use error::MotionError;
pub use given::{MotionInput, MotionParams};
pub use motion::FindMotion;
pub use score::{ScoreInput, ScoreMotion, TooFew};

/// Every stage of this crate, in the order in which data flows through it.
pub const STAGES: &[&dyn ::stage::AnyStage] = &[
    &::stage::erase::<FindMotion>().failing(CODED),
    &::stage::erase::<ScoreMotion>().failing(CODED),
];

/// Every kind of message of this crate.
pub const MESSAGES: &[&[stage::Template]] =
    &[read::MESSAGES, reported::MESSAGES, MotionError::MESSAGES];

/// The errors that have codes.
const CODED: &[stage::Recognise] = &[
    stage::recognise::<MotionError>,
    stage::recognise::<shape::PhotoError>,
];
