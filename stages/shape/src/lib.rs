//! The nouns: what flows between stages. They know no verbs.
//!
//! Lengths in millimetres, angles in radians, pixels with the centre of the top-left pixel at
//! (0, 0). World is the turntable frame: origin on the rotation axis at the disk's top, z up,
//! right-handed. `x_in_camera = camera_from_world * x_in_world`, camera x right, y down, z forward.
//!
//! ```text
//! Photos ─ Keypoints ─ Tracks ─ Cameras ─┐
//!    ├──────────────── Masks ────────────┴─ Mesh ─ BodyFeatures ─ Landmarks ─ Girths ─ Document
//!    └─ Aligned ─ Scene ─ Evidence ─ Labels ─┘ (to Masks)
//!    └─ People ─ LostParts (with Masks)
//! ```

mod aligned;
mod bilinear;
mod body_features;
mod bones;
mod by_photo;
mod camera;
mod cameras;
mod coherence;
mod crop;
mod csv_table;
mod cylinder;
mod distance;
mod document;
mod edges;
mod evidence;
mod fill;
mod film;
mod girth_id;
mod girth_names;
mod girth_rules;
mod girth_table;
mod girths;
mod image;
mod joined;
mod keypoints;
mod labels;
mod landmarks;
mod lost_parts;
mod mask_runs;
mod masks;
mod mesh;
mod mesh_bytes;
mod missing;
mod outline;
mod parts;
mod people;
mod person;
mod photo_file;
mod photos;
mod pieces;
mod pixels;
mod placed;
mod ply;
mod refusal;
mod register;
mod registered;
mod resize;
mod rig;
mod ring;
mod runs;
mod scene;
mod silhouette;
mod smaller;
mod solid;
mod some_photos;
mod srgb;
mod sureness;
mod sway;
pub mod tag36h11;
mod tags;
mod textured;
mod thin;
mod tracks;
mod triangulate;
mod unit;
mod upper_median;
mod warps;

pub use aligned::{Aligned, Alignment, Tones, toned};
pub use bilinear::bilinear;
pub use body_features::{BodyFeatures, HipAt};
pub use by_photo::{ByPhoto, PhotoId};
pub use camera::{Camera, Intrinsics, Pose};
pub use cameras::{Cameras, Length, Scale, View};
pub use coherence::{Coherence, coherence};
pub use crop::Crop;
pub use csv_table::csv_table;
pub use cylinder::{Cylinder, bounding_cylinder, seen_by_half};
pub use distance::signed_distance;
pub use document::Document;
pub use edges::Edge;
pub use evidence::{Evidence, Known, PhotoEvidence};
pub use fill::fill_triangle;
pub use film::{film_to_px, px_to_film};
pub use girth_id::{GirthId, Side};
pub use girth_rules::{GirthSet, LevelRule, Measured, PlaneRule, Region};
pub use girth_table::{Definition, TABLE};
pub use girths::{Girth, Girths, Profile};
pub use image::{Gray, Image, Rgb};
pub use joined::{join, root};
pub use keypoints::{Features, Keypoint, Keypoints};
pub use labels::{Label, Labels, MixtureRow};
pub use landmarks::{Landmark, Landmarks, Part, Plane, PlaneSigma};
pub use lost_parts::{BodyPart, LostParts};
pub use mask_runs::MaskRuns;
pub use masks::{Mask, Masks};
pub use mesh::{Adjacency, Mesh, MeshFault, rows};
pub use missing::{Missing, NamedGirth, by_reason, girth_names, listed};
pub use outline::{HIDDEN, Outline, Place, SHOWN};
pub use parts::{Parts, largest_part, parts};
pub use people::{Found, Joint, People};
pub use person::{Growth, Person, Score, Sex};
pub use photo_file::PhotoFile;
pub use photos::{LEAST_OF_TURN, Photo, PhotoError, Photos};
pub use pixels::{gray_from_file, gray_to_png, rgb_to_jpeg, rgb_to_png};
pub use placed::{Placed, cubic_weights};
pub use ply::{PlyError, mesh_from_ply, mesh_to_ply};
pub use refusal::Refusal;
pub use register::{QUIET_SHARE, QUIET_SIGMAS, register};
pub use registered::{median, registered};
pub use resize::{LOOKED_AT_MPX, within};
pub use rig::{CONTRADICTION, GIVEN_STATURE, Mat, Reference, Rig, Rim, SeenEnds};
pub use ring::cameras_to_svg;
pub use scene::{InPhoto, Scene, Seen};
pub use silhouette::{DISSENT_DEPTH, MIN_DISSENT_PHOTOS, Silhouette, deep_dissent, sole_dissent};
pub use solid::{Furrow, Level, Part as SolidPart, Solid};
pub use some_photos::some_photos;
pub use srgb::{level_of_light, light_of_level, light_of_levels};
pub use sureness::{NINE_IN_TEN, Note, Sigmas, Split};
pub use sway::Sway;
pub use tags::{Tag, Tags};
pub use textured::Textured;
pub use thin::thinned;
pub use tracks::{Observation, Tracks};
pub use triangulate::triangulate;
pub use unit::Unit;
pub use upper_median::upper_median;
pub use warps::{Warp, Warps};

/// Every kind of message of this crate.
pub const MESSAGES: &[&[stage::Template]] = &[
    cameras::MESSAGES,
    missing::MESSAGES,
    photos::MESSAGES,
    refusal::MESSAGES,
    some_photos::MESSAGES,
    sureness::MESSAGES,
    unit::MESSAGES,
];
