//! A video to the photos of a turn.
//!
//! `stage.rs` looks at all frames small (`frames.rs` by `ffmpeg.rs`, `seen.rs`), finds the turn in them
//! (`turn.rs` by `speed.rs` and `closing.rs`), picks one sharp frame a step (`pick.rs`), and takes those
//! at full size.

mod closing;
mod error;
mod ffmpeg;
mod filters;
pub(crate) mod frames;
mod pick;
mod probe;
mod seen;
mod speed;
pub(crate) mod stage;
mod turn;

pub use error::VideoError;
pub use stage::{Video, VideoInput, VideoParams};
