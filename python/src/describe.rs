//! What an artifact holds beside its arrays, as JSON: the documented format where its kind has one.

use command::Fault;
use engine::out;
use serde_json::{Value, json};
use shape::{Document, Person, Photo, PhotoId, Photos, Solid, Sway, Unit};
use stage::{AnyArtifact, AnyStage, Artifact, Files};

/// As JSON. A kind that is all arrays has nothing.
pub(crate) fn describe(bytes: &[u8], stage: &'static dyn AnyStage) -> Result<String, Fault> {
    let formats = out::formats(tailor::program().catalog, stage.yields());
    match stage.yields() {
        // Its cells are arrays, which its JSON writes out.
        "warps" => {}
        // As it is written: reading its numbers and writing them again may change their last digit.
        _ if formats.contains(&"json") => {
            return in_json(stage.read(bytes).map_err(Fault::stage)?);
        }
        _ => {}
    }
    value(bytes, stage).map(|value| value.to_string())
}

fn value(bytes: &[u8], stage: &'static dyn AnyStage) -> Result<Value, Fault> {
    let file = stage::opened(bytes).map_err(Fault::stage)?;
    let read = || stage.read(bytes).map_err(Fault::stage);
    Ok(match stage.yields() {
        // Photo, width, height.
        "masks" => json!(file.meta::<Vec<(u32, u32, u32)>>().map_err(Fault::stage)?),
        "mesh" => json!({ "unit": unit(file.meta().map_err(Fault::stage)?) }),
        // Width and height of the atlas.
        "textured" => {
            let (lengths, width, height): (Unit, u64, u64) = file.meta().map_err(Fault::stage)?;
            json!({ "unit": unit(lengths), "width": width, "height": height })
        }
        "keypoints" => json!(file.meta::<Vec<PhotoId>>().map_err(Fault::stage)?),
        // Photo, cell in pixels, columns.
        "warps" => json!(file.meta::<Vec<(u32, f64, u32)>>().map_err(Fault::stage)?),
        "document" => json!(typed::<Document>(read()?)?.media),
        "sway" => {
            let sway = typed::<Sway>(read()?)?;
            let pose = |(photo, pose): (PhotoId, &shape::Pose)| {
                let rows = pose.rotation.matrix().row_iter();
                let rows: Vec<[f64; 3]> = rows.map(|r| [r[0], r[1], r[2]]).collect();
                json!({ "photo": photo, "R": rows, "t": pose.translation.as_slice() })
            };
            sway.views.iter().map(pose).collect()
        }
        "person" => json!(*typed::<Person>(read()?)?),
        "solid" => json!(*typed::<Solid>(read()?)?),
        "files" => {
            let files = typed::<Files>(read()?)?;
            let entry = |e: &stage::FileEntry| json!({ "name": e.name, "content": e.content.to_hex().as_str(), "size": e.size });
            files.entries.iter().map(entry).collect()
        }
        _ => Value::Null,
    })
}

/// What lengths are in.
fn unit(lengths: Unit) -> &'static str {
    lengths.length(0.0).1
}

fn typed<A: Artifact>(artifact: AnyArtifact) -> Result<std::sync::Arc<A>, Fault> {
    let wrong = || Fault::stage(format!("bug: this is no {}", A::KIND));
    artifact.downcast().ok_or_else(wrong)
}

/// In the kind's own JSON.
fn in_json(artifact: AnyArtifact) -> Result<String, Fault> {
    let catalog = tailor::program().catalog;
    let files = out::files(catalog, artifact, Vec::new, None, Some("json"));
    let files = files.map_err(Fault::stage)?;
    let bytes = files.into_iter().next().map(|(_, bytes)| bytes);
    String::from_utf8(bytes.unwrap_or_default()).map_err(Fault::stage)
}

/// Photos without their pixels.
pub(crate) fn photos(photos: &Photos) -> Value {
    let one = |photo: &Photo| {
        json!({
            "name": photo.name, "width": photo.width, "height": photo.height,
            "orientation": photo.orientation, "focal_35mm": photo.focal_35mm,
            "device": photo.device, "time_s": photo.time_s,
        })
    };
    json!({
        "photos": photos.photos.iter().map(one).collect::<Vec<_>>(),
        "plate": photos.plate.as_ref().map(one), "rig": photos.rig,
    })
}
