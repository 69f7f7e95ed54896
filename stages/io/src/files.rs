//! An artifact in one of the formats of its kind.

use crate::by_photo::{tags_to_json, tracks_to_json, warps_to_json};
use crate::cameras::{cameras_to_colmap_binary, cameras_to_colmap_text, cameras_to_json};
use crate::capture::photos_to_capture;
use crate::definitions::definitions_to_markdown;
use crate::fhir::girths_to_fhir;
use crate::girths::{girths_schema, girths_to_json};
use crate::girths_csv::girths_to_csv;
use crate::glb::{mesh_to_glb, textured_to_glb};
use crate::landmarks::{body_features_to_json, landmarks_to_json};
use crate::marks::{keypoints_to_png, tracks_to_png};
use crate::mask_steps::{aligned_to_jpeg, evidence_to_png, labels_to_png, scene_to_png};
use crate::middlebury::cameras_to_middlebury;
use crate::obj::{mesh_to_obj, textured_to_obj};
use crate::people::{lost_parts_to_json, people_to_json, people_to_png};
use crate::sheet::masks_to_sheet;
use crate::stl::mesh_to_stl;
use crate::three_mf::mesh_to_3mf;
use crate::views::mesh_to_views;
use crate::write_error::WriteError;
use shape::{
    Aligned, BodyFeatures, Cameras, Document, Evidence, Girths, Keypoints, Labels, Landmarks,
    LostParts, Masks, Mesh, People, Photos, Scene, Tags, Textured, Tracks, Warps, cameras_to_svg,
    gray_to_png, mesh_to_ply, rgb_to_jpeg,
};
use stage::AnyArtifact;
use std::path::Path;

/// Files of an artifact: names and bytes. One nameless file, or several in a folder.
pub type NamedFiles = Vec<(String, Vec<u8>)>;

/// An artifact of another kind, or a format that its kind does not have.
#[derive(Debug, thiserror::Error)]
#[error("{kind} is not written as `{format}`")]
pub struct NoFormat {
    /// The kind of artifact.
    kind: &'static str,
    /// What was asked for.
    format: String,
}

/// What the file of a document ends with.
pub fn document_extension(artifact: &AnyArtifact) -> Option<&'static str> {
    let document = artifact.clone().downcast::<Document>()?;
    match document.media.split(';').next().unwrap_or("").trim() {
        "text/html" => Some("html"),
        "application/json" => Some("json"),
        "text/csv" => Some("csv"),
        "application/toml" => Some("toml"),
        "image/svg+xml" => Some("svg"),
        "text/plain" => Some("txt"),
        _ => None,
    }
}

/// An artifact in one of its kind's formats; photos beside it give files their names.
///
/// # Errors
/// A kind that has no such format, or a photo beside it that cannot be decoded.
pub fn files(
    artifact: AnyArtifact,
    format: &str,
    photos: Option<AnyArtifact>,
) -> Result<NamedFiles, WriteError> {
    let kind = artifact.kind();
    let photos = photos.and_then(|photos| photos.downcast::<Photos>());
    let photos = photos.unwrap_or_default();
    let names = &*photos;
    let one = |bytes: Vec<u8>| Ok(vec![(String::new(), bytes)]);
    let wrong = || NoFormat {
        kind,
        format: format.into(),
    };
    macro_rules! take {
        ($t:ty) => {
            artifact.downcast::<$t>().ok_or_else(wrong)?
        };
    }
    match (kind, format) {
        ("mesh", "ply") => one(mesh_to_ply(&*take!(Mesh))),
        ("mesh", "glb") => one(mesh_to_glb(&*take!(Mesh))),
        ("mesh", "obj") => Ok(mesh_to_obj(&*take!(Mesh))),
        ("mesh", "stl") => one(mesh_to_stl(&*take!(Mesh))?),
        ("mesh", "3mf") => one(mesh_to_3mf(&*take!(Mesh))?),
        ("textured", "stl") => one(mesh_to_stl(&take!(Textured).mesh)?),
        ("textured", "3mf") => one(mesh_to_3mf(&take!(Textured).mesh)?),
        ("mesh", "views") => one(views(&*take!(Mesh))),
        ("textured", "views") => one(views(&take!(Textured).mesh)),
        ("textured", "ply") => one(mesh_to_ply(&take!(Textured).mesh)),
        ("textured", "glb") => one(textured_to_glb(&*take!(Textured))),
        ("textured", "obj") => Ok(textured_to_obj(&*take!(Textured))),
        ("cameras", "json") => one(cameras_to_json(&*take!(Cameras)).into_bytes()),
        ("cameras", "svg") => one(cameras_to_svg(&*take!(Cameras)).into_bytes()),
        ("keypoints", _) => Ok(keypoints_to_png(&*take!(Keypoints), names)?),
        ("tracks", "json") => one(tracks_to_json(&*take!(Tracks)).into_bytes()),
        ("tracks", _) => Ok(tracks_to_png(&*take!(Tracks), names)?),
        ("cameras", "colmap-binary") => Ok(cameras_to_colmap_binary(&*take!(Cameras))),
        ("cameras", "middlebury") => one(cameras_to_middlebury(&*take!(Cameras))?.into_bytes()),
        ("cameras", "colmap") => Ok(cameras_to_colmap_text(&*take!(Cameras))),
        ("girths", "json") => one(girths_to_json(&*take!(Girths)).into_bytes()),
        ("girths", "csv") => one(girths_to_csv(&*take!(Girths)).into_bytes()),
        ("girths", "fhir") => one(girths_to_fhir(&*take!(Girths))?.into_bytes()),
        ("girths", "schema") => one(girths_schema().into()),
        ("girths", "definitions") => one(definitions_to_markdown().into_bytes()),
        ("body_features", _) => one(body_features_to_json(&*take!(BodyFeatures)).into_bytes()),
        ("landmarks", "json") => one(landmarks_to_json(&*take!(Landmarks)).into_bytes()),
        ("warps", _) => one(warps_to_json(&*take!(Warps)).into_bytes()),
        ("tags", _) => one(tags_to_json(&*take!(Tags)).into_bytes()),
        ("people", "json") => one(people_to_json(&*take!(People), names).into_bytes()),
        ("people", _) => Ok(people_to_png(&*take!(People), names)?),
        ("lost_parts", _) => one(lost_parts_to_json(&*take!(LostParts), names).into_bytes()),
        ("photos", _) => Ok(photos_to_capture(&*take!(Photos))),
        ("aligned", _) => Ok(aligned_to_jpeg(&*take!(Aligned), names)?),
        ("scene", _) => Ok(scene_to_png(&*take!(Scene))),
        ("evidence", _) => Ok(evidence_to_png(&*take!(Evidence), names)),
        ("labels", _) => Ok(labels_to_png(&*take!(Labels), names)),
        ("document", _) => one(take!(Document).bytes.clone()),
        ("masks", "sheet") => {
            let sheet = masks_to_sheet(&*take!(Masks), names)?;
            one(rgb_to_jpeg(&sheet, 88))
        }
        ("masks", _) => {
            let masks = take!(Masks);
            let name = |id: shape::PhotoId| {
                let stem = names
                    .get(id)
                    .map(|p| Path::new(&p.name).with_extension("png"));
                let stem = stem.and_then(|p| p.to_str().map(str::to_owned));
                stem.unwrap_or_else(|| format!("{:04}.png", id.0))
            };
            Ok(masks
                .views
                .iter()
                .map(|(id, mask)| (name(id), gray_to_png(&mask.pixels())))
                .collect())
        }
        _ => Err(wrong().into()),
    }
}

/// A surface from four sides, as JPEG.
fn views(mesh: &Mesh) -> Vec<u8> {
    rgb_to_jpeg(&mesh_to_views(mesh), 90)
}
