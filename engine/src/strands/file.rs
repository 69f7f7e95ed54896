//! The file of a plan: all that a machine needs to make any of its strands but the bytes of inputs.
//!
//! It holds the pipeline's texts, what each point sets, and the inputs' files by name and hash; no user,
//! no machine, no time, nothing secret. What is read back is data from strangers: its name must be its
//! hash, and no name of a file may lead out of its folder.

use crate::own;
use crate::store::{Store, StoreError};
use serde::{Deserialize, Serialize};
use stage::{FileEntry, Files, Hash};
use std::path::{Path, PathBuf};
use system::pattern::stays_inside;

/// Raise it whenever a plan of before would be read as something else.
const VERSION: u32 = 1;

/// Where a store keeps plans.
const FOLDER: &str = "plans";

/// A plan.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    version: u32,
    /// The program that made it.
    pub program: String,
    /// The pipeline's text, then those that it extends: name and text.
    pub texts: Vec<(String, String)>,
    /// What is wanted of every point.
    pub wanted: Vec<String>,
    /// The inputs of all points.
    pub inputs: Vec<InputLine>,
    /// One entry a point of the sweep; a run has one.
    pub points: Vec<PointLine>,
    /// Lower layers first.
    pub strands: Vec<StrandLine>,
}

/// An input: what its files are, and where they lay.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct InputLine {
    /// Its name in the pipeline.
    pub name: String,
    /// The folder.
    pub folder: PathBuf,
    /// Name, hash and size \[bytes\] of each file.
    pub files: Vec<(String, String, u64)>,
}

/// What is changed at a point, and what it reads.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PointLine {
    /// Its variants, separated by commas.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub variant: Option<String>,
    /// `NODE.PARAM=VALUE`.
    pub sets: Vec<String>,
    /// Its inputs, by their place in the plan.
    pub inputs: Vec<usize>,
}

/// A strand.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StrandLine {
    /// All that it reads is in lower layers.
    pub layer: usize,
    /// A point that it belongs to, by its place.
    pub point: usize,
    /// The names of its nodes.
    pub nodes: Vec<String>,
    /// The strands that it reads.
    pub reads: Vec<usize>,
    /// The hash of what its nodes do: another program or other scripts would make something else.
    pub recipe: String,
}

/// A plan that cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum PlanError {
    /// There is none of that name.
    #[error(
        "there is no plan {0} in {1}; `plan --strands` or `sweep --strands` makes one and prints its name"
    )]
    None(String, PathBuf),
    /// It is damaged.
    #[error("the plan {0} is not whole ({1}): make it again with `plan --strands`")]
    Corrupt(String, String),
    /// Of another version.
    #[error(
        "the plan was made by {0}, whose plans this program ({1}) does not read: use one version on all machines"
    )]
    Version(String, String),
    /// The store.
    #[error(transparent)]
    Store(#[from] StoreError),
}

impl Plan {
    /// With the version of this program's plans.
    pub(super) fn new(program: &str, texts: Vec<(String, String)>, wanted: Vec<String>) -> Plan {
        Plan {
            version: VERSION,
            program: program.into(),
            texts,
            wanted,
            inputs: vec![],
            points: vec![],
            strands: vec![],
        }
    }

    /// How many layers.
    pub fn layers(&self) -> usize {
        self.strands.last().map_or(0, |s| s.layer + 1)
    }

    /// The strands of a layer: a range of their places.
    pub fn layer(&self, layer: usize) -> std::ops::Range<usize> {
        let below = |layer: usize| self.strands.partition_point(|s| s.layer < layer);
        below(layer)..below(layer + 1)
    }

    /// Writes it into a store, and into the one that machines share, if it is not there yet. Returns its
    /// name.
    ///
    /// # Errors
    ///
    /// The disk refuses, or the shared store.
    pub fn write(&self, store: &Store) -> Result<String, StoreError> {
        let mut bytes = serde_json::to_vec_pretty(self).expect("bug: JSON");
        bytes.push(b'\n');
        let name = stage::hash(&bytes).to_hex().to_string();
        let file = format!("{FOLDER}/{name}");
        // Whoever wrote it before wrote the same.
        if !std::fs::read(store.root().join(&file)).is_ok_and(|there| there == bytes) {
            store.write(&file, &bytes)?;
        }
        store.publish_plan(&name, &bytes)?;
        Ok(name)
    }

    /// The plan of a name, or of the first digits of one, out of a store: its whole name, too.
    ///
    /// # Errors
    ///
    /// There is none, it is not whole, or of another version.
    pub fn read(store: &Store, name: &str) -> Result<(String, Plan), PlanError> {
        let named = name.len() >= SHORTEST;
        let fits = |n: &str| own::is_hash(n) && named && n.starts_with(name);
        if named {
            store.bring_plan(name)?;
        }
        let folder = store.root().join(FOLDER);
        let refused = |path: &Path| {
            let path = path.to_owned();
            |why| StoreError::Disk { path, why }
        };
        let found = own::files(store.root(), FOLDER, fits).map_err(refused(&folder))?;
        let [whole] = found.as_slice() else {
            return Err(PlanError::None(name.into(), store.root().into()));
        };
        let path = folder.join(whole);
        let corrupt = |why: String| PlanError::Corrupt(whole.clone(), why);
        let bytes = std::fs::read(&path).map_err(refused(&path))?;
        if stage::hash(&bytes).to_hex().as_str() != whole {
            return Err(corrupt("its bytes are not those of its name".into()));
        }
        let reported = |bytes: &[u8]| serde_json::from_slice::<Maker>(bytes).ok();
        if let Some(maker) = reported(&bytes).filter(|m| m.version != VERSION) {
            return Err(PlanError::Version(maker.program, VERSION.to_string()));
        }
        let plan: Plan = serde_json::from_slice(&bytes).map_err(|e| corrupt(e.to_string()))?;
        plan.sound().map_err(corrupt)?;
        Ok((whole.clone(), plan))
    }

    /// Whether all that refers to something refers to what is there.
    fn sound(&self) -> Result<(), String> {
        let names = self.inputs.iter().flat_map(|i| &i.files);
        for (name, hash, _) in names {
            if !stays_inside(name) || !own::is_hash(hash) {
                return Err(format!("{name:?} with {hash:?} is no file of an input"));
            }
        }
        let inputs = |p: &PointLine| p.inputs.iter().all(|i| *i < self.inputs.len());
        let points = self.points.iter().all(inputs);
        let below = |(at, s): (usize, &StrandLine)| {
            let lower = |from: &usize| *from < at && self.strands[*from].layer < s.layer;
            s.point < self.points.len() && s.reads.iter().all(lower) && s.layer <= at
        };
        let sorted = self.strands.is_sorted_by_key(|s| s.layer);
        match points && sorted && self.strands.iter().enumerate().all(below) {
            true => Ok(()),
            false => Err("it refers to what is not in it".into()),
        }
    }
}

/// The first digits of a name are enough, if they are so many.
pub const SHORTEST: usize = 6;

/// What every version of a plan has.
#[derive(Deserialize)]
struct Maker {
    version: u32,
    #[serde(default)]
    program: String,
}

impl InputLine {
    /// Of files that were hashed.
    pub(super) fn of(name: &str, files: &Files) -> InputLine {
        let line = |e: &FileEntry| (e.name.clone(), e.content.to_hex().to_string(), e.size);
        InputLine {
            name: name.into(),
            folder: files.root.clone(),
            files: files.entries.iter().map(line).collect(),
        }
    }

    /// As files that were hashed: whoever reads one holds it against its hash.
    pub fn files(&self) -> Files {
        let entry = |(name, hash, size): &(String, String, u64)| FileEntry {
            name: name.clone(),
            content: Hash::from_hex(hash).expect("bug: looked at when it was read"),
            size: *size,
        };
        Files {
            root: self.folder.clone(),
            entries: self.files.iter().map(entry).collect(),
        }
    }
}
