//! `tailor compare`: variants, runs and folders side by side.

use super::compare_replicates::{Against, changed, of_folders, of_variants};
use super::spoken::Spoken;
use crate::catalog::CATALOG;
use crate::compare::{NodeRun, Side, TechnicalErrors, compare, json, markdown, mixed, page};
use crate::repeat::technical_errors;
use crate::store::Store;
use crate::{delivery, walk};
use clap::Args;
use command::{Change, Fault, GlobalArgs, execute, folders, open_pipeline};
use engine::past::ago;
use stage::message;
use std::path::{Path, PathBuf};
use study::reader::English;

stage::messages! {
    GONE = "cli-compare-gone": "`{run}`: the record of that run is gone";
    NO_FOLDER = "cli-compare-folder": "`{folder}` is no folder; to compare variants, name their pipeline first: tailor compare body as-is quick --input photos=DIR";
    NO_PIPELINE = "cli-compare-pipeline": "--replicate runs variants: name their pipeline first: tailor compare paper-synth rigid_once median_once --replicate 8";
    NO_REPEAT = "cli-compare-repeat": "{file}: {why}";
    NO_RUN = "cli-compare-run": "`{run}`: the cache knows {count} {count|run|runs}";
    TWO = "cli-compare-two": "give two or more to compare: folders that `tailor measure` wrote, `last` and `last~1`, or one pipeline (its file, or the name of a built-in one) and variants of it";
}

/// Arguments of `tailor compare`.
#[derive(Args)]
pub(crate) struct CompareArgs {
    /// What is compared, the reference first: folders that `measure` or `run` wrote; `last` and
    /// `last~1` for runs of the cache; and, after a pipeline file or the name of a built-in one, what to change in it:
    /// a variant, NODE.PARAM=VALUE, several joined by `+`, or `as-is`
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
    /// Run each variant so often, replicate by replicate with the same seeds of what is by chance, and test whether they
    /// differ; folders that `sweep --out` wrote are compared so, too
    #[arg(long, value_parser = clap::value_parser!(u32).range(2..=10_000))]
    replicate: Option<u32>,
    /// With --replicate, metrics to compare, NODE.METRIC, separated by commas; else all that the pipeline's goal has
    #[arg(long, value_delimiter = ',', requires = "replicate")]
    tell: Vec<String>,
    /// Write compare.md, compare.json and compare.html into this folder
    #[arg(long)]
    out: Option<PathBuf>,
    /// Leave the photos off the page
    #[arg(long)]
    no_photos: bool,
    #[command(flatten)]
    spoken: Spoken,
}

/// Compares two or more sides and writes the page.
pub(crate) fn compare_sides(args: &CompareArgs, global: &GlobalArgs) -> Result<(), Fault> {
    args.spoken.read(compared(args, global))
}

fn compared(args: &CompareArgs, global: &GlobalArgs) -> Result<(), Fault> {
    let (pipeline, what) = sorted(&args.what, global)?;
    if let Some(out) = &args.out {
        delivery::check(out).map_err(Fault::of)?;
    }
    let replicated = match (args.replicate, pipeline) {
        (Some(times), Some(file)) => {
            let stated = (times, args.tell.as_slice(), &args.change);
            Some(of_variants(file, &what, stated, global))
        }
        (Some(_), None) => return Err(Fault::coded(&message!(NO_PIPELINE))),
        (None, _) => of_folders(&what),
    };
    if let Some(against) = replicated {
        return reported(&against?, args.out.as_deref(), global);
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
                    command::errln!("{text}:");
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
                Side::from_run(text, &outcome.json(graph), &store, &CATALOG)
                    .map_err(|why| Fault::of(why).of_stage())?
            }
        });
    }
    if let Some(why) = mixed(&sides) {
        return Err(Fault::coded(&why));
    }
    let comparison = compare(sides, args.tolerance_mm, &known);
    let pretty = || serde_json::to_string_pretty(&json(&comparison)).expect("bug: JSON");
    if let Some(folder) = &args.out {
        for (file, text) in [
            ("compare.md", markdown(&comparison, &English)),
            ("compare.json", pretty()),
            ("compare.html", page(&comparison, !args.no_photos)),
        ] {
            let file = folder.join(file);
            delivery::write(&file, &[(String::new(), text.into_bytes())]).map_err(Fault::stage)?;
        }
    }
    match global.json {
        true => command::outln!("{}", pretty()),
        false => command::out!("{}", markdown(&comparison, &args.spoken.words())),
    }
    Ok(())
}

/// Prints and writes what comparing replicates came to.
fn reported(against: &Against, out: Option<&Path>, global: &GlobalArgs) -> Result<(), Fault> {
    let pretty = serde_json::to_string_pretty(&against.json()).expect("bug: JSON");
    if let Some(folder) = out {
        for (file, text) in [
            ("compare.txt", against.text()),
            ("compare.json", pretty.clone()),
            ("compare.html", against.page()),
        ] {
            let file = folder.join(file);
            delivery::write(&file, &[(String::new(), text.into_bytes())]).map_err(Fault::stage)?;
        }
    }
    match global.json {
        true => command::outln!("{pretty}"),
        false => command::out!("{}", against.text()),
    }
    Ok(())
}

/// The pipeline among the words, and what is compared: a file anywhere, a built-in one by its name in front.
fn sorted<'a>(
    words: &'a [String],
    global: &GlobalArgs,
) -> Result<(Option<&'a String>, Vec<&'a String>), Fault> {
    let file = |word: &&String| word.ends_with(".toml");
    let built_in = |word: &&String| {
        let results = Path::new(word).join("run.json").is_file();
        global.catalog().pipeline(word).is_some() && !results && pin(word, global).is_none()
    };
    let first = words.first().filter(|word| file(word) || built_in(word));
    let pipeline = first.or_else(|| words.iter().find(file));
    let what: Vec<&String> = words
        .iter()
        .filter(|word| pipeline.is_none_or(|p| !std::ptr::eq(p, *word)))
        .collect();
    match what.len() < 2 || what.iter().any(file) {
        true => Err(Fault::coded(&message!(TWO))),
        false => Ok((pipeline, what)),
    }
}

/// The run that is pinned under a name.
fn pin(name: &str, global: &GlobalArgs) -> Option<String> {
    let pinned = std::fs::read_to_string(global.cache.join("pins").join(name));
    let pinned = pinned.ok().filter(|_| !name.contains('/'))?;
    Some(pinned.trim().to_owned())
}

/// The technical errors of a `repeat.json`; none where none is given.
pub(super) fn known_errors(file: Option<&Path>) -> Result<TechnicalErrors, Fault> {
    let Some(file) = file else {
        return Ok(TechnicalErrors::new());
    };
    let shown = file.display().to_string();
    let wrong = |why: String| Fault::coded(&message!(NO_REPEAT, file = &shown, why = why));
    let text = std::fs::read_to_string(file).map_err(|e| wrong(e.to_string()))?;
    technical_errors(&text).map_err(wrong)
}

/// A folder of results, or a run of the cache: how long ago it was, or the name of a pin.
fn found(text: &str, global: &GlobalArgs) -> Result<Side, Fault> {
    let id = match (pin(text, global), ago(text)) {
        (Some(pinned), _) => Some(pinned),
        (None, Some(ago)) => {
            let ids = crate::past::ids(&global.cache);
            let unknown = || Fault::coded(&message!(NO_RUN, run = text, count = ids.len()));
            Some(ids.get(ago).ok_or_else(unknown)?.clone())
        }
        (None, None) => None,
    };
    if let Some(id) = id {
        let store = Store::open(&global.cache).map_err(Fault::input)?;
        let gone = || Fault::coded(&message!(GONE, run = text));
        let (found, nodes) =
            crate::past::nodes_as::<NodeRun>(&global.cache, &id).ok_or_else(gone)?;
        let mut nodes: Vec<NodeRun> = nodes.collect();
        if found {
            nodes
                .iter_mut()
                .for_each(|node| node.status = "found".into());
        }
        return Side::from_nodes(text, nodes, &store, &CATALOG).map_err(Fault::of);
    }
    let folder = Path::new(text);
    if !folder.is_dir() {
        return Err(Fault::coded(&message!(NO_FOLDER, folder = text)));
    }
    let name = folder
        .file_name()
        .map_or(text.to_owned(), |n| n.to_string_lossy().into_owned());
    Side::from_folder(&name, folder).map_err(Fault::of)
}
