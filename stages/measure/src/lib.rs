//! From a surface to girths.
//!
//! `mesh` → [`FindLandmarks`] → `landmarks` → [`Measure`] → `girths`

mod body;
mod girths;
mod landmarks;
mod section;
mod slices;
mod spline;

pub use body::{Arm, Body, arm, body, nearest_ring};
pub use girths::{GirthInput, GirthParams, Measure};
pub use landmarks::{FindLandmarks, LandmarkInput, LandmarkParams, NoBody, Waist};
pub use section::{Loop, area, axes, centre, flat, hull, length, section, tape};
pub use slices::{Ring, Slice, level, rings, slices, without_arms};
pub use spline::{closed_spline_length, fitted_plane, grown, paper_girth, spline_length};

/// Every stage of this room, in the order in which data flows through it.
pub const STAGES: &[&dyn stage::AnyStage] =
    &[&stage::erase::<FindLandmarks>(), &stage::erase::<Measure>()];
