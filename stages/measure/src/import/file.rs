//! One JSON file of another program, and what is wrong with it.

use serde::Deserialize;
use serde::de::DeserializeOwned;
use shape::{Part, Plane, Region, Unit};
use stage::{Files, FilesError};
use std::collections::BTreeSet;

/// Why nothing was taken from a file.
#[derive(Debug, thiserror::Error)]
pub enum ImportError {
    /// None or several.
    #[error("one file `{0}` is wanted, but {1} files are there")]
    Count(&'static str, usize),
    /// Not JSON, or JSON of another shape; with line and column.
    #[error("{0}: {1}")]
    Json(String, serde_json::Error),
    /// An entry that cannot be.
    #[error("{file}: `{name}`: {why}")]
    Entry {
        /// The file.
        file: String,
        /// The entry's name.
        name: String,
        /// What is wrong with it.
        why: &'static str,
    },
    /// Another unit than that of the surface.
    #[error("{file}: lengths are {file_unit} there, and {unit} on the surface")]
    Unit {
        /// The file.
        file: String,
        /// Its text.
        file_unit: &'static str,
        /// What the surface has.
        unit: &'static str,
    },
    /// A file that cannot be read.
    #[error(transparent)]
    Files(#[from] FilesError),
}

/// The one JSON file that is there, with its name.
pub(super) fn read<T: DeserializeOwned>(
    files: &Files,
    wanted: &'static str,
) -> Result<(String, T), ImportError> {
    let [entry] = &files.entries[..] else {
        return Err(ImportError::Count(wanted, files.entries.len()));
    };
    let value = serde_json::from_slice(&files.read(entry)?);
    let value = value.map_err(|why| ImportError::Json(entry.name.clone(), why))?;
    Ok((entry.name.clone(), value))
}

/// What a file's `unit` is: `relative`, or `mm` and `cm`, which keys tell apart.
#[derive(Deserialize, Clone, Copy, PartialEq, Eq)]
#[serde(rename_all = "lowercase")]
pub(super) enum FileUnit {
    Mm,
    Cm,
    Relative,
}

impl FileUnit {
    pub(super) fn unit(self) -> Unit {
        match self {
            FileUnit::Relative => Unit::Relative,
            FileUnit::Mm | FileUnit::Cm => Unit::Metric,
        }
    }
}

/// A word for it.
pub(super) fn word(unit: Unit) -> &'static str {
    match unit {
        Unit::Metric => "millimetres",
        Unit::Relative => "relative",
    }
}

/// A plane as files have it: in millimetres, or relative.
#[derive(Deserialize)]
pub(super) struct FilePlane {
    point_mm: Option<[f64; 3]>,
    point_rel: Option<[f64; 3]>,
    normal: [f64; 3],
}

impl FilePlane {
    /// The plane, its normal of length 1. Relative lengths are thousandths inside.
    pub(super) fn plane(&self, unit: Unit) -> Result<Plane, &'static str> {
        let point_mm = match (unit, self.point_mm, self.point_rel) {
            (Unit::Metric, Some(mm), _) => mm,
            (Unit::Relative, _, Some(rel)) => rel.map(|x| 1000.0 * x),
            (Unit::Metric, None, _) => return Err("its plane has no `point_mm`"),
            (Unit::Relative, ..) => return Err("its plane has no `point_rel`"),
        };
        let length = libm::sqrt(self.normal.iter().map(|x| x * x).sum());
        match length > 1e-9 && length.is_finite() {
            true => Ok(Plane {
                point_mm,
                normal: self.normal.map(|x| x / length),
            }),
            false => Err("its plane's normal has no direction"),
        }
    }
}

/// What is beside a section of a part where its name does not tell: nothing is demanded of it.
pub(super) fn region(part: Part) -> Region {
    match part {
        Part::Head => Region::Neck,
        Part::Trunk => Region::Waist,
        Part::ArmLeft | Part::ArmRight => Region::UpperArm,
        Part::LegLeft | Part::LegRight => Region::Thigh,
    }
}

/// Names are there once, and are no empty ones.
pub(super) fn once<'a>(
    file: &str,
    names: impl Iterator<Item = &'a String>,
) -> Result<(), ImportError> {
    let mut seen = BTreeSet::new();
    for name in names {
        let why = match (name.trim().is_empty(), seen.insert(name)) {
            (true, _) => "a name is wanted",
            (_, false) => "it is there twice",
            _ => continue,
        };
        let (file, name) = (file.to_owned(), name.clone());
        return Err(ImportError::Entry { file, name, why });
    }
    Ok(())
}
