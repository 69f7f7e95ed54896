//! What a side saw: its photos, silhouettes and cameras by the photo's name.

use nalgebra::{Matrix3, Rotation3, Vector3};
use serde_json::Value;
use shape::{Camera, Cameras, Intrinsics, Mask, MaskRuns, Masks, Photo, Photos, Pose};
use std::collections::BTreeMap;
use std::path::Path;

/// One photo of a side, as much as is known.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct View {
    /// The photo itself.
    pub photo: Option<Photo>,
    /// Its silhouette.
    pub mask: Option<Mask>,
    /// Its camera.
    pub camera: Option<Camera>,
}

/// Views by the name of the photo, without its ending.
pub type Views = BTreeMap<String, View>;

/// `0003.jpg` → `0003`.
fn stem(name: &str) -> String {
    let stem = Path::new(name).file_stem().and_then(|s| s.to_str());
    stem.unwrap_or(name).to_owned()
}

/// Of a run: silhouettes and cameras are named after the photos.
pub(super) fn of_run(photos: &Photos, masks: Option<&Masks>, cameras: Option<&Cameras>) -> Views {
    let mut views = Views::new();
    for (id, photo) in photos.iter() {
        let view = View {
            photo: Some(photo.clone()),
            mask: masks.and_then(|m| m.views.get(id)).map(MaskRuns::pixels),
            camera: cameras.and_then(|c| c.views.get(id)).map(|v| v.camera),
        };
        views.insert(stem(&photo.name), view);
    }
    views
}

/// Of a folder that `measure` wrote: `masks/*.png` and `cameras.json`; photos are not in it.
pub(super) fn of_folder(folder: &Path) -> Result<Views, String> {
    let mut views = Views::new();
    let entries = std::fs::read_dir(folder.join("masks"));
    for entry in entries.into_iter().flatten().flatten() {
        let path = entry.path();
        if path.extension().is_none_or(|e| e != "png") {
            continue;
        }
        let wrong = |why: String| format!("{}: {why}", path.display());
        let bytes = std::fs::read(&path).map_err(|e| wrong(e.to_string()))?;
        let mask = shape::gray_from_file(&bytes).map_err(wrong)?;
        let name = stem(&entry.file_name().to_string_lossy());
        views.entry(name).or_default().mask = Some(mask);
    }
    let path = folder.join("cameras.json");
    if let Ok(text) = std::fs::read_to_string(&path) {
        let wrong = |why: &dyn std::fmt::Display| format!("{}: {why}", path.display());
        let file: Value = serde_json::from_str(&text).map_err(|e| wrong(&e))?;
        for view in file["views"].as_array().into_iter().flatten() {
            let seen = camera(view).ok_or_else(|| wrong(&"a view is not as `measure` writes it"));
            let name = stem(view["image"].as_str().unwrap_or(""));
            views.entry(name).or_default().camera = Some(seen?);
        }
    }
    Ok(views)
}

/// A view of `cameras.json`.
fn camera(view: &Value) -> Option<Camera> {
    let numbers = |key: &str| -> Option<Vec<f64>> {
        let list = view[key].as_array()?;
        list.iter().map(Value::as_f64).collect()
    };
    let matrix = |key: &str| -> Option<Matrix3<f64>> {
        let rows = view[key].as_array()?;
        let flat = rows
            .iter()
            .flat_map(|r| r.as_array().into_iter().flatten().map(Value::as_f64));
        let flat: Vec<f64> = flat.collect::<Option<_>>()?;
        (flat.len() == 9).then(|| Matrix3::from_row_slice(&flat))
    };
    let (k, t, radial) = (matrix("K")?, numbers("t")?, numbers("distortion")?);
    Some(Camera {
        lens: Intrinsics {
            width: u32::try_from(view["width"].as_u64()?).ok()?,
            height: u32::try_from(view["height"].as_u64()?).ok()?,
            focal: [k[(0, 0)], k[(1, 1)]],
            centre: [k[(0, 2)], k[(1, 2)]],
            radial: radial.try_into().ok()?,
        },
        pose: Pose {
            rotation: Rotation3::from_matrix_unchecked(matrix("R")?),
            translation: Vector3::from_column_slice(&<[f64; 3]>::try_from(t).ok()?),
        },
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use io::cameras_to_json;
    use shape::{PhotoId, Scale};

    #[test]
    fn cameras_come_back_from_their_file() {
        let camera = Camera {
            lens: Intrinsics {
                radial: [0.01, -0.02],
                ..Intrinsics::simple(400, 600, 700.0)
            },
            pose: Pose {
                rotation: Rotation3::from_euler_angles(0.1, -0.2, 0.3),
                translation: Vector3::new(1.0, 2.0, 3000.0),
            },
        };
        let view = shape::View::of("0007.jpg", camera);
        let cameras = Cameras::of([(PhotoId(7), view)], Scale::Mat);
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(
            folder.path().join("cameras.json"),
            cameras_to_json(&cameras),
        )
        .unwrap();
        let views = of_folder(folder.path()).unwrap();
        let back = views["0007"].camera.unwrap();
        assert_eq!(back.lens, camera.lens);
        let moved = back.pose.rotation.matrix() - camera.pose.rotation.matrix();
        proof::near(moved.norm(), 0.0, 1e-12);
        assert_eq!(back.pose.translation, camera.pose.translation);
        std::fs::write(folder.path().join("cameras.json"), "{\"views\":[{}]}").unwrap();
        let error = of_folder(folder.path()).unwrap_err();
        assert!(error.contains("a view is not"), "{error}");
    }
}
