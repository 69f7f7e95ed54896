//! Nouns as files for people and other programs: JSON, CSV, FHIR, GLB, OBJ, STL, 3MF, COLMAP, drawings, pictures.
//!
//! [`files()`] writes any artifact in one of the formats of its kind. PLY, JPEG and PNG, which stage crates read
//! and write as well, are `shape`'s.

mod by_photo;
mod cameras;
mod capture;
mod definitions;
mod fhir;
mod files;
mod girths;
mod girths_csv;
mod glb;
mod landmarks;
mod lettering;
mod marks;
mod mask_steps;
mod middlebury;
mod obj;
mod odd_masks;
mod people;
mod sheet;
mod small;
mod stl;
mod three_mf;
mod views;
mod write_error;

pub use cameras::{cameras_to_colmap_binary, cameras_to_colmap_text, cameras_to_json};
pub use capture::photos_to_capture;
pub use definitions::definitions_to_markdown;
pub use fhir::{NoLengths, girths_to_fhir};
pub use files::{NamedFiles, NoFormat, document_extension, files};
pub use girths::{girths_schema, girths_to_json};
pub use girths_csv::girths_to_csv;
pub use glb::{mesh_to_glb, textured_to_glb};
pub use landmarks::{body_features_to_json, landmarks_to_json};
pub use marks::{keypoints_to_png, tracks_to_png};
pub use mask_steps::{aligned_to_jpeg, evidence_to_png, labels_to_png, scene_to_png};
pub use middlebury::{Distorted, cameras_to_middlebury};
pub use obj::{mesh_to_obj, textured_to_obj};
pub use people::{lost_parts_to_json, people_to_json, people_to_png};
pub use sheet::{mask_on_photo, masks_to_sheet};
pub use small::small;
pub use stl::mesh_to_stl;
pub use three_mf::{NoUnit, mesh_to_3mf};
pub use views::mesh_to_views;
pub use write_error::WriteError;
