//! From photos to cameras: self-calibration on a turntable.
//!
//! ```text
//! photos ─ [`FindTags`] → tags
//! ```

mod tag_corners;
mod tags;

pub use tag_corners::refined;
pub use tags::{FindTags, NoDetector, TagsInput, TagsParams};

/// Every stage of this room, in the order in which data flows through it.
pub const STAGES: &[&dyn stage::AnyStage] = &[&stage::erase::<FindTags>()];
