//! Where results were delivered: who forgets a capture hears which folders still hold some of it.
//!
//! `delivered/HASH`, of the folder's path, says in JSON which folders the results came of, and the mark by which `run.json`
//! there says the same. No key and no result has any of it.

use super::error::StoreError;
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
    /// Whether its results still lie there.
    pub(crate) fn is_there(&self) -> bool {
        delivery::of(&self.out).is_some_and(|of| of == self.of)
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

    fn delivery(&self, name: &str) -> Option<Delivered> {
        let bytes = std::fs::read(self.root().join(FOLDER).join(name)).ok()?;
        serde_json::from_slice(&bytes).ok()
    }

    /// The notes of inputs that fit, with their names.
    fn deliveries(&self, fits: impl Fn(&String) -> bool) -> Vec<(String, Delivered)> {
        let names = own::files(self.root(), FOLDER, own::is_hash).into_iter();
        let note = |name: String| {
            let note = self.delivery(&name)?;
            note.inputs.iter().any(&fits).then_some((name, note))
        };
        names.filter_map(note).collect()
    }

    /// Where results of a capture were delivered, and still are.
    pub fn delivered(&self, trace: &Trace) -> Vec<Delivered> {
        let all = self.deliveries(|input| trace.has(input));
        all.into_iter()
            .map(|(_, note)| note)
            .filter(Delivered::is_there)
            .collect()
    }

    /// Removes the notes of inputs that fit, and those that cannot be read; how many fit.
    pub(super) fn forget_deliveries(
        &self,
        fits: impl Fn(&String) -> bool,
    ) -> Result<usize, StoreError> {
        let all = self.deliveries(fits);
        for (name, _) in &all {
            self.gone(&[FOLDER], name)?;
        }
        let unread = |name: &str| own::is_hash(name) && self.delivery(name).is_none();
        self.all_gone(FOLDER, unread)?;
        Ok(all.len())
    }
}
