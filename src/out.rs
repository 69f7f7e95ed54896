//! Artifacts as files for people and other programs.

use crate::delivery::DeliveryError;
use shape::{
    Cameras, Document, Girths, Keypoints, Landmarks, Masks, Mesh, Photos, Tags, Textured, Tracks,
    gray_to_png, mesh_to_ply,
};
use stage::AnyArtifact;
use std::path::Path;

/// What cannot be written.
#[derive(Debug, thiserror::Error)]
pub enum OutError {
    /// A folder of results.
    #[error(transparent)]
    Delivery(#[from] DeliveryError),
    /// A photo that is to be drawn on.
    #[error(transparent)]
    Photo(#[from] shape::PhotoError),
    /// Cameras that a format cannot say.
    #[error(transparent)]
    Lens(#[from] shape::Distorted),
    /// No such format for this kind.
    #[error("{kind} cannot be written as `{format}`; known: {known}")]
    Format {
        /// The kind of artifact.
        kind: &'static str,
        /// What was asked for.
        format: String,
        /// What there is.
        known: String,
    },
}

/// The format of a kind that has no other: the artifact's own file, as it lies in the store.
pub const RAW: &str = "tailor";

/// The formats of a kind, the usual one first.
pub fn formats(kind: &str) -> &'static [&'static str] {
    match kind {
        "mesh" => &["ply", "glb", "obj", "views"],
        "textured" => &["glb", "ply", "obj", "views"],
        "cameras" => &["json", "colmap", "colmap-binary", "middlebury", "svg"],
        "masks" => &["png", "sheet"],
        "girths" => &["json", "csv", "schema", "definitions"],
        "photos" => &["capture"],
        "landmarks" => &["json"],
        "document" => &["file"],
        "tags" => &["json"],
        "warps" => &["json"],
        "keypoints" | "tracks" => &["png"],
        _ => &[RAW],
    }
}

/// What the file of an artifact in its usual format ends with.
pub fn extension(artifact: &AnyArtifact) -> &'static str {
    let media = artifact.clone().downcast::<Document>();
    match media
        .as_ref()
        .map(|d| d.media.split(';').next().unwrap_or("").trim())
    {
        Some("text/html") => "html",
        Some("application/json") => "json",
        Some("text/csv") => "csv",
        Some("application/toml") => "toml",
        Some("image/svg+xml") => "svg",
        Some("text/plain") => "txt",
        _ => formats(artifact.kind())[0],
    }
}

/// Files of an artifact in a format: names and bytes. One nameless file, or several in a folder.
/// `raw` gives the bytes of the artifact's own file.
pub fn files(
    artifact: AnyArtifact,
    raw: impl FnOnce() -> Vec<u8>,
    names: &Photos,
    format: Option<&str>,
) -> Result<Vec<(String, Vec<u8>)>, OutError> {
    let kind = artifact.kind();
    let known = formats(kind);
    let format = format.unwrap_or(known[0]);
    let one = |bytes: Vec<u8>| Ok(vec![(String::new(), bytes)]);
    let wrong = || OutError::Format {
        kind,
        format: format.into(),
        known: known.join(", "),
    };
    if !known.contains(&format) {
        return Err(wrong());
    }
    macro_rules! take {
        ($t:ty) => {
            artifact.downcast::<$t>().ok_or_else(wrong)?
        };
    }
    match (kind, format) {
        (_, RAW) => one(raw()),
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
            let sheet = shape::masks_to_sheet(&*take!(Masks), names).map_err(OutError::Photo)?;
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
        _ => Err(wrong()),
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
