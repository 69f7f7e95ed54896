//! From photos to cameras: self-calibration on a turntable.
//!
//! ```text
//! photos ─ [`Sift`] → keypoints ─ [`Follow`] → tracks ─┐
//! photos ─ [`FindTags`] → tags ────────────────────────┴─ [`Calibrate`] → cameras ─ [`Frame`] → cameras in millimetres
//! photos ─ [`Sift`] → keypoints ─ [`LinkUp`] → tracks ── [`Walk`] ──────┘
//! ```
//!
//! Folders, each knowing only those below it:
//!
//! | folder | what | knows |
//! |---|---|---|
//! | `calibrate` | the stage: with a mat, or without one | `mat`, `ring` |
//! | `mat` | cameras from a marker mat; the mat on paper | `calibration`, `two_view`, `adjust` |
//! | `ring` | cameras from features alone | `walk`, `calibration`, `two_view`, `frame` |
//! | `walk` | cameras that were walked around a subject, or are in no order | `calibration`, `two_view`, `features`, `adjust`, `frame` |
//! | `features` | features and tracks | `calibration`, `two_view` |
//! | `calibration` | params, what is believed, what is warned of | `adjust` |
//! | `adjust` | bundle adjustment | |
//! | `import` | other people's cameras | `frame` |
//! | `frame` | the turntable frame and its scale | |
//! | `tags` | marker tags on photos | |
//! | `two_view` | geometry of two photos, of one camera, of one point | `adjust` |

mod adjust;
mod calibrate;
mod calibration;
mod features;
mod frame;
mod import;
mod mat;
mod ring;
mod tags;
mod two_view;
mod walk;

pub use adjust::belief::{Beliefs, Steps};
pub use adjust::bundle::{Settings, adjusted};
pub use adjust::lens::{LENS, LensPrior};
pub use adjust::ring::Ring;
pub use adjust::scene::{PointObservation, Scene, Shot};
pub use calibrate::{Calibrate, CalibrateError, CalibrateInput};
pub use calibration::params::{CalibrateParams, Motion};
pub use features::describe::describe;
pub use features::detect::{Extremum, extrema, orientations};
pub use features::gradients::fading;
pub use features::matching::{Pairs, mutual, standing, still};
pub use features::params::TracksParams;
pub use features::pyramid::{INTERVALS, Octave, SIGMA, blur, octaves};
pub use features::sift::{Sift, SiftInput, SiftParams, features};
pub use features::tracks::{Follow, OrderError, TracksInput};
pub use frame::circle::{Circle, camera_circle, circle, moved};
pub use frame::disk_edge::{DiskEdge, May, disk_edge};
pub use frame::stage::{Frame, FrameInput, FrameParams};
pub use frame::stature::{Stature, stature};
pub use import::colmap::{from_colmap_binary, from_colmap_text};
pub use import::foreign::{Foreign, ForeignError, Model};
pub use import::found::FoundError;
pub use import::stage::{Import, ImportError, ImportInput, ImportParams, World};
pub use import::tags::{ImportTags, TagsFileInput};
pub use import::text::{from_json, from_middlebury};
pub use import::tracks::{ImportTracks, TracksFileInput};
pub use mat::bloom::outward;
pub use mat::corners::mat_corners;
pub use mat::layout::{LayoutError, Mark, mat_for, mat_marks, mat_toml};
pub use mat::pages::{Paper, tiles, to_pdf, to_svg};
pub use mat::planar::planar_pose;
pub use mat::print::{MatInput, MatParams, Print, PrintMat, Sheet};
pub use mat::recognise::{Ringed, recognised, ringed};
pub use mat::rim_layout::{Piece, rim_for, rim_pieces, rim_toml};
pub use mat::solve::MatError;
pub use ring::error::TracksError;
pub use ring::start::{Known, Pair, Start, starts};
pub use shape::tag36h11::{TAGS, modules};
pub use tags::corners::{Line, fitted_line, meeting, refined};
pub use tags::find::{FindTags, NoDetector, TagsInput, TagsParams};
pub use two_view::background_shift::{BackgroundShift, background_shift};
pub use two_view::epipolar::{agreeing, agreeing_through, fundamental, sampson};
pub use two_view::five_point::{Both, essentials};
pub use walk::error::WalkError;
pub use walk::link::{LinkInput, LinkParams, LinkUp};
pub use walk::stage::{Walk, WalkInput, WalkParams};
pub use walk::world::{World as WalkWorld, world as walk_world};

/// Every stage of this crate, in the order in which data flows through it.
pub const STAGES: &[&dyn stage::AnyStage] = &[
    &stage::erase::<Sift>().failing(CODED),
    &stage::erase::<Follow>().failing(CODED),
    &stage::erase::<FindTags>().failing(CODED),
    &stage::erase::<Calibrate>().failing(CODED),
    &stage::erase::<LinkUp>().failing(CODED),
    &stage::erase::<Walk>().failing(CODED),
    &stage::erase::<Frame>().failing(CODED),
    &stage::erase::<Import>().failing(CODED),
    &stage::erase::<ImportTags>().failing(CODED),
    &stage::erase::<ImportTracks>().failing(CODED),
    &stage::erase::<PrintMat>().failing(CODED),
];

/// Every kind of message of this crate.
pub const MESSAGES: &[&[stage::Template]] = &[
    calibrate::MESSAGES,
    calibration::trust::MESSAGES,
    features::tracks::MESSAGES,
    frame::lengths::MESSAGES,
    frame::stage::MESSAGES,
    frame::two_points::MESSAGES,
    import::stage::MESSAGES,
    mat::recognise::MESSAGES,
    mat::rim::MESSAGES,
    ring::cameras::MESSAGES,
    ring::places::MESSAGES,
    ring::solve::MESSAGES,
    tags::find::MESSAGES,
    walk::stage::MESSAGES,
    CalibrateError::MESSAGES,
    LayoutError::MESSAGES,
    MatError::MESSAGES,
    OrderError::MESSAGES,
    TracksError::MESSAGES,
    WalkError::MESSAGES,
    frame::stage::FrameError::MESSAGES,
];

/// The errors that have codes.
const CODED: &[stage::Recognise] = &[
    stage::recognise::<CalibrateError>,
    stage::recognise::<LayoutError>,
    stage::recognise::<frame::stage::FrameError>,
    stage::recognise::<OrderError>,
    stage::recognise::<WalkError>,
    stage::recognise::<shape::PhotoError>,
];
