//! From a surface to girths.
//!
//! `mesh` → [`FindLandmarks`] → `landmarks` → [`Measure`] → `girths`

mod arms;
mod body;
mod carry;
mod derive;
mod girths;
mod interval;
mod landmarks;
mod levels;
mod marks;
mod section;
mod slices;
mod spline;
mod taken;

pub use arms::{Axis, arm_ring, clear, upper_arm_axis};
pub use body::{Body, body, nearest_ring};
pub use carry::{Carried, RAYS, carried, ray, reaches};
pub use girths::{GirthInput, GirthParams, Measure};
pub use landmarks::neck::{Throat, neck_ring, throat};
pub use landmarks::{FindLandmarks, LandmarkInput, LandmarkParams, NoBody, Waist};
pub use marks::{Marks, marks};
pub use section::{Loop, area, axes, centre, flat, hull, length, section, tape};
pub use slices::{Ring, Slice, level, rings, slices};
pub use spline::{closed_spline_length, fitted_plane, grown, paper_girth, spline_length};
pub use taken::{Taken, Why, taken};

/// Every stage of this room, in the order in which data flows through it.
pub const STAGES: &[&dyn stage::AnyStage] =
    &[&stage::erase::<FindLandmarks>(), &stage::erase::<Measure>()];
