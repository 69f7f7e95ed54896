//! Where results were delivered: who forgets a capture hears which folders still hold some of it.
//!
//! `delivered/HASH`, of the folder's path, lists in JSON the folders that the results came of, and has the mark of
//! `run.json` there. No key and no result has any of it.

use super::error::StoreError;
use super::files::at;
use super::folder::Store;
use super::trace::Trace;
use crate::delivery;
use crate::own::{self, whole};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

const FOLDER: &str = "delivered";

/// A folder that results of some inputs were delivered into.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Delivered {
    /// The folder with the results.
    pub out: PathBuf,
    /// Whose they are, as [`delivery::of`] reads it.
    pub of: String,
    /// The folders of the inputs.
    inputs: Vec<String>,
}

impl Delivered {
    /// Whether its results still are there.
    pub(crate) fn is_there(&self) -> bool {
        match delivery::of_readable(&self.out) {
            Ok(of) => of.is_some_and(|of| of == self.of),
            // It may be.
            Err(_) => true,
        }
    }
}

impl Store {
    /// Notes that results of these inputs go into a folder. A cache that cannot note it holds up no run.
    pub fn note_delivery(&self, out: &Path, of: &str, inputs: &[(String, PathBuf)]) {
        let out = whole(out);
        let name = blake3::hash(out.as_os_str().as_encoded_bytes()).to_hex();
        let inputs = inputs.iter().map(|(_, folder)| whole(folder));
        let note = Delivered {
            of: of.to_owned(),
            inputs: inputs.map(|folder| folder.display().to_string()).collect(),
            out,
        };
        let _ = self.write(
            &format!("{FOLDER}/{name}"),
            &serde_json::to_vec(&note).expect("bug: JSON"),
        );
    }

    /// All notes with their names; `None` for those that are broken.
    fn deliveries(&self) -> Result<Vec<(String, Option<Delivered>)>, StoreError> {
        let folder = self.root().join(FOLDER);
        let mut all = Vec::new();
        for name in self.files(FOLDER, own::is_hash)? {
            let bytes = std::fs::read(folder.join(&name)).map_err(at(&folder))?;
            all.push((name, serde_json::from_slice(&bytes).ok()));
        }
        Ok(all)
    }

    /// Where results of a capture were delivered, and still are.
    ///
    /// # Errors
    ///
    /// The disk refuses: then nobody knows.
    pub fn delivered(&self, trace: &Trace) -> Result<Vec<Delivered>, StoreError> {
        let all = self.deliveries()?.into_iter().filter_map(|(_, note)| note);
        let fits = |note: &Delivered| note.inputs.iter().any(|input| trace.has(input));
        Ok(all.filter(|note| fits(note) && note.is_there()).collect())
    }

    /// Removes the notes of inputs that fit, and those that are broken; how many of each.
    pub(super) fn forget_deliveries(
        &self,
        fits: impl Fn(&String) -> bool,
    ) -> Result<(usize, usize), StoreError> {
        let (mut fit, mut broken) = (0, 0);
        for (name, note) in self.deliveries()? {
            let fits = note.as_ref().is_some_and(|n| n.inputs.iter().any(&fits));
            if fits || note.is_none() {
                self.gone(&[FOLDER], &name)?;
            }
            fit += usize::from(fits);
            broken += usize::from(note.is_none());
        }
        Ok((fit, broken))
    }
}
