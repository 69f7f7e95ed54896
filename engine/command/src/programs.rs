//! The programs of a pipeline on the command line: which may run, what keeps them apart.

use super::fault::Fault;
use super::program::{GlobalArgs, Walls};
use engine::graph::Graph;
use engine::permission;
use engine::store::Store;
use std::sync::Once;
use std::sync::atomic::Ordering;

/// With `--allow-exec` remembers that the programs of a pipeline may run; sets for all whether they may.
///
/// # Errors
///
/// The cache cannot be used.
pub(crate) fn permitted(graph: &Graph, global: &GlobalArgs) -> Result<(), Fault> {
    let all: Vec<usize> = (0..graph.nodes.len()).collect();
    if permission::programs(graph, &all).next().is_none() {
        return Ok(());
    }
    if global.sandbox == Walls::Required {
        programs::require_sandbox();
        if let Some(lacks) = programs::sandbox().lacks() {
            let what = "`--sandbox required` lets no program run without a full sandbox";
            return Err(Fault::input(format!("{lacks}; {what}")));
        }
    }
    let store = Store::open(&global.cache).map_err(Fault::input)?;
    if global.allow_exec {
        permission::allow(graph, &all).map_err(Fault::input)?;
    }
    let stop = || global.host.cancel().load(Ordering::Relaxed);
    let settled = permission::settle(graph, &all, &store, &stop);
    if !settled.refused.is_empty() {
        unread(&store, global);
    }
    Ok(())
}

/// The words that give another process of this program what programs of a pipeline may.
pub(super) fn words(global: &GlobalArgs) -> Vec<String> {
    let sandbox = (global.sandbox == Walls::Required).then_some(["--sandbox", "required"]);
    let allow = global.allow_exec.then_some("--allow-exec");
    let words = sandbox.into_iter().flatten().chain(allow);
    words.map(str::to_owned).collect()
}

/// Reports once that permissions in a cache count no more, where there are some.
fn unread(store: &Store, global: &GlobalArgs) {
    static REPORTED: Once = Once::new();
    let old = store.root().join("allowed");
    if !global.quiet && !global.json && old.is_dir() {
        REPORTED.call_once(|| {
            let old = old.display();
            crate::errln!("{old} is no longer read: permissions are yours, and come with no cache");
        });
    }
}

/// Reports once what keeps programs apart from the rest of this machine, if that is no full sandbox.
pub(crate) fn unguarded(graph: &Graph, nodes: &[usize], global: &GlobalArgs) {
    static REPORTED: Once = Once::new();
    let quiet = global.quiet || global.json;
    if !quiet
        && permission::programs(graph, nodes).next().is_some()
        && let Some(lacks) = programs::sandbox().lacks()
    {
        REPORTED.call_once(|| crate::errln!("{lacks} (--sandbox required lets none run so)"));
    }
}

/// Lists the programs of a pipeline that nobody has allowed.
///
/// # Errors
///
/// The cache cannot be used.
pub(crate) fn listed(graph: &Graph, global: &GlobalArgs) -> Result<(), Fault> {
    let all: Vec<usize> = (0..graph.nodes.len()).collect();
    if global.quiet || global.json || permission::programs(graph, &all).next().is_none() {
        return Ok(());
    }
    let of = |(i, program): (usize, &std::sync::Arc<programs::Program>)| {
        (!permission::is_allowed(program)).then_some(i)
    };
    let refused: Vec<usize> = permission::programs(graph, &all).filter_map(of).collect();
    if !refused.is_empty() {
        crate::errln!("{}", permission::listing::refusal(graph, &refused));
    }
    Ok(())
}
