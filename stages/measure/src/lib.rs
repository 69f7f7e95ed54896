//! From a surface to girths.
//!
//! ```text
//! mesh ─ FindBody ─ body features ─ FindLandmarks ─ landmarks ─┐
//!   └──────────────────┴────────────────┴──────────────────────┴─ Measure ─ girths
//!            masks, cameras: girths by silhouettes beside them
//! ```
//!
//! Inside, arrows go one way: `geometry` → `features` → `model` → `planes` → `sections` → `uncertainty`.

mod causes;
mod derive;
mod features;
mod find_body;
mod geometry;
mod girths;
mod growth;
mod import;
mod landmarks;
mod model;
mod named;
mod planes;
mod remarks;
mod sections;
mod uncertainty;

pub use features::arms::{Axis, arm_ring, clear, merged, upper_arm_axis};
pub use features::body::{Body, body};
pub use features::ground::{GivenGround, Ground, ground};
pub use features::limb::bend::Line;
pub use features::limb::follow::Knot;
pub use features::limb::{ArmSeen, Joint, Kind, Limb, Limbs, Segment, limbs};
pub use features::marks::{Marks, marks};
pub use features::neck::{NeckFeatures, neck_features};
pub use features::readings::{READINGS_VERSION, Reading, Readings, readings};
pub use find_body::{BodyError, BodyInput, FindBody};
pub use geometry::section::{Loop, area, axes, centre, flat, hull, length, section, tape};
pub use geometry::slices::{Ring, Slice, level, nearest_ring, rings, slices};
pub use geometry::spline::{
    closed_spline_length, fitted_plane, grown, has_left, paper_girth, spline_length,
};
pub use girths::{GirthInput, GirthParams, Measure};
pub use import::file::ImportError;
pub use import::girths::{GirthsFileInput, ImportGirths};
pub use import::landmarks::{ImportLandmarks, LandmarksFileInput};
pub use landmarks::{FindLandmarks, LandmarkInput, LandmarkParams};
pub use model::error::ModelError;
pub use model::file::LevelModel;
pub use model::fit_error::FitError;
pub use model::fit_stage::{FitInput, FitLevels, NoModel};
pub use model::law::{Law, LawEstimate, Place};
pub use model::level::Level;
pub use model::predict::{Cover, LevelEstimate};
pub use model::table::TableError;
pub use planes::custom::{BadName, OwnGirth, OwnPart};
pub use planes::joints::arm_joints;
pub use planes::limbs::{parts, share};
pub use planes::neck::{NeckPlane, is_groove, plane_at};
pub use planes::neck_level::{NeckLevel, neck_level};
pub use planes::thigh::thigh_seen;
pub use planes::wanted::{Waist, Wanted};
pub use sections::one::{SectionMeasurement, Why};
pub use sections::picked::{BadPoints, picked};
pub use sections::split::{Parted, parted};
pub use sections::taken::taken;
pub use uncertainty::clothes::leg_step;
pub use uncertainty::silhouette::{Support, Tangent, support_girth, tangents};

/// Every stage of this crate, in the order in which data flows through it.
pub const STAGES: &[&dyn stage::AnyStage] = &[
    &stage::erase::<FindBody>().failing(CODED),
    &stage::erase::<FindLandmarks>().failing(CODED),
    &stage::erase::<Measure>().failing(CODED),
    &stage::erase::<FitLevels>().failing(CODED),
    &stage::erase::<ImportLandmarks>().failing(CODED),
    &stage::erase::<ImportGirths>().failing(CODED),
];

/// Every kind of message of this crate.
pub const MESSAGES: &[&[stage::Template]] = &[
    causes::MESSAGES,
    derive::MESSAGES,
    features::ground::MESSAGES,
    features::whole::MESSAGES,
    find_body::MESSAGES,
    named::MESSAGES,
    landmarks::MESSAGES,
    planes::joints::MESSAGES,
    planes::place::MESSAGES,
    remarks::MESSAGES,
    uncertainty::clothes::MESSAGES,
    BodyError::MESSAGES,
];

/// The errors that have codes.
const CODED: &[stage::Recognise] = &[stage::recognise::<BodyError>];
