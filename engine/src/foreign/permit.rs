//! What the user allowed: remembered by content in the store, for the owner only. A program that was not
//! allowed does not run, nor does its identity.

use super::leftover;
use super::listing::{self, programs};
use super::program::Grant;
use super::run;
use crate::graph::Graph;
use crate::store::{Store, StoreError};
use crate::system::is_mine;
use stage::Hash;

/// Where a store keeps what was allowed.
const FOLDER: &str = "allowed";

/// Whether a program was allowed in this store by its owner, and by nobody else who may write there.
pub fn is_allowed(store: &Store, permission: Hash) -> bool {
    let folder = store.root().join(FOLDER);
    is_mine(&folder) && is_mine(&folder.join(permission.to_hex().as_str()))
}

/// Remembers that the programs of these nodes may run.
///
/// # Errors
///
/// The disk refuses.
pub fn allow(graph: &Graph, nodes: &[usize], store: &Store) -> Result<(), StoreError> {
    for (i, program) in programs(graph, nodes) {
        let permission = program.permission();
        if !is_allowed(store, permission) {
            let name = format!("{FOLDER}/{}", permission.to_hex());
            let text = listing::lines(&graph.nodes[i].name, program).join("\n");
            store.write(&name, format!("{text}\n").as_bytes())?;
        }
    }
    Ok(())
}

/// Which programs cannot run.
#[derive(Debug, Default, PartialEq, Eq)]
pub struct Settled {
    /// The places of the nodes whose programs nobody allowed.
    pub refused: Vec<usize>,
    /// The first node whose identity cannot be told, and why.
    pub unknown: Option<(usize, String)>,
}

/// Tells the programs of these nodes whether they may run, and reads the identities of those that may,
/// once for all graphs of a pipeline.
pub fn settle(graph: &Graph, nodes: &[usize], store: &Store, stop: &dyn Fn() -> bool) -> Settled {
    let mut settled = Settled::default();
    let mut cleared = false;
    for (i, program) in programs(graph, nodes) {
        if let Some(grant) = program.granted.0.get() {
            settled.note(i, grant);
            continue;
        }
        let permission = program.permission();
        if !is_allowed(store, permission) {
            settled.refused.push(i);
            continue;
        }
        if !std::mem::replace(&mut cleared, true) {
            leftover::clear(store.root());
        }
        let folder = store.root().canonicalize();
        let folder = folder.unwrap_or_else(|_| store.root().to_owned());
        let identity = (!program.identity.is_empty()).then(|| {
            program.identities.get(permission, || {
                let printed = run::identity(program, &folder, stop);
                let printed = printed.map_err(|why| why.to_string())?;
                Ok(printed.unwrap_or_default())
            })
        });
        let grant = Grant { folder, identity };
        settled.note(i, &grant);
        let _ = program.granted.0.set(grant);
    }
    settled
}

impl Settled {
    fn note(&mut self, node: usize, grant: &Grant) {
        if let (None, Some(Err(why))) = (&self.unknown, &grant.identity) {
            self.unknown = Some((node, why.clone()));
        }
    }
}
