//! From photos to cameras: self-calibration on a turntable.
//!
//! ```text
//! photos ─ [`Sift`] → keypoints ─ [`Follow`] → tracks ─┐
//! photos ─ [`FindTags`] → tags ────────────────────────┴─ [`Calibrate`] → cameras ─ [`Frame`] → cameras in millimetres
//! ```

mod adjust;
mod any_order;
mod calibrate;
mod descent;
mod disk_edge;
mod foreign;
mod frame;
mod from_mat;
mod from_rim;
mod from_tracks;
mod import;
mod import_colmap;
mod import_text;
mod mat;
mod mat_layout;
mod mat_print;

mod epipolar;
mod five_point;
mod matching;
mod pairs;
mod places;
mod planar;
mod quiet;
mod resection;
mod residual;
mod rim;
mod rim_layout;
mod ring;
mod ring_fit;
mod ring_start;
mod room_shift;
mod scene;
mod schur;
mod sift;
mod sift_describe;
mod sift_detect;
mod sift_pyramid;
mod solved;
mod stature;
mod system;
mod tag36h11;
mod tag_bloom;
mod tag_corners;
mod tags;
mod tracks;
mod tracks_in;
mod trust;
mod turn_trial;

pub use adjust::{Fit, adjust};
pub use calibrate::{Calibrate, CalibrateError, CalibrateInput, CalibrateParams, Motion};
pub use disk_edge::{DiskEdge, disk_edge};
pub use foreign::{Foreign, ForeignError, Model};
pub use frame::{Frame, FrameInput, FrameParams};
pub use from_mat::{MatError, mat_corners};
pub use from_tracks::TracksError;
pub use import::{Import, ImportError, ImportInput, ImportParams, World};
pub use import_colmap::{from_colmap_binary, from_colmap_text};
pub use import_text::{from_json, from_middlebury};
pub use mat::{MatInput, MatParams, Print, PrintMat, Sheet};
pub use mat_layout::{LayoutError, Mark, mat_for, mat_marks, mat_toml};
pub use mat_print::{Paper, tiles, to_pdf, to_svg};

pub use epipolar::{Both, agreeing, agreeing_through, fundamental, sampson};
pub use five_point::essentials;
pub use matching::{Pairs, mutual, standing, still};
pub use planar::planar_pose;
pub use residual::{Derivatives, derivatives};
pub use rim_layout::{Piece, rim_for, rim_pieces, rim_toml};
pub use ring::Ring;
pub use ring_fit::{Circle, camera_circle, circle, moved};
pub use ring_start::{Known, Pair, Start, starts};
pub use room_shift::{RoomShift, room_shift};
pub use scene::{Beliefs, LENS, LensPrior, Scene, Settings, Sight, Steps, cost};
pub use sift::{Sift, SiftInput, SiftParams, features};
pub use sift_describe::{describe, fading};
pub use sift_detect::{Extremum, extrema, orientations};
pub use sift_pyramid::{INTERVALS, Octave, SIGMA, blur, octaves};
pub use stature::{Stature, stature};
pub use tag_bloom::outward;
pub use tag_corners::{Line, fitted_line, meeting, refined};
pub use tag36h11::{TAGS, modules};
pub use tags::{FindTags, NoDetector, TagsInput, TagsParams};
pub use tracks::{Follow, TracksInput, TracksParams};

/// Every stage of this room, in the order in which data flows through it.
pub const STAGES: &[&dyn stage::AnyStage] = &[
    &stage::erase::<Sift>(),
    &stage::erase::<Follow>(),
    &stage::erase::<FindTags>(),
    &stage::erase::<Calibrate>(),
    &stage::erase::<Frame>(),
    &stage::erase::<Import>(),
    &stage::erase::<PrintMat>(),
];
