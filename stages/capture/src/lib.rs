//! From files to photos: reads what the user has, in turning order.
//!
//! `files` → [`Load`] → `photos`

mod alike;
mod exif;
mod load;
mod rig;
mod rig_tags;
mod surface;
mod whole;

pub use load::{CaptureError, Load, LoadInput, LoadParams};
pub use rig::{RigError, RigFile, read_rig};
pub use surface::{Surface, SurfaceError, SurfaceInput, SurfaceParams, Unit, Up};

/// Every stage of this room, in the order in which data flows through it.
pub const STAGES: &[&dyn stage::AnyStage] = &[&stage::erase::<Load>(), &stage::erase::<Surface>()];
