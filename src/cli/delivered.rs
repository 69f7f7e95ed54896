//! Where `tailor measure` writes, and what.

use super::provenance::{called, completed_as, folder, get};
use crate::catalog::is_photo;
use crate::delivery::{self, Delivery};
use crate::engine::Outcome;
use crate::graph::{Graph, Source};
use command::{Fault, Ran, inside, is_within, there, whose};
use engine::out;
use shape::{Document, Girths, Mesh};
use stage::{AnyArtifact, Artifact, message};
use std::path::{Path, PathBuf};

stage::messages! {
    OF_SOMEBODY = "fail-out-of-somebody": "{file} was not written by tailor: nothing was written; give an empty folder with --out";
    OF_ANOTHER = "fail-out-of-another": "{out} holds something else than the results of {capture}: nothing was written; give another folder with --out (--out {out} writes there all the same)";
}

/// The surface that was measured, whatever its node is called.
const BODY: &str = "body";

/// What is written: nodes, of which the first that there is counts, file in the folder, format.
/// Formats of several files go into the folder itself.
const WRITTEN: [(&[&str], &str, &str); 9] = [
    (&["girths"], "girths.json", "json"),
    (&["girths"], "girths.csv", "csv"),
    (&["landmarks"], "landmarks.json", "json"),
    (&["cameras"], "cameras.json", "json"),
    (&["masks"], "masks", "png"),
    (&["hull"], "hull.ply", "ply"),
    (&[BODY], "body.ply", "ply"),
    (&["textured", BODY], "body.glb", "glb"),
    (&["textured", BODY], "", "obj"),
];

/// The folder for the results, and what the capture is called. Results of two captures never get
/// into one folder unless somebody wants it.
pub(super) fn place_of_results(
    capture: &Path,
    out: Option<&Path>,
) -> Result<(PathBuf, String), Fault> {
    let whole = capture
        .canonicalize()
        .unwrap_or_else(|_| capture.to_owned());
    let name = called(&whole);
    let out = match out {
        Some(out) => {
            if let Some(file) = of_somebody(out) {
                let file = out.join(file).display().to_string();
                return Err(Fault::coded(&message!(OF_SOMEBODY, file = file)));
            }
            out.to_owned()
        }
        None => {
            let mut out = PathBuf::from(format!("{name}-out"));
            // From within the capture: beside it.
            if let Some(beside) = whole.parent().filter(|_| is_within(&out, capture)) {
                out = beside.join(out);
            }
            let own = whose(&[("photos".to_owned(), capture.to_owned())]);
            if delivery::is_of_another(&out, &own) {
                let [out, capture] =
                    [out.as_path(), capture].map(|path| path.display().to_string());
                let why = message!(OF_ANOTHER, out = out, capture = capture);
                return Err(Fault::coded(&why));
            }
            out
        }
    };
    match is_within(&out, capture) {
        true => Err(inside(&out, capture)),
        false => Ok((out, name)),
    }
}

/// What a folder holds that no run wrote, and a run would replace or a later one take for a part of a capture: photos, what
/// is known of them, and files of the results' names. Anything else may be beside results.
fn of_somebody(out: &Path) -> Option<String> {
    if out.join("run.json").exists() {
        return None;
    }
    let entries = std::fs::read_dir(out).into_iter().flatten().flatten();
    let names = entries.filter_map(|entry| entry.file_name().into_string().ok());
    let ours = WRITTEN.map(|(_, file, _)| file);
    // An OBJ writes files of its own names.
    let more = [
        "images",
        "capture.toml",
        "report.html",
        "body.obj",
        "body.mtl",
    ];
    let mut theirs: Vec<String> = names
        .filter(|n| is_photo(n) || more.contains(&n.as_str()) || ours.contains(&n.as_str()))
        .collect();
    theirs.sort();
    theirs.into_iter().next()
}

/// The nodes whose results are written.
pub(super) fn written(graph: &Graph) -> impl Iterator<Item = usize> {
    let places = WRITTEN.iter();
    places.filter_map(|(nodes, ..)| place(graph, nodes))
}

/// The first of these nodes that there is.
fn place(graph: &Graph, nodes: &[&str]) -> Option<usize> {
    nodes.iter().find_map(|node| match *node {
        BODY => measured(graph).or_else(|| graph.node(BODY)),
        node => graph.node(node),
    })
}

/// The surface that girths are taken on: what a variant measures is what is written.
fn measured(graph: &Graph) -> Option<usize> {
    let girths = &graph.nodes[graph.node("girths")?];
    let port = girths
        .ports
        .iter()
        .position(|port| port.kind == Mesh::KIND)?;
    match girths.from[port] {
        Some(Source::Node(node)) => Some(node),
        _ => None,
    }
}

/// A result as it is written: girths with the name of the folder with the photos, as `measure` calls the capture.
pub(crate) fn present(artifact: AnyArtifact, ran: &Ran<'_>) -> AnyArtifact {
    match folder(ran) {
        Some(folder) => named(artifact, &called(folder)),
        None => artifact,
    }
}

/// Girths with the capture's name where nobody gave one: results of several captures may be put together.
fn named(artifact: AnyArtifact, name: &str) -> AnyArtifact {
    match artifact.clone().downcast::<Girths>() {
        Some(girths) if girths.capture.is_none() => AnyArtifact::new(Girths {
            capture: Some(name.to_owned()),
            ..Girths::clone(&girths)
        }),
        _ => artifact,
    }
}

/// Writes all that the contract names, of a capture called so.
pub(super) fn write(
    graph: &Graph,
    outcome: &Outcome,
    name: &str,
    delivery: &mut Delivery,
) -> Result<(), Fault> {
    for (nodes, file, format) in WRITTEN {
        let Some(at) = place(graph, nodes) else {
            continue;
        };
        let (artifact, raw) = there(graph, outcome, at)?;
        let artifact = named(artifact, name);
        let photos = graph.beside(at).and_then(|at| outcome.artifact(graph, at));
        let files = out::files(graph.catalog, artifact, || raw, photos, Some(format));
        let files = files.map_err(Fault::stage)?;
        delivery.put(file, &files).map_err(Fault::stage)?;
    }
    if let Some(report) = get::<Document>(graph, outcome, "report") {
        let page = completed_as(&report.bytes, &Ran::of(graph, outcome, &[]), Some(name));
        let page = vec![(String::new(), page)];
        delivery.put("report.html", &page).map_err(Fault::stage)?;
    }
    Ok(())
}
