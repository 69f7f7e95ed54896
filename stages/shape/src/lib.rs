//! The nouns: what flows between stages. They know no verbs.
//!
//! Lengths in millimetres, angles in radians, pixels with the centre of the top-left pixel at
//! (0, 0). World is the turntable frame: origin on the rotation axis at the disk's top, z up,
//! right-handed. `x_in_camera = camera_from_world * x_in_world`, camera x right, y down, z forward.
//!
//! ```text
//! Photos ─ Keypoints ─ Tracks ─ Cameras ─┐
//!    └──────────────── Masks ────────────┴─ Mesh ─ Landmarks ─ Girths ─ Document
//! ```

mod base64;
mod by_photo;
mod camera;
mod cameras;
mod cylinder;
mod distance;
mod document;
mod export;
mod export_cameras;
mod export_definitions;
mod export_girths;
mod export_glb;
mod export_image;
mod export_landmarks;
mod export_marks;
mod export_obj;
mod export_par;
mod export_photos;
mod export_ring;
mod export_sheet;
mod export_views;
mod film;
mod girth_id;
mod girth_names;
mod girth_rules;
mod girth_table;
mod girths;
mod image;
mod keypoints;
mod landmarks;
mod lettering;
mod masks;
mod mesh;
mod missing;
mod odd_masks;
mod photos;
mod pieces;
mod placed;
mod refusal;
mod register;
mod registered;
mod rig;
mod solid;
mod sureness;
mod sway;
pub mod tag36h11;
mod tags;
mod textured;
mod thin;
mod tracks;
mod unit;
mod warps;

pub use base64::base64;
pub use by_photo::{ByPhoto, PhotoId};
pub use camera::{Camera, Intrinsics, Pose};
pub use cameras::{Cameras, Scale, View};
pub use cylinder::{Cylinder, bounding_cylinder, seen_by_half};
pub use distance::signed_distance;
pub use document::Document;
pub use export::{ExportError, mesh_from_ply, mesh_to_ply};
pub use export_cameras::{cameras_to_colmap_binary, cameras_to_colmap_text, cameras_to_json};
pub use export_definitions::definitions_to_markdown;
pub use export_girths::{girths_schema, girths_to_csv, girths_to_json};
pub use export_glb::{mesh_to_glb, textured_to_glb};
pub use export_image::{gray_from_file, gray_to_png, rgb_to_jpeg, rgb_to_png};
pub use export_landmarks::landmarks_to_json;
pub use export_marks::{keypoints_to_png, tracks_to_png};
pub use export_obj::{mesh_to_obj, textured_to_obj};
pub use export_par::{Distorted, cameras_to_middlebury};
pub use export_photos::photos_to_capture;
pub use export_ring::cameras_to_svg;
pub use export_sheet::{mask_on_photo, masks_to_sheet};
pub use export_views::mesh_to_views;
pub use film::{film_to_px, px_to_film};
pub use girth_id::{GirthId, Side};
pub use girth_rules::{GirthSet, LevelRule, Measured, PlaneRule, Region};
pub use girth_table::{Definition, TABLE};
pub use girths::{Girth, Girths, Profile};
pub use image::{Gray, Image, Rgb};
pub use keypoints::{Features, Keypoint, Keypoints};
pub use landmarks::{Landmark, Landmarks, Part, Plane, PlaneSigma};
pub use masks::{Mask, Masks};
pub use mesh::{Adjacency, Mesh, MeshFault};
pub use missing::Missing;
pub use odd_masks::odd;
pub use photos::{Photo, PhotoError, Photos};
pub use placed::{Placed, cubic_weights};
pub use refusal::Refusal;
pub use register::register;
pub use registered::{median, registered};
pub use rig::{Mat, Reference, Rig, Rim};
pub use solid::{Furrow, Level, Part as SolidPart, Solid};
pub use sureness::{Note, Sigmas, Split};
pub use sway::Sway;
pub use tags::{Tag, Tags};
pub use textured::Textured;
pub use thin::thinned;
pub use tracks::{Sighting, Tracks};
pub use unit::Unit;
pub use warps::{Warp, Warps};
