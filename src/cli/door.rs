//! `tailor measure`: the one-line door.

use super::provenance::{self, get};
use super::screen::screen;
use crate::delivery::{self, Delivery};
use crate::engine::Outcome;
use crate::graph::Graph;
use crate::photos::{photos, photos_node};
use crate::relative;
use crate::recipe::{Overrides, open_text};
use crate::store::Store;
use clap::Args;
use engine::cli::{Fault, GlobalArgs, check_out, execute, finish, inside, lies_in, there, whose};
use engine::out;
use shape::{Cameras, Document, Girths, Unit};
use std::path::PathBuf;

/// The product's pipeline, so that the binary works alone.
pub(super) const BODY: &str = include_str!("../../pipelines/body.toml");

/// The same with masks that somebody else made.
const OWN_MASKS: &str = include_str!("../../pipelines/own-masks.toml");

/// The folder of a capture that holds such masks.
const MASKS: &str = "masks";

/// What is written: nodes, of which the first that there is counts, file in the folder, format.
/// Without refinement the hull is the body. Formats of several files go into the folder itself.
const WRITTEN: [(&[&str], &str, &str); 9] = [
    (&["girths"], "girths.json", "json"),
    (&["girths"], "girths.csv", "csv"),
    (&["landmarks"], "landmarks.json", "json"),
    (&["cameras"], "cameras.json", "json"),
    (&["masks"], "masks", "png"),
    (&["hull"], "hull.ply", "ply"),
    (&["body", "hull"], "body.ply", "ply"),
    (&["textured", "body", "hull"], "body.glb", "glb"),
    (&["textured", "body", "hull"], "", "obj"),
];

/// Arguments of `tailor measure`.
#[derive(Args)]
pub(crate) struct Measure {
    /// The folder with the photos of one turn; masks in its folder `masks` are taken instead of own ones
    folder: PathBuf,
    /// Where to write; here, the folder's name with `-out`, if not said
    #[arg(long)]
    out: Option<PathBuf>,
    /// Remove from that folder what an earlier run wrote there and this one does not
    #[arg(long)]
    clean: bool,
    /// Keep nothing in the cache: what is made goes when the results are written
    #[arg(long)]
    pub(super) private: bool,
    /// A variant of the pipeline
    #[arg(long)]
    variant: Option<String>,
    /// Another value for a param: NODE.PARAM=VALUE
    #[arg(long)]
    set: Vec<String>,
    /// Leave the photos out of the report
    #[arg(long)]
    no_photos: bool,
    /// Make faces on the report's photos unrecognisable
    #[arg(long)]
    blur_face: bool,
}

/// Does it.
pub(crate) fn measure(measure: &Measure, global: &GlobalArgs) -> Result<(), Fault> {
    let mut sets = measure.set.clone();
    if measure.no_photos {
        sets.push("report.photos=false".into());
    }
    if measure.blur_face {
        sets.push("report.blur_face=true".into());
    }
    let overrides = Overrides {
        variant: measure.variant.clone(),
        sets,
    };
    let mut folders = vec![("photos".to_owned(), measure.folder.clone())];
    let masks = measure.folder.join(MASKS);
    let (name, text) = if masks.is_dir() {
        folders.push((MASKS.to_owned(), masks));
        ("pipelines/own-masks.toml", OWN_MASKS)
    } else {
        ("pipelines/body.toml", BODY)
    };
    let (out, shown) = place_of_results(measure)?;
    let graph =
        open_text(name, text, &overrides, &crate::catalog::CATALOG).map_err(Fault::input)?;
    check_out(&out, &graph, &folders)?;
    let again: Vec<String> = std::env::args().collect();
    // What is written must be there, the goal or not.
    let mut wanted = graph.goal.clone();
    wanted.extend(
        WRITTEN
            .iter()
            .filter_map(|(nodes, ..)| place(&graph, nodes)),
    );
    // Files are called after the photos.
    wanted.extend(photos_node(&graph));
    let store = Store::open(&global.cache).map_err(Fault::input)?;
    let again = again.join(" ");
    let outcome = execute(store, &graph, &folders, &wanted, global, &again)?;
    let own = whose(&folders[..1]);
    let mut delivery = Delivery::open(&out, &own).map_err(Fault::stage)?;
    delivery.begin().map_err(Fault::stage)?;
    write(&graph, &outcome, &mut delivery)?;
    finish(delivery, &graph, &outcome, measure.clean, global)?;
    let run = outcome.json(&graph);
    if global.json {
        engine::outln!("{}", serde_json::to_string_pretty(&run).expect("bug: JSON"));
    } else if let Some(girths) = get::<Girths>(&graph, &outcome, "girths") {
        let cameras = get::<Cameras>(&graph, &outcome, "cameras");
        let count = photos(&graph, &outcome).photos.len();
        let screen = screen(&shown, count, cameras.as_deref(), &girths);
        engine::out!("{screen}");
        engine::outln!("\nall files: {}", out.display());
        engine::outln!("report:    {}", out.join("report.html").display());
    }
    Ok(())
}

/// The folder for the results, and what the capture is called. Results of two captures never get
/// into one folder unless somebody says so.
fn place_of_results(measure: &Measure) -> Result<(PathBuf, String), Fault> {
    let capture = &measure.folder;
    let whole = capture.canonicalize().unwrap_or_else(|_| capture.clone());
    let name = whole.file_name().unwrap_or("turn".as_ref());
    let name = name.to_string_lossy().into_owned();
    let out = match &measure.out {
        Some(out) => out.clone(),
        None => {
            let mut out = PathBuf::from(format!("{name}-out"));
            // From within the capture: beside it.
            if let Some(beside) = whole.parent().filter(|_| lies_in(&out, capture)) {
                out = beside.join(out);
            }
            let own = whose(&[("photos".to_owned(), capture.clone())]);
            if delivery::is_of_another(&out, &own) {
                return Err(Fault::input(format!(
                    "{} holds something else than the results of {}: nothing was written; \
                     say where to write with --out (--out {} writes there all the same)",
                    out.display(),
                    capture.display(),
                    out.display()
                )));
            }
            out
        }
    };
    match lies_in(&out, capture) {
        true => Err(inside(&out, capture)),
        false => Ok((out, name)),
    }
}

/// The first of these nodes that there is.
fn place(graph: &Graph, nodes: &[&str]) -> Option<usize> {
    nodes.iter().find_map(|node| graph.node(node))
}

/// Writes all that the contract names.
fn write(graph: &Graph, outcome: &Outcome, delivery: &mut Delivery) -> Result<(), Fault> {
    let cameras = get::<Cameras>(graph, outcome, "cameras");
    let relative = cameras.is_some_and(|c| c.scale.unit() == Unit::Relative);
    for (nodes, file, format) in WRITTEN {
        let Some(at) = place(graph, nodes) else {
            continue;
        };
        let (artifact, raw) = there(graph, outcome, at)?;
        let photos = out::beside(graph, at).and_then(|at| outcome.artifact(graph, at));
        let files = out::files(graph.catalog, artifact, || raw, photos, Some(format));
        let mut files = files.map_err(Fault::stage)?;
        if relative {
            let told = |(name, bytes)| (name, relative::told(bytes));
            files = files.into_iter().map(told).collect();
        }
        delivery.put(file, &files).map_err(Fault::stage)?;
    }
    if let Some(report) = get::<Document>(graph, outcome, "report") {
        let page = provenance::completed(&report.bytes, outcome, graph);
        let page = vec![(String::new(), page)];
        delivery.put("report.html", &page).map_err(Fault::stage)?;
    }
    Ok(())
}
