//! The programs of a pipeline on the command line: which may run, what keeps them apart.

use super::fault::Fault;
use super::program::GlobalArgs;
use crate::foreign::{self, Sandbox};
use crate::graph::Graph;
use crate::store::Store;
use std::sync::Once;
use std::sync::atomic::Ordering;

/// With `--allow-exec` remembers that the programs of a pipeline may run; tells all whether they may.
///
/// # Errors
///
/// The cache cannot be used.
pub(crate) fn permitted(graph: &Graph, global: &GlobalArgs) -> Result<(), Fault> {
    let all: Vec<usize> = (0..graph.nodes.len()).collect();
    if foreign::programs(graph, &all).next().is_none() {
        return Ok(());
    }
    let store = Store::open(&global.cache).map_err(Fault::input)?;
    if global.allow_exec {
        foreign::allow(graph, &all, &store).map_err(Fault::input)?;
    }
    let stop = || global.host.cancel().load(Ordering::Relaxed);
    foreign::settle(graph, &all, &store, &stop);
    Ok(())
}

/// Says once what keeps programs apart from the rest of this machine, if that is nothing.
pub(crate) fn unguarded(graph: &Graph, nodes: &[usize], global: &GlobalArgs) {
    static SAID: Once = Once::new();
    let quiet = global.quiet || global.json;
    if !quiet
        && foreign::programs(graph, nodes).next().is_some()
        && let Sandbox::None(why) = foreign::sandbox()
    {
        SAID.call_once(|| {
            crate::errln!(
                "{why}: the pipeline's programs can reach the network and write wherever you can"
            );
        });
    }
}

/// Lists the programs of a pipeline that nobody has allowed.
///
/// # Errors
///
/// The cache cannot be used.
pub(crate) fn listed(graph: &Graph, global: &GlobalArgs) -> Result<(), Fault> {
    let all: Vec<usize> = (0..graph.nodes.len()).collect();
    if global.quiet || global.json || foreign::programs(graph, &all).next().is_none() {
        return Ok(());
    }
    let store = Store::open(&global.cache).map_err(Fault::input)?;
    let of = |(i, program): (usize, &std::sync::Arc<foreign::Program>)| {
        let allowed = foreign::is_allowed(&store, program.permission());
        (!allowed).then_some(i)
    };
    let refused: Vec<usize> = foreign::programs(graph, &all).filter_map(of).collect();
    if !refused.is_empty() {
        crate::errln!("{}", foreign::listing::refusal(graph, &refused));
    }
    Ok(())
}
