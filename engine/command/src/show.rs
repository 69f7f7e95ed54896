//! `show`: one artifact out of the cache as a file.

use super::arguments::Change;
use super::fault::Fault;
use super::open::{folders, node, open_pipeline};
use super::program::GlobalArgs;
use super::ran::Ran;
use super::show_runs::{asked, entry, fits, otherwise, reads};
use super::speech::answer_bytes;
use clap::Args;
use engine::graph::Graph;
use engine::store::{Blob, Store};
use engine::{delivery, out, past};
use serde_json::{Value, json};
use stage::{AnyArtifact, Hash};
use std::io::IsTerminal;
use std::path::{Path, PathBuf};

/// Arguments of `show`.
#[derive(Args)]
pub(crate) struct Show {
    /// The node
    node: String,
    /// The pipeline file that it belongs to, or the name of a built-in one, if it is not the program's own
    #[arg(long)]
    pipeline: Option<PathBuf>,
    #[command(flatten)]
    change: Change,
    /// The format; by default the kind's usual one
    #[arg(long = "as")]
    format: Option<String>,
    /// The file, or the folder where there are several; `-` is standard output, for a single file. Without it texts go to
    /// standard output, the rest into a file or a folder here that is called like the node
    #[arg(short)]
    o: Option<PathBuf>,
}

/// A picture under another picture's ending would be opened by nobody.
fn ending_fits(path: &Path, files: &[(String, Vec<u8>)]) -> Result<(), Fault> {
    let printed = path.extension().unwrap_or_default().to_string_lossy();
    let printed = printed.to_lowercase();
    let [(_, bytes)] = files else { return Ok(()) };
    let is = match bytes.as_slice() {
        [0xff, 0xd8, 0xff, ..] => ["jpg", "jpeg"],
        [0x89, b'P', b'N', b'G', ..] => ["png", "png"],
        _ => return Ok(()),
    };
    let picture = ["jpg", "jpeg", "png"].contains(&printed.as_str());
    match picture && !is.contains(&printed.as_str()) {
        true => Err(Fault::input(format!(
            "{}: this picture is written as .{}; give the file that ending",
            path.display(),
            is[0]
        ))),
        false => Ok(()),
    }
}

/// Where what is shown goes.
enum Place {
    Output,
    File(PathBuf),
}

/// Whether a file is a text that somebody reads as it is; a page is opened.
fn is_text(files: &[(String, Vec<u8>)]) -> bool {
    match files {
        [(name, bytes)] if name.is_empty() => {
            let page = |text: &str| {
                text.trim_start()
                    .to_lowercase()
                    .starts_with("<!doctype html")
            };
            std::str::from_utf8(bytes).is_ok_and(|text| !text.contains('\0') && !page(text))
        }
        _ => false,
    }
}

/// Where what is shown goes if nothing else is asked for: texts to standard output, the rest into a file or a folder
/// of the node's name here, which is never written over.
fn usual(
    node: &str,
    format: &str,
    files: &[(String, Vec<u8>)],
    json: bool,
) -> Result<Place, Fault> {
    if is_text(files) && !json {
        return Ok(Place::Output);
    }
    let (path, there) = match files {
        [(name, bytes)] if name.is_empty() => {
            let ending = match bytes.as_slice() {
                [0xff, 0xd8, 0xff, ..] => "jpg",
                [0x89, b'P', b'N', b'G', ..] => "png",
                _ => format,
            };
            let path = PathBuf::from(format!("{node}.{ending}"));
            let there = path.exists() && std::fs::read(&path).ok().as_ref() != Some(bytes);
            (path, there)
        }
        _ => (PathBuf::from(node), Path::new(node).exists()),
    };
    match there {
        true => Err(Fault::input(format!(
            "{} is there already; name another file with -o",
            path.display()
        ))),
        false => Ok(Place::File(path)),
    }
}

/// Writes a single file to standard output.
fn to_output(files: &[(String, Vec<u8>)], json: bool) -> Result<(), Fault> {
    match files {
        _ if json => Err(Fault::input(
            "--json would be mixed with the file: give a file with -o",
        )),
        [(name, bytes)] if name.is_empty() => {
            if !is_text(files) && std::io::stdout().is_terminal() {
                let why = "this file is no text for a terminal: give a file with -o";
                return Err(Fault::input(why));
            }
            answer_bytes(bytes);
            Ok(())
        }
        _ => Err(Fault::input(
            "these are several files: give a folder with -o, or another format with --as",
        )),
    }
}

/// The record of a run, and the artifact and bytes of a node's result in it, if it is still there.
fn result(store: &Store, graph: &Graph, run: &Value, name: &str) -> Option<(AnyArtifact, Blob)> {
    let stage = graph.nodes[graph.node(name)?].stage;
    let node = entry(run, name).filter(|n| n["stage"] == stage.name())?;
    let blob = store.blob(Hash::from_hex(node["content"].as_str()?).ok()?)?;
    Some((stage.read(&blob).ok()?, blob))
}

/// `show`: the newest run of a node of that name whose result is still there.
pub(crate) fn show(show: &Show, global: &GlobalArgs) -> Result<(), Fault> {
    let graph = open_pipeline(show.pipeline.as_deref(), &show.change, global)?;
    let wanted = node(&graph, &show.node)?;
    let store = Store::open(&global.cache).map_err(Fault::input)?;
    let printed = folders(&show.change)?;
    let files = engine::given_inputs(&graph, &printed, &store).map_err(Fault::input)?;
    let contents: Vec<Option<Hash>> = files
        .iter()
        .map(|f| f.as_ref().map(stage::content))
        .collect();
    let changed = show.change.changes();
    let asked = asked(show.pipeline.as_deref(), &show.change, &graph, global)?;
    let newest = |name: &str| {
        let at = graph.node(name)?;
        // One after the other: a store may hold many large ones.
        let mut fitting = engine::runs(store.root())
            .filter(|(_, run)| fits(run, &graph, at, &asked))
            .filter(|(_, run)| reads(run, &graph, at, &contents));
        fitting.find_map(|(id, run)| {
            let result = result(&store, &graph, &run, name)?;
            Some((id, run, result))
        })
    };
    let name = &graph.nodes[wanted].name;
    let (id, run, (artifact, blob)) = newest(name).ok_or_else(|| {
        let of = if printed.is_empty() {
            ""
        } else {
            " of this input"
        };
        let so = if changed { " with these changes" } else { "" };
        Fault::input(format!(
            "the cache holds no result of `{name}`{of}{so}; run the pipeline first"
        ))
    })?;
    if let Some(what) = otherwise(&run, &graph, wanted, show.pipeline.as_deref()) {
        crate::errln!(
            "{name} is of an earlier run, in which {what}; run the pipeline for a new one"
        );
    }
    // Of the same run if it is there.
    let beside = graph.beside(wanted).and_then(|at| {
        let name = &graph.nodes[at].name;
        let same = result(&store, &graph, &run, name);
        Some(same.or_else(|| Some(newest(name)?.2))?.0)
    });
    let folders = past::head(store.root(), &id).unwrap_or_default().of.inputs;
    let folders = folders.into_iter().map(|(name, f)| (name, f.into()));
    let read = |name: &str| Some(result(&store, &graph, &run, name)?.0);
    let ran = Ran::recorded(&graph, folders.collect(), run.clone(), Box::new(read));
    let usual_ending = out::extension(graph.catalog, &artifact);
    let artifact = (global.program().present)(artifact, &ran);
    let (raw, format) = (|| blob.to_vec(), show.format.as_deref());
    let files = out::files(graph.catalog, artifact, raw, beside, format);
    let mut files = files.map_err(Fault::input)?;
    let ending = format.filter(|f| *f != "file").unwrap_or(usual_ending);
    if ending == "html" {
        for (_, page) in &mut files {
            *page = (global.program().complete)(page, &ran);
        }
    }
    written(show, name, ending, &files, global)
}

/// Writes the files where they are wanted, and reports where that is.
fn written(
    show: &Show,
    name: &str,
    ending: &str,
    files: &[(String, Vec<u8>)],
    global: &GlobalArgs,
) -> Result<(), Fault> {
    let place = match &show.o {
        Some(o) if o.as_os_str() == "-" => Place::Output,
        Some(o) => Place::File(o.clone()),
        None => usual(name, ending, files, global.json)?,
    };
    let place = match place {
        Place::Output => return to_output(files, global.json),
        Place::File(place) => place,
    };
    ending_fits(&place, files)?;
    delivery::write(&place, files).map_err(Fault::stage)?;
    if show.o.is_none() && !global.json && !global.quiet {
        crate::outln!("{}", place.display());
    }
    if global.json {
        let one = |(name, bytes): &(String, Vec<u8>)| {
            let path = match name.is_empty() {
                true => place.clone(),
                false => place.join(name),
            };
            json!({ "file": path, "bytes": bytes.len() })
        };
        let files: Value = files.iter().map(one).collect();
        crate::outln!("{}", json!({ "node": name, "files": files }));
    }
    Ok(())
}
