//! `tailor compare`: variants, runs and folders side by side.

use crate::compare::{NodeRun, Side, TechnicalErrors, compare, json, markdown, mixed, page};
use crate::repeat::technical_errors;
use crate::store::Store;
use crate::{delivery, walk};
use clap::Args;
use engine::cli::{Change, Fault, GlobalArgs, execute, folders, open_pipeline};
use engine::past::ago;
use std::path::{Path, PathBuf};

/// Arguments of `tailor compare`.
#[derive(Args)]
pub(crate) struct CompareArgs {
    /// What is compared, the reference first: folders that `measure` or `run` wrote; `last` and
    /// `last~1` for runs of the cache; and, after a pipeline file, what to change in it: a variant,
    /// NODE.PARAM=VALUE, several joined by `+`, or `as-is`
    #[arg(required = true)]
    what: Vec<String>,
    #[command(flatten)]
    change: Change,
    /// Differences up to this are none, for every girth; else each has its limit of ISO 20685-1
    #[arg(long)]
    tolerance_mm: Option<f64>,
    /// A repeat.json of `tailor repeat`: its technical errors tell what repetition alone gives; else the captures do
    #[arg(long)]
    repeat: Option<PathBuf>,
    /// Write compare.md, compare.json and compare.html into this folder
    #[arg(long)]
    out: Option<PathBuf>,
    /// Leave the photos off the page
    #[arg(long)]
    no_photos: bool,
}

/// Compares two or more sides and writes the page.
pub(crate) fn compare_sides(args: &CompareArgs, global: &GlobalArgs) -> Result<(), Fault> {
    let pipeline = args.what.iter().find(|w| w.ends_with(".toml"));
    let what: Vec<&String> = args.what.iter().filter(|w| !w.ends_with(".toml")).collect();
    if what.len() < 2 || args.what.len() > what.len() + 1 {
        return Err(Fault::input(
            "give two or more to compare: folders that `tailor measure` wrote, `last` and `last~1`, or a pipeline file and variants of it",
        ));
    }
    if let Some(out) = &args.out {
        delivery::check(out).map_err(Fault::input)?;
    }
    let known = known_errors(args.repeat.as_deref())?;
    // A pipeline that cannot be is refused before any other runs.
    let mut graphs = Vec::new();
    for text in &what {
        graphs.push(match pipeline {
            Some(file) if !Path::new(text).is_dir() && ago(text).is_none() => Some(open_pipeline(
                Some(Path::new(file)),
                &changed(text, &args.change),
                global,
            )?),
            _ => None,
        });
    }
    let folders = folders(&args.change)?;
    let mut sides = Vec::new();
    for (text, graph) in what.iter().zip(&graphs) {
        sides.push(match graph {
            None => found(text, global)?,
            Some(graph) => {
                if !global.quiet && !global.json {
                    engine::errln!("{text}:");
                }
                let again: Vec<String> = std::env::args().collect();
                let again = again.join(" ");
                let store = Store::open(&global.cache).map_err(Fault::input)?;
                let outcome = execute(
                    store,
                    graph,
                    &folders,
                    &walk::all(graph, &graph.goal),
                    global,
                    &again,
                )?;
                let store = Store::open(&global.cache).map_err(Fault::input)?;
                Side::from_run(text, &outcome.json(graph), &store).map_err(Fault::stage)?
            }
        });
    }
    if let Some(why) = mixed(&sides) {
        return Err(Fault::input(why));
    }
    let comparison = compare(sides, args.tolerance_mm, &known);
    let pretty = || serde_json::to_string_pretty(&json(&comparison)).expect("bug: JSON");
    if let Some(folder) = &args.out {
        for (file, text) in [
            ("compare.md", markdown(&comparison)),
            ("compare.json", pretty()),
            ("compare.html", page(&comparison, !args.no_photos)),
        ] {
            let file = folder.join(file);
            delivery::write(&file, &[(String::new(), text.into_bytes())]).map_err(Fault::stage)?;
        }
    }
    match global.json {
        true => engine::outln!("{}", pretty()),
        false => engine::out!("{}", markdown(&comparison)),
    }
    Ok(())
}

/// The technical errors of a `repeat.json`; none where none is given.
pub(super) fn known_errors(file: Option<&Path>) -> Result<TechnicalErrors, Fault> {
    let Some(file) = file else {
        return Ok(TechnicalErrors::new());
    };
    let wrong = |why: String| Fault::input(format!("{}: {why}", file.display()));
    let text = std::fs::read_to_string(file).map_err(|e| wrong(e.to_string()))?;
    technical_errors(&text).map_err(wrong)
}

/// `quick+hull.voxel_mm=2` beside what is changed for all.
fn changed(text: &str, all: &Change) -> Change {
    let mut change = all.clone();
    let mut variants: Vec<String> = change.variant.into_iter().collect();
    for part in text.split('+').filter(|p| *p != "as-is") {
        match part.contains('=') {
            true => change.set.push(part.to_owned()),
            false => variants.push(part.to_owned()),
        }
    }
    change.variant = (!variants.is_empty()).then(|| variants.join(","));
    change
}

/// A folder of results, or a run of the cache: how long ago it was, or the name of a pin.
fn found(text: &str, global: &GlobalArgs) -> Result<Side, Fault> {
    let pinned = std::fs::read_to_string(global.cache.join("pins").join(text));
    let id = match (pinned.ok().filter(|_| !text.contains('/')), ago(text)) {
        (Some(pinned), _) => Some(pinned.trim().to_owned()),
        (None, Some(ago)) => {
            let ids = crate::past::ids(&global.cache);
            let unknown = || Fault::input(format!("`{text}`: the cache knows {} runs", ids.len()));
            Some(ids.get(ago).ok_or_else(unknown)?.clone())
        }
        (None, None) => None,
    };
    if let Some(id) = id {
        let store = Store::open(&global.cache).map_err(Fault::input)?;
        let gone = || Fault::input(format!("`{text}`: the record of that run is gone"));
        let (found, nodes) =
            crate::past::nodes_as::<NodeRun>(&global.cache, &id).ok_or_else(gone)?;
        let mut nodes: Vec<NodeRun> = nodes.collect();
        if found {
            nodes
                .iter_mut()
                .for_each(|node| node.status = "found".into());
        }
        return Side::from_nodes(text, nodes, &store).map_err(Fault::input);
    }
    let folder = Path::new(text);
    if !folder.is_dir() {
        return Err(Fault::input(format!(
            "`{text}` is no folder; to compare variants, name their pipeline first: tailor compare pipelines/body.toml as-is quick --input photos=DIR"
        )));
    }
    let name = folder
        .file_name()
        .map_or(text.to_owned(), |n| n.to_string_lossy().into_owned());
    Side::from_folder(&name, folder).map_err(Fault::input)
}
