//! From files to photos: reads what the user has, in turning order.
//!
//! `files` → [`Load`] → `photos`

mod alike;
mod error;
mod exif;
mod facts;
mod facts_param;
mod folder;
mod glance;
mod keys;
mod load;
mod look;
mod names;
mod odd;
mod photo;
mod rig;
mod rig_tags;
mod sharpness;
mod surface;
mod verdict;
mod whole;

pub use error::CaptureError;
pub use facts::Facts;
pub use folder::{Foreign, READ, foreign, is_photo};
pub use glance::{Glance, Together, glance, together};
pub use keys::RigError;
pub use load::{Load, LoadInput, LoadParams};
pub use look::{Look, LookInput, LookParams};
pub use rig::{RigFile, read_rig};
pub use sharpness::{best, sharpness};
pub use surface::{Surface, SurfaceError, SurfaceInput, SurfaceParams, Unit, Up};
pub use verdict::{Finding, Grade};

/// Every stage of this room, in the order in which data flows through it.
pub const STAGES: &[&dyn stage::AnyStage] = &[
    &stage::erase::<Load>(),
    &stage::erase::<Look>(),
    &stage::erase::<Surface>(),
];
