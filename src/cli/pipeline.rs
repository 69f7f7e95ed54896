//! The pipeline of a capture, by what is asked for and known of it; and that of its first answer.

use super::folder::{self, Looked, MASKS};
use super::measure_args::Measure;
use super::source::Source;
use super::stated::{Stated, opened};
use crate::graph::Graph;
use command::Fault;
use stage::message;
use std::path::PathBuf;

stage::messages! {
    OF_PHOTOS = "cli-of-photos": "{flag}: of photos; a scan takes --unit-of-file and --up";
}

/// The variant of pipelines that stops at the coarse surface.
const FAST: &str = "fast";

/// The variant that measures the hull of reduced photos.
const FIRST: &str = "first";

/// The pipeline for a capture with what is given of it, and its inputs: the whole, or a first answer that
/// is `followed` by the whole, or that the whole left `unfinished`.
pub(super) fn pipeline(
    measure: &Measure,
    source: &Source,
    stated: &[Stated],
    first: Option<&str>,
) -> Result<(Graph, Vec<(String, PathBuf)>), Fault> {
    if let Source::Scan(..) = source {
        if let Some(fact) = stated.first() {
            return Err(Fault::coded(&message!(OF_PHOTOS, flag = &fact.flag)));
        }
        let sets: Vec<String> = measure
            .scan()
            .into_iter()
            .chain(measure.inches().then(|| "report.unit=in".to_owned()))
            .chain(measure.set.iter().cloned())
            .collect();
        let graph = opened("surface", None, measure.variant.clone(), stated, &sets)?;
        return Ok((graph, source.inputs()));
    }
    let mut sets = Vec::new();
    // A turn of a disk is looked at while it is read; a walk is none, nor is a turn on the spot.
    let on_disk = !measure.walk && !measure.turning;
    // A first answer leaves that to the whole.
    sets.extend(
        first
            .is_none_or(|_| measure.walk)
            .then(|| format!("photos.stop={on_disk}")),
    );
    for (asked, set) in [
        (measure.no_photos, "report.photos=false"),
        (measure.blur_face, "report.blur_face=true"),
        (measure.inches(), "report.unit=in"),
    ] {
        sets.extend(asked.then(|| set.to_owned()));
    }
    // What the user sets himself comes last, and wins.
    sets.extend(measure.set.iter().cloned());
    let mut folders = source.inputs();
    let masks = source.folder().join(MASKS);
    let name = match (measure.walk, masks.is_dir()) {
        (_, true) if measure.turning => "turning-own-masks",
        (_, false) if measure.turning => "turning",
        (true, true) => "walk-own-masks",
        (true, false) => "walk",
        (false, true) => "own-masks",
        (false, false) => "body",
    };
    if masks.is_dir() {
        folders.push((MASKS.to_owned(), masks));
    }
    sets.extend(first.map(|answer| format!("report.answer={answer}")));
    let variant = match first {
        // Cameras of a walk need its photos as they are.
        Some(_) if measure.walk => Some(FAST.to_owned()),
        Some(_) => Some(FIRST.to_owned()),
        None if measure.fast => Some(FAST.to_owned()),
        None => measure.variant.clone(),
    };
    let graph = opened(name, source.over(), variant, stated, &sets)?;
    Ok((graph, folders))
}

/// The pipeline of a first answer: with the page that the whole follows, and with the one where it failed to.
pub(super) fn first_graphs(
    measure: &Measure,
    looked: &Looked,
    stated: &[Stated],
) -> Option<[Graph; 2]> {
    let more: Vec<Stated> = stated.iter().chain(&looked.more).cloned().collect();
    let graph = |answer| {
        let (mut graph, _) = pipeline(measure, &looked.source, &more, Some(answer)).ok()?;
        folder::widen(&mut graph, looked);
        // With a plate, and a disk that shows where shadows may be, nobody need be found to know where the trunk is.
        let beside: &[&str] = match looked.plate_there && looked.disk && !measure.walk {
            true => &["textured", "people", "lost_parts"],
            false => &["textured"],
        };
        unplug(&mut graph, beside);
        Some(graph)
    };
    Some([graph("followed")?, graph("unfinished")?])
}

/// Ports of these names are left open in all that a first answer takes: what they would bring takes longer than the rest.
/// Colours of its page are painted on the surface.
fn unplug(graph: &mut Graph, names: &[&str]) {
    let reads = |node: &str| ["scene", "evidence", "masks", "girths", "report"].contains(&node);
    for node in graph.nodes.iter_mut().filter(|node| reads(&node.name)) {
        for (port, from) in node.ports.iter().zip(&mut node.from) {
            if names.contains(&port.name) {
                *from = None;
            }
        }
    }
}
