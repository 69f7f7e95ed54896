//! From a surface to girths.
//!
//! ```text
//! mesh ─ FindLandmarks ─ landmarks ─┐
//!   └────────────────────────────────┴─ Measure ─ girths
//!            masks, cameras: girths by silhouettes beside them
//! ```

mod across_arm;
mod arms;
mod body;
mod carry;
mod derive;
mod girths;
mod hands;
mod interval;
mod keel;
mod landmarks;
mod levels;
mod marks;
mod outlines;
mod picked;
mod reach;
mod section;
mod silhouette;
mod slices;
mod spline;
mod split;
mod taken;

pub use arms::{Axis, arm_ring, clear, upper_arm_axis};
pub use body::{Body, body, nearest_ring};
pub use carry::{Carried, RAYS, carried, ray, reaches};
pub use girths::{GirthInput, GirthParams, Measure};
pub use landmarks::neck::{Throat, neck_ring, throat};
pub use landmarks::{FindLandmarks, LandmarkInput, LandmarkParams, NoBody, Waist};
pub use marks::{Marks, marks};
pub use picked::{BadPoints, picked};
pub use reach::{Reach, reach};
pub use section::{Loop, area, axes, centre, flat, hull, length, section, tape};
pub use silhouette::{Support, Tangent, support_girth, tangents};
pub use slices::{Ring, Slice, level, rings, slices};
pub use spline::{closed_spline_length, fitted_plane, grown, has_left, paper_girth, spline_length};
pub use split::{Parted, parted};
pub use taken::{Taken, Why, taken};

/// Every stage of this room, in the order in which data flows through it.
pub const STAGES: &[&dyn stage::AnyStage] =
    &[&stage::erase::<FindLandmarks>(), &stage::erase::<Measure>()];
