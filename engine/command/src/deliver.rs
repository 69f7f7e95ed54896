//! `--out`: what is asked before a run, and what is reported after it.

use super::arguments::Change;
use super::fault::Fault;
use super::open::folders;
use super::program::GlobalArgs;
use super::ran::Ran;
use super::result::there;
use engine::Outcome;
use engine::delivery::{self, Delivery, Left};
use engine::graph::Graph;
use engine::out;
use engine::store::Store;
use serde_json::{Value, json};
use stage::message;
use std::path::{Path, PathBuf};
use system::pattern;

stage::messages! {
    INSIDE = "cli-out-inside": "{out} is in {folder}, and what is written there would be read as input the next time; give a folder outside of it with --out";
}

/// A path as it is, as far as it is there yet.
fn real(path: &Path) -> PathBuf {
    let whole = std::path::absolute(path).unwrap_or_else(|_| path.into());
    for there in whole.ancestors() {
        if let Ok(real) = there.canonicalize() {
            let rest = whole.strip_prefix(there).unwrap_or(Path::new(""));
            return if rest.as_os_str().is_empty() {
                real
            } else {
                real.join(rest)
            };
        }
    }
    whole
}

/// Whether a folder is another, or is in it.
pub fn is_within(inner: &Path, outer: &Path) -> bool {
    real(inner).starts_with(real(outer))
}

/// Whose results are those of these inputs: as a hash, so that no folder's name gets out.
pub fn whose(folders: &[(String, PathBuf)]) -> String {
    let mut folders: Vec<_> = folders.iter().map(|(n, f)| (n, real(f))).collect();
    folders.sort();
    let mut hasher = blake3::Hasher::new();
    for (name, folder) in folders {
        hasher.update(format!("{name}={}\n", folder.display()).as_bytes());
    }
    hasher.finalize().to_hex()[..16].to_owned()
}

/// Checks a folder for results before anything runs.
///
/// # Errors
///
/// Results would be in a folder that is read, or over files that are not ours.
pub fn check(out: &Path, graph: &Graph, folders: &[(String, PathBuf)]) -> Result<(), Fault> {
    for (name, folder) in folders {
        let input = graph.inputs.iter().find(|i| i.name == *name);
        let (real_out, real_folder) = (real(out), real(folder));
        let Ok(inner) = real_out.strip_prefix(&real_folder) else {
            continue;
        };
        let patterns = input.iter().flat_map(|i| &i.files);
        if patterns.into_iter().any(|p| pattern::looks_into(p, inner)) {
            return Err(inside(out, folder));
        }
    }
    delivery::check(out).map_err(Fault::of)
}

/// Results in the folder of an input would be read as input the next time.
pub fn inside(out: &Path, folder: &Path) -> Fault {
    let [out, folder] = [out, folder].map(|path| path.display().to_string());
    Fault::coded(&message!(INSIDE, out = out, folder = folder))
}

/// Writes the run down, and reports what earlier runs left.
///
/// # Errors
///
/// The folder cannot be written.
pub fn finish(
    delivery: Delivery,
    graph: &Graph,
    outcome: &Outcome,
    clean: bool,
    global: &GlobalArgs,
) -> Result<(), Fault> {
    written(delivery, outcome.json(graph), clean, global)
}

/// Ends a delivery with its `run.json`, and prints what earlier runs left.
///
/// # Errors
///
/// The folder cannot be written.
pub(super) fn written(
    delivery: Delivery,
    run: Value,
    clean: bool,
    global: &GlobalArgs,
) -> Result<(), Fault> {
    let Left { left, removed } = delivery.finish(run, clean).map_err(Fault::stage)?;
    if global.json || global.quiet {
        return Ok(());
    }
    if !removed.is_empty() {
        crate::errln!("removed, of an earlier run: {}", removed.join(", "));
    }
    if !left.is_empty() {
        let what = match clean {
            true => "changed since, so not removed",
            false => "--clean removes it",
        };
        crate::errln!("left from an earlier run ({what}): {}", left.join(", "));
    }
    Ok(())
}

/// Writes the results that there are of the wanted nodes.
pub(super) fn write(
    delivery: &mut Delivery,
    outcome: &Outcome,
    ran: &Ran<'_>,
    wanted: &[usize],
    global: &GlobalArgs,
) -> Result<(), Fault> {
    let graph = ran.graph;
    let made = |node: &&usize| {
        outcome.nodes[**node]
            .as_ref()
            .is_some_and(|d| d.content.is_some())
    };
    for node in wanted.iter().filter(made) {
        let (artifact, raw) = there(graph, outcome, *node)?;
        let format = out::extension(graph.catalog, &artifact);
        let beside = graph
            .beside(*node)
            .and_then(|at| outcome.artifact(graph, at));
        let artifact = (global.program().present)(artifact, ran);
        let files = out::files(graph.catalog, artifact, || raw, beside, None);
        let mut files = files.map_err(Fault::stage)?;
        if format == "html" {
            for (_, page) in &mut files {
                *page = (global.program().complete)(page, ran);
            }
        }
        let single = files.len() == 1 && files[0].0.is_empty();
        let name = &graph.nodes[*node].name;
        let name = match single {
            // The run's own name is taken.
            true if format!("{name}.{format}") == delivery::RUN => format!("{name}.node.{format}"),
            true => format!("{name}.{format}"),
            false => name.clone(),
        };
        delivery.put(&name, &files).map_err(Fault::stage)?;
    }
    Ok(())
}

/// Begins a delivery of what came of a sweep or a search: who forgets a folder that it came of hears of it.
pub(super) fn begun(out: &Path, change: &Change, global: &GlobalArgs) -> Result<Delivery, Fault> {
    let folders = folders(change)?;
    let of = whose(&folders);
    let store = Store::open(&global.cache).map_err(Fault::input)?;
    store.note_delivery(out, &of, &folders);
    let mut delivery = Delivery::open(out, &of).map_err(Fault::stage)?;
    delivery.begin().map_err(Fault::stage)?;
    Ok(delivery)
}

/// Ends a delivery with tables and plots.
pub(super) fn tables(
    mut delivery: Delivery,
    files: impl IntoIterator<Item = (String, Vec<u8>)>,
    plots: Vec<(String, String)>,
    clean: bool,
    global: &GlobalArgs,
) -> Result<(), Fault> {
    for (name, bytes) in files {
        let file = [(String::new(), bytes)];
        delivery.put(&name, &file).map_err(Fault::stage)?;
    }
    let plots = plots.into_iter().map(|(n, t)| (n, t.into_bytes()));
    let plots: Vec<(String, Vec<u8>)> = plots.collect();
    if !plots.is_empty() {
        delivery.put("plots", &plots).map_err(Fault::stage)?;
    }
    let run = json!({ "program": global.catalog().program });
    written(delivery, run, clean, global)
}
