//! Artifacts of the product as files for people and other programs: see [`KINDS`](crate::kinds::KINDS).

use engine::kind::{NamedFiles, WriteError};
use shape::{
    Cameras, Document, Girths, Keypoints, Landmarks, Masks, Mesh, Photos, Tags, Textured, Tracks,
    gray_to_png, mesh_to_ply,
};
use stage::AnyArtifact;
use std::path::Path;

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
pub(crate) fn document_extension(artifact: &AnyArtifact) -> Option<&'static str> {
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
        ("mesh", "glb") => one(shape::mesh_to_glb(&*take!(Mesh))),
        ("mesh", "obj") => Ok(shape::mesh_to_obj(&*take!(Mesh))),
        ("mesh", "views") => one(views(&*take!(Mesh))),
        ("textured", "views") => one(views(&take!(Textured).mesh)),
        ("textured", "ply") => one(mesh_to_ply(&take!(Textured).mesh)),
        ("textured", "glb") => one(shape::textured_to_glb(&*take!(Textured))),
        ("textured", "obj") => Ok(shape::textured_to_obj(&*take!(Textured))),
        ("cameras", "json") => one(shape::cameras_to_json(&*take!(Cameras)).into_bytes()),
        ("cameras", "svg") => one(shape::cameras_to_svg(&*take!(Cameras)).into_bytes()),
        ("keypoints", _) => Ok(shape::keypoints_to_png(&*take!(Keypoints), names)?),
        ("tracks", _) => Ok(shape::tracks_to_png(&*take!(Tracks), names)?),
        ("cameras", "colmap-binary") => Ok(shape::cameras_to_colmap_binary(&*take!(Cameras))),
        ("cameras", "middlebury") => {
            one(shape::cameras_to_middlebury(&*take!(Cameras))?.into_bytes())
        }
        ("cameras", "colmap") => Ok(shape::cameras_to_colmap_text(&*take!(Cameras))),
        ("girths", "json") => one(shape::girths_to_json(&*take!(Girths)).into_bytes()),
        ("girths", "csv") => one(shape::girths_to_csv(&*take!(Girths)).into_bytes()),
        ("girths", "schema") => one(shape::girths_schema().into()),
        ("girths", "definitions") => one(shape::definitions_to_markdown().into_bytes()),
        ("landmarks", "json") => one(shape::landmarks_to_json(&*take!(Landmarks)).into_bytes()),
        ("warps", _) => one(warps_to_json(&*take!(shape::Warps)).into_bytes()),
        ("tags", _) => one(tags_to_json(&*take!(Tags)).into_bytes()),
        ("photos", _) => Ok(shape::photos_to_capture(&*take!(Photos))),
        ("document", _) => one(take!(Document).bytes.clone()),
        ("masks", "sheet") => {
            let sheet = shape::masks_to_sheet(&*take!(Masks), names)?;
            one(shape::rgb_to_jpeg(&sheet, 88))
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
                .map(|(id, mask)| (name(id), gray_to_png(mask)))
                .collect())
        }
        _ => Err(wrong().into()),
    }
}

/// A surface from four sides, as JPEG.
fn views(mesh: &Mesh) -> Vec<u8> {
    shape::rgb_to_jpeg(&shape::mesh_to_views(mesh), 90)
}

/// Fields of offsets by photo: the nodes' distance and, row by row, their offsets. \[px\]
fn warps_to_json(warps: &shape::Warps) -> String {
    let view = |(id, w): (shape::PhotoId, &shape::Warp)| {
        let rows: Vec<_> = w.offsets.chunks(w.columns).collect();
        serde_json::json!({ "photo": id.0, "cell_px": w.cell_px, "offsets": rows })
    };
    let views: Vec<_> = warps.views.iter().map(view).collect();
    serde_json::to_string_pretty(&views).expect("bug: warps JSON cannot hold")
}

/// Tags by photo: number and corners. \[px\]
fn tags_to_json(tags: &Tags) -> String {
    let tag = |t: &shape::Tag| serde_json::json!({ "id": t.id, "corners": t.corners });
    let views: Vec<_> = tags
        .views
        .iter()
        .map(|(id, tags)| serde_json::json!({ "photo": id.0, "tags": tags.iter().map(tag).collect::<Vec<_>>() }))
        .collect();
    serde_json::to_string_pretty(&views).expect("bug: tags JSON cannot hold")
}
