//! The folder that `models/made/make_bodies.py` wrote: a folder a family, in it `NNNN.ply` and `NNNN.json` (truth)
//! for each body.

#![allow(
    dead_code,
    reason = "not every program that reads made bodies asks for all of this"
)]

use measure::{Body, BodyInput, FindBody, body, ground};
use rayon::prelude::*;
use serde_json::Value;
use shape::{BodyFeatures, Mesh};
use stage::{Ctx, Stage, Stop};
use std::error::Error;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// What goes wrong, from any thread.
pub(crate) type Fault = Box<dyn Error + Send + Sync>;

/// A made body.
pub(crate) struct MadeBody {
    /// `FAMILY/NNNN`.
    pub(crate) id: String,
    /// What is true of it.
    pub(crate) truth: Value,
    /// Its surface. \[mm\]
    pub(crate) mesh: Arc<Mesh>,
}

/// The folder named on the command line.
pub(crate) fn folder() -> Result<PathBuf, Fault> {
    let named = std::env::args().nth(1);
    Ok(PathBuf::from(
        named.ok_or("name the folder of made bodies")?,
    ))
}

/// Writes a table to the standard output: the columns' names, and the rows of each body of the folder named on the command
/// line.
pub(crate) fn written<Rows>(
    columns: impl IntoIterator<Item: AsRef<[u8]>>,
    rows: fn(&Path) -> Result<Rows, Fault>,
) -> Result<(), Fault>
where
    Rows: IntoIterator<Item = Vec<String>> + Send,
{
    let mut out = csv::Writer::from_writer(std::io::stdout());
    out.write_record(columns)?;
    let all: Vec<_> = truths(&folder()?)?.par_iter().map(|t| rows(t)).collect();
    for rows in all {
        for row in rows? {
            out.write_record(&row)?;
        }
    }
    out.flush()?;
    Ok(())
}

/// All truth files, by family and number.
pub(crate) fn truths(root: &Path) -> Result<Vec<PathBuf>, Fault> {
    let mut found = Vec::new();
    for family in std::fs::read_dir(root)? {
        let family = family?.path();
        if !family.is_dir() {
            continue;
        }
        for file in std::fs::read_dir(family)? {
            let file = file?.path();
            if file.extension().is_some_and(|e| e == "json") && file.with_extension("ply").exists()
            {
                found.push(file);
            }
        }
    }
    found.sort();
    Ok(found)
}

/// Reads a body by its truth file.
pub(crate) fn read(path: &Path) -> Result<MadeBody, Fault> {
    let truth: Value = serde_json::from_slice(&std::fs::read(path)?)?;
    let family = truth["family"].as_str().ok_or("a truth without family")?;
    let number = path.file_stem().unwrap_or_default().to_string_lossy();
    Ok(MadeBody {
        id: format!("{family}/{number}"),
        mesh: Arc::new(shape::mesh_from_ply(&std::fs::read(
            path.with_extension("ply"),
        )?)?),
        truth,
    })
}

impl MadeBody {
    /// As the program reads it on the ground that its soles tell; `None` where it finds no body.
    pub(crate) fn standing(&self) -> Option<Body> {
        let lowest = self.mesh.bounds().map_or(0.0, |b| b.0.z);
        let ground = ground(&self.mesh, None).map_or(lowest, |g| g.height_mm);
        body(&self.mesh, ground)
    }

    /// What the stage finds on its surface alone.
    pub(crate) fn features(&self) -> Result<BodyFeatures, Stop> {
        let input = BodyInput {
            mesh: self.mesh.clone(),
            cameras: None,
            levels: None,
        };
        FindBody::run(&(), input, &Ctx::alone())
    }

    /// A text of the truth; empty where there is none.
    pub(crate) fn text(&self, key: &str) -> String {
        self.truth[key].as_str().unwrap_or_default().to_owned()
    }
}
