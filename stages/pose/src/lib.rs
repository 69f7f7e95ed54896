//! From photos to cameras: self-calibration on a turntable.
//!
//! ```text
//! photos ─ [`FindTags`] → tags ─ [`Calibrate`] → cameras
//! ```

mod adjust;
mod calibrate;
mod from_mat;
mod planar;
mod residual;
mod tag_corners;
mod tags;
mod tracks_in;

pub use adjust::{Fit, LENS, LensPrior, Scene, Settings, Sight, adjust, cost};
pub use calibrate::{Calibrate, CalibrateError, CalibrateInput, CalibrateParams};
pub use from_mat::{MatError, mat_corners};
pub use planar::planar_pose;
pub use residual::{Derivatives, derivatives};
pub use tag_corners::refined;
pub use tags::{FindTags, NoDetector, TagsInput, TagsParams};

/// Every stage of this room, in the order in which data flows through it.
pub const STAGES: &[&dyn stage::AnyStage] =
    &[&stage::erase::<FindTags>(), &stage::erase::<Calibrate>()];
