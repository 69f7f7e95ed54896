//! Reads what is true and what was found: cameras, masks, meshes, girths.

use nalgebra::{Matrix3, Point3, Rotation3, Vector3};
use serde_json::Value;
use shape::{GirthId, Mesh, mesh_from_ply};
use stage::{Message, message};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

stage::messages! {
    NOT_NUMBERS = "score-not-numbers": "`{key}` of {name} is not {count} numbers";
    NO_VIEWS = "score-no-views": "it has no list `views`";
}

stage::failures! {
    /// A file that does not have what it should.
    pub enum Unreadable {
        /// Which, and why.
        File(path: String, why: Message) = "fail-score-file": "{path}: {why}",
    }
}

/// A camera: focal length, rotation and centre of camera_from_world. \[px, mm\]
pub(crate) struct Seen {
    pub(crate) focal: f64,
    pub(crate) rotation: Rotation3<f64>,
    pub(crate) centre: Point3<f64>,
}

/// A girth that is true. \[mm\]
pub(crate) struct True {
    pub(crate) contour_mm: f64,
    pub(crate) tape_mm: Option<f64>,
    pub(crate) plane: Option<(Point3<f64>, Vector3<f64>)>,
}

pub(crate) fn error(path: &Path, why: impl Into<Message>) -> Unreadable {
    Unreadable::File(path.display().to_string(), why.into())
}

/// Words of the system, or of a format's reader.
fn foreign(path: &Path, why: impl ToString) -> Unreadable {
    error(path, why.to_string())
}

/// A JSON file, if it is there.
pub(crate) fn json(path: &Path) -> Result<Option<Value>, Unreadable> {
    if !path.exists() {
        return Ok(None);
    }
    let text = std::fs::read_to_string(path).map_err(|e| foreign(path, e))?;
    serde_json::from_str(&text)
        .map(Some)
        .map_err(|e| foreign(path, e))
}

/// Numbers of a (nested) list.
fn numbers(value: &Value) -> Vec<f64> {
    match value {
        Value::Array(list) => list.iter().flat_map(numbers).collect(),
        other => other.as_f64().into_iter().collect(),
    }
}

/// The cameras of a file by the stem of their photo; lengths times `unit` are millimetres.
pub(crate) fn cameras(path: &Path, unit: f64) -> Result<BTreeMap<String, Seen>, Unreadable> {
    let Some(file) = json(path)? else {
        return Ok(BTreeMap::new());
    };
    let views = file
        .get("views")
        .or(file.get("cameras"))
        .and_then(Value::as_array);
    let views = views.ok_or_else(|| error(path, message!(NO_VIEWS)))?;
    let mut seen = BTreeMap::new();
    for view in views {
        let name = view
            .get("image")
            .or(view.get("name"))
            .and_then(Value::as_str)
            .unwrap_or("");
        let get = |key: &str, count: usize| {
            let found = numbers(view.get(key).unwrap_or(&Value::Null));
            let why = || {
                error(
                    path,
                    message!(NOT_NUMBERS, key = key, name = name, count = count),
                )
            };
            if found.len() == count {
                Ok(found)
            } else {
                Err(why())
            }
        };
        let (k, r, t) = (get("K", 9)?, get("R", 9)?, get("t", 3)?);
        let rotation = Rotation3::from_matrix_unchecked(Matrix3::from_row_slice(&r));
        let translation = Vector3::from_column_slice(&t) * unit;
        let centre = Point3::from(-(rotation.inverse() * translation));
        let stem = Path::new(name)
            .file_stem()
            .and_then(|s| s.to_str())
            .unwrap_or(name);
        seen.insert(
            stem.to_owned(),
            Seen {
                focal: k[0],
                rotation,
                centre,
            },
        );
    }
    Ok(seen)
}

/// The true tapes of a folder of truth by the girths' names. \[mm\]
///
/// # Errors
///
/// A file that cannot be read, or is no table of girths.
pub fn true_tapes(truth: &Path) -> Result<BTreeMap<String, f64>, Unreadable> {
    let known = girths(&truth.join("measurements.json"))?.into_iter();
    Ok(known
        .filter_map(|(name, girth)| Some((name, girth.tape_mm?)))
        .collect())
}

/// The girths of `measurements.json` (metres and centimetres).
pub(crate) fn girths(path: &Path) -> Result<BTreeMap<String, True>, Unreadable> {
    let Some(Value::Object(file)) = json(path)? else {
        return Ok(BTreeMap::new());
    };
    let mut known = BTreeMap::new();
    for (name, entry) in &file {
        let number = |key: &str| entry.get(key).and_then(Value::as_f64);
        let Some(cm) = number("cm") else { continue };
        let point = numbers(entry.get("point").unwrap_or(&Value::Null));
        let normal = numbers(entry.get("normal").unwrap_or(&Value::Null));
        let plane = (point.len() == 3 && normal.len() == 3).then(|| {
            let point = Point3::from(Vector3::from_column_slice(&point) * 1000.0);
            (point, Vector3::from_column_slice(&normal))
        });
        if plane.is_some() || GirthId::named(name) == Some(GirthId::UpperArmMean) {
            let tape_mm = number("tape_cm").map(|cm| cm * 10.0);
            known.insert(
                name.clone(),
                True {
                    contour_mm: cm * 10.0,
                    tape_mm,
                    plane,
                },
            );
        }
    }
    Ok(known)
}

/// A mesh, if it is there; coordinates times `unit` are millimetres.
pub(crate) fn mesh(path: &Path, unit: f32) -> Result<Option<Mesh>, Unreadable> {
    if !path.exists() {
        return Ok(None);
    }
    let bytes = std::fs::read(path).map_err(|e| foreign(path, e))?;
    let mut mesh = mesh_from_ply(&bytes).map_err(|e| foreign(path, e))?;
    mesh.positions
        .iter_mut()
        .for_each(|p| *p = p.map(|x| x * unit));
    Ok(Some(mesh))
}

/// The masks of a folder by stem: width and which pixels are body.
pub(crate) fn masks(folder: &Path) -> Result<BTreeMap<String, PathBuf>, Unreadable> {
    let Ok(entries) = std::fs::read_dir(folder) else {
        return Ok(BTreeMap::new());
    };
    let mut found = BTreeMap::new();
    for entry in entries {
        let path = entry.map_err(|e| foreign(folder, e))?.path();
        if path.extension().is_some_and(|e| e == "png")
            && let Some(stem) = path.file_stem().and_then(|s| s.to_str())
        {
            found.insert(stem.to_owned(), path.clone());
        }
    }
    Ok(found)
}

/// One mask: width, height, coverage.
pub(crate) fn mask(path: &Path) -> Result<shape::Mask, Unreadable> {
    let bytes = std::fs::read(path).map_err(|e| foreign(path, e))?;
    shape::gray_from_file(&bytes).map_err(|e| foreign(path, e))
}
