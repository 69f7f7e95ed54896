//! One side: what ran, the girths and the surface that came out.

use super::views::{self, Views};
use crate::girth_file::{GirthFile, ReadGirth};
use engine::Catalog;
use engine::differ::NodeRun;
use engine::store::Store;
use io::girths_to_json;
use serde_json::Value;
use shape::{Cameras, Girths, Masks, Mesh, Photos, Unit, mesh_from_ply};
use stage::{AnyArtifact, Hash, Message};
use std::path::Path;

/// What is compared.
#[derive(Debug, Clone, PartialEq)]
pub struct Side {
    /// What people call it.
    pub name: String,
    /// What ran, each after what it reads.
    pub nodes: Vec<NodeRun>,
    /// What lengths of its girths are in; none where it has no girths.
    pub unit: Option<Unit>,
    /// The girths.
    pub girths: Vec<ReadGirth>,
    /// The surface that was measured.
    pub mesh: Option<Mesh>,
    /// What was seen; photos only of a run, since folders of results hold none.
    pub views: Views,
}

stage::failures! {
    /// Something that cannot be compared.
    pub enum SideError {
        /// Not what it should be.
        File {
            /// The file.
            path: String,
            /// What is wrong.
            why: Message,
        } = "fail-side-file": "{path}: {why}",
        /// A result that is not in the cache any more.
        Gone(what: &'static str, name: String) = "fail-side-gone": "the {what} of {name} went out of the cache: run it again",
        /// No run record.
        Record(name: String) = "fail-side-record": "{name} is no record of a run",
        /// A folder of something else.
        Folder(path: String) = "cli-side-folder": "{path}: is not there: give a folder that `tailor measure` wrote",
    }
}

fn nodes(name: &str, run: &Value) -> Result<Vec<NodeRun>, SideError> {
    let nodes = serde_json::from_value(run["nodes"].clone());
    nodes.map_err(|e| SideError::Record(format!("{name} ({e})")))
}

impl Side {
    /// Out of a folder that `measure` or `run` wrote. Girths and surface may be missing.
    ///
    /// # Errors
    ///
    /// No `run.json` there, or a file that cannot be read.
    pub fn from_folder(name: &str, folder: &Path) -> Result<Side, SideError> {
        let read = |file: &str| -> Result<Option<Vec<u8>>, SideError> {
            let path = folder.join(file);
            match std::fs::read(&path) {
                Ok(bytes) => Ok(Some(bytes)),
                Err(e) if e.kind() == std::io::ErrorKind::NotFound => Ok(None),
                Err(e) => Err(wrong(folder, file, e)),
            }
        };
        let run = read("run.json")?
            .ok_or_else(|| SideError::Folder(folder.join("run.json").display().to_string()))?;
        let run: Value = serde_json::from_slice(&run).map_err(|e| wrong(folder, "run.json", e))?;
        let girths = match read("girths.json")? {
            Some(bytes) => Some(
                GirthFile::read(&String::from_utf8_lossy(&bytes))
                    .map_err(|e| wrong(folder, "girths.json", e))?,
            ),
            None => None,
        };
        let (unit, girths) = girths.map(|g| (g.unit, g.girths)).unzip();
        let mut mesh = None;
        for file in ["body.ply", "hull.ply"] {
            if let (None, Some(bytes)) = (&mesh, read(file)?) {
                mesh = Some(mesh_from_ply(&bytes).map_err(|e| wrong(folder, file, e))?);
            }
        }
        Ok(Side {
            name: name.into(),
            nodes: nodes(name, &run)?,
            unit,
            girths: girths.unwrap_or_default(),
            mesh,
            views: views::of_folder(folder).map_err(|e| wrong(folder, "", e))?,
        })
    }

    /// Out of a run whose results are in a store.
    ///
    /// # Errors
    ///
    /// A record that is not one of a run, or a result that is no longer in the store.
    pub fn from_run(
        name: &str,
        run: &Value,
        store: &Store,
        catalog: &Catalog,
    ) -> Result<Side, SideError> {
        Side::from_nodes(name, nodes(name, run)?, store, catalog)
    }

    /// Out of the nodes of a run whose results are in a store.
    ///
    /// # Errors
    ///
    /// A result that is no longer in the store.
    pub fn from_nodes(
        name: &str,
        nodes: Vec<NodeRun>,
        store: &Store,
        catalog: &Catalog,
    ) -> Result<Side, SideError> {
        let yields = |n: &NodeRun, kind: &str| {
            n.content.is_some() && catalog.find(&n.stage).is_some_and(|s| s.yields() == kind)
        };
        let last = |kind: &str| nodes.iter().rev().find(|n| yields(n, kind));
        let measured = last("girths");
        let mesh = measured.and_then(|g| {
            let reads = |n: &&NodeRun| {
                g.provenance
                    .lines()
                    .any(|(_, v)| Some(v) == n.content.as_deref())
            };
            nodes.iter().rev().filter(|n| yields(n, "mesh")).find(reads)
        });
        let read = |node: Option<&NodeRun>, what| -> Result<Option<AnyArtifact>, SideError> {
            let Some(node) = node else { return Ok(None) };
            let gone = || SideError::Gone(what, name.to_owned());
            let hash = node.content.as_ref().and_then(|c| Hash::from_hex(c).ok());
            let blob = hash.and_then(|h| store.blob(h)).ok_or_else(gone)?;
            let stage = catalog.find(&node.stage).ok_or_else(gone)?;
            Ok(Some(stage.read(&blob).map_err(|_| gone())?))
        };
        let girths = read(measured, "girths")?.and_then(|a| a.downcast::<Girths>());
        let mesh = read(mesh.or_else(|| last("mesh")), "surface")?;
        // A result on the way may have gone: then there is no picture of it.
        let there = |kind: &'static str| read(last(kind), kind).ok().flatten();
        let photos = there("photos").and_then(|a| a.downcast::<Photos>());
        let masks = there("masks").and_then(|a| a.downcast::<Masks>());
        let cameras = there("cameras").and_then(|a| a.downcast::<Cameras>());
        let views = photos.map(|p| views::of_run(&p, masks.as_deref(), cameras.as_deref()));
        let girths =
            girths.map(|g| GirthFile::read(&girths_to_json(&g)).expect("bug: girths JSON"));
        let (unit, girths) = girths.map(|g| (g.unit, g.girths)).unzip();
        Ok(Side {
            name: name.into(),
            unit,
            girths: girths.unwrap_or_default(),
            mesh: mesh
                .and_then(|a| a.downcast::<Mesh>())
                .map(|m| (*m).clone()),
            nodes,
            views: views.unwrap_or_default(),
        })
    }

    /// What all of it took when it was made. \[s\]
    pub fn seconds(&self) -> f64 {
        self.nodes.iter().map(|n| n.seconds).sum()
    }

    /// Size of all results. \[bytes\]
    pub fn bytes(&self) -> u64 {
        self.nodes.iter().map(|n| n.bytes).sum()
    }

    /// The node of a name.
    pub fn node(&self, name: &str) -> Option<&NodeRun> {
        self.nodes.iter().find(|n| n.node == name)
    }
}

fn wrong(folder: &Path, file: &str, why: impl ToString) -> SideError {
    SideError::File {
        path: folder.join(file).display().to_string(),
        why: why.to_string().into(),
    }
}
