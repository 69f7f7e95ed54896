//! `plan --strands`, `sweep --strands`, and `work`: the protocol behind every cluster.

use super::arguments::Wanted;
use super::fault::Fault;
use super::open::{folders, node, options};
use super::program::GlobalArgs;
use super::programs::permitted;
use super::speech::CANCEL;
use super::text::count;
use clap::Args;
use engine::lasttime::History;
use engine::past::Of;
use engine::recipe::{Overrides, Pipeline};
use engine::store::Store;
use engine::strands::{self, Asked, Folders, Plan, Worked};
use engine::walk::{Status, Watch};
use serde_json::{Value, json};
use stage::Hash;
use std::path::Path;
use std::sync::Mutex;
use std::sync::atomic::Ordering;
use system::pattern::natural;

/// Arguments of `work`.
#[derive(Args)]
pub(crate) struct Work {
    /// The plan that `--strands` named, or its first digits
    #[arg(long)]
    plan: String,
    /// Strands by their numbers: 3, or 0-63, or 1,5,8-9
    #[arg(long)]
    strand: String,
}

/// `plan --strands`: the plan of a run, or of one of each folder.
pub(crate) fn plan(wanted: &Wanted, each: &[String], global: &GlobalArgs) -> Result<(), Fault> {
    let pipeline = Pipeline::read(&wanted.pipeline, global.catalog()).map_err(Fault::mistakes)?;
    let point = Overrides {
        variant: wanted.change.variant.clone(),
        sets: wanted.change.set.clone(),
    };
    let graph = pipeline.graph(&point).map_err(Fault::mistakes)?;
    permitted(&graph, global)?;
    for name in &wanted.nodes {
        node(&graph, name)?;
    }
    let mut points = vec![(point, folders(&wanted.change)?)];
    for text in each {
        points = crossed(&points, text)?;
    }
    let asked = Asked {
        pipeline: &pipeline,
        points: &points,
        nodes: &wanted.nodes,
    };
    written(&asked, global)
}

/// Every point with every folder within the one of `NAME=FOLDER`, in natural order.
fn crossed(
    points: &[(Overrides, Folders)],
    text: &str,
) -> Result<Vec<(Overrides, Folders)>, Fault> {
    let wrong = |why: &str| Fault::input(format!("`--each {text}`: {why}"));
    let (name, folder) = text
        .split_once('=')
        .ok_or_else(|| wrong("give NAME=FOLDER"))?;
    let entries = std::fs::read_dir(folder).map_err(|e| wrong(&e.to_string()))?;
    let shown = |e: std::fs::DirEntry| {
        let name = e.file_name().into_string().ok()?;
        (e.path().is_dir() && !name.starts_with('.')).then_some(name)
    };
    let mut names: Vec<String> = entries.flatten().filter_map(shown).collect();
    names.sort_by_key(|name| natural(name));
    if names.is_empty() {
        return Err(wrong("no folder is in it"));
    }
    let mut crossed = Vec::with_capacity(names.len() * points.len());
    for inner in names {
        for (point, folders) in points {
            let mut folders = folders.clone();
            folders.retain(|(known, _)| known != name);
            folders.push((name.to_owned(), Path::new(folder).join(&inner)));
            crossed.push((point.clone(), folders));
        }
    }
    Ok(crossed)
}

/// Makes a plan, writes it into the store, prints its name.
pub(super) fn written(asked: &Asked<'_>, global: &GlobalArgs) -> Result<(), Fault> {
    let store = Store::open(&global.cache).map_err(Fault::input)?;
    let plan = strands::planned(asked, global.catalog().program, &store).map_err(Fault::input)?;
    named(&plan, None, &store, global)
}

/// Writes a plan into the store and answers with its layers and name; a search's with its round, too.
pub(super) fn named(
    plan: &Plan,
    round: Option<usize>,
    store: &Store,
    global: &GlobalArgs,
) -> Result<(), Fault> {
    let name = plan.write(store).map_err(Fault::input)?;
    let history = History::of(&global.cache, Of::default());
    let seconds = |node: &str| history.last(node).map(|line| line.seconds);
    let mut layers = Vec::new();
    for layer in 0..plan.layers() {
        let strands = &plan.strands[plan.layer(layer)];
        let nodes = || strands.iter().flat_map(|s| &s.nodes);
        // A sum of nothing is -0.
        let known = nodes().filter_map(|n| seconds(n)).fold(0.0, |a, b| a + b);
        let unknown = nodes().filter(|n| seconds(n).is_none()).count();
        layers.push((strands.len(), nodes().count(), known, unknown));
    }
    if global.json {
        let layer = |(strands, nodes, seconds, unknown): &(usize, usize, f64, usize)| json!({ "strands": strands, "nodes": nodes, "seconds": seconds, "without_history": unknown });
        let layers: Vec<Value> = layers.iter().map(layer).collect();
        let points = plan.points.len();
        let strands = plan.strands.len();
        let mut answer =
            json!({ "plan": name, "points": points, "strands": strands, "layers": layers });
        if let Some(round) = round {
            answer["round"] = round.into();
        }
        crate::outln!("{answer}");
        return Ok(());
    }
    if let Some(round) = round {
        crate::outln!("round {round} is to be worked on; then the same command again");
    }
    for (at, (strands, nodes, seconds, unknown)) in layers.iter().enumerate() {
        let unknown = match unknown {
            0 => String::new(),
            n => format!(", {n} of them not known"),
        };
        let (strands, nodes) = (count(*strands, "strand"), count(*nodes, "node"));
        crate::outln!("layer {at}: {strands}, {nodes}, {seconds:.1} s{unknown}");
    }
    crate::outln!("plan: {name}");
    Ok(())
}

/// Places that a text like `1,5,8-9` names.
fn places(text: &str) -> Result<Vec<usize>, Fault> {
    let wrong = || Fault::input(format!("`--strand {text}`: give 3, or 0-63, or 1,5,8-9"));
    let mut places = Vec::new();
    for part in text.split(',') {
        let (from, to) = part.split_once('-').unwrap_or((part, part));
        let number = |text: &str| text.trim().parse::<usize>().map_err(|_| wrong());
        let (from, to) = (number(from)?, number(to)?);
        if from > to || to - from > MOST_PLACES {
            return Err(wrong());
        }
        places.extend(from..=to);
    }
    Ok(places)
}

/// So many digits of a plan's name are enough.
pub(super) const SHORTEST: usize = strands::SHORTEST;

/// A range of strands is no longer.
const MOST_PLACES: usize = 1_000_000;

/// Notes what is not deterministic.
struct Ear<'a> {
    quiet: bool,
    differ: &'a Mutex<Vec<Value>>,
}

impl Watch for Ear<'_> {
    fn differs(&self, node: &str, theirs: Hash, ours: Hash) {
        let (theirs, ours) = (theirs.to_hex().to_string(), ours.to_hex().to_string());
        let line = json!({ "node": node, "theirs": theirs, "ours": ours });
        self.differ.lock().expect("bug: poisoned").push(line);
        crate::errln!(
            "{node}: not deterministic: it was made elsewhere at the same time as {}, here as {}; the first counts",
            &theirs[..12],
            &ours[..12]
        );
    }
    fn waits(&self, node: &str) {
        if !self.quiet {
            crate::errln!("{node}: another process makes it; waiting for that");
        }
    }
}

/// `work`: strands of a plan, one after the other; one that fails does not stop the rest.
pub(crate) fn work(work: &Work, global: &GlobalArgs) -> Result<(), Fault> {
    let places = places(&work.strand)?;
    let store = Store::open(&global.cache).map_err(Fault::input)?;
    let (_, plan) = Plan::read(&store, &work.plan).map_err(Fault::plan)?;
    let pipeline = strands::pipeline(&plan, global.catalog()).map_err(Fault::input)?;
    let options = options(global, true);
    let differ = Mutex::new(Vec::new());
    let quiet = global.quiet || global.json;
    let ear = Ear {
        quiet,
        differ: &differ,
    };
    let (mut answers, mut failed) = (Vec::new(), Vec::new());
    for strand in places {
        if CANCEL.load(Ordering::Relaxed) {
            return Err(Fault::stopped());
        }
        let may = strands::graph(&plan, strand, &pipeline)
            .map_err(Fault::input)
            .and_then(|graph| permitted(&graph, global));
        let worked = may.and_then(|()| {
            strands::work(&plan, strand, &pipeline, &options, &ear, &CANCEL).map_err(Fault::input)
        });
        let answer = match worked {
            Ok(worked) => answer(strand, &worked),
            Err(why) => json!({ "strand": strand, "why": why.text() }),
        };
        if let Some(why) = answer["why"].as_str() {
            failed.push(strand.to_string());
            if !global.json {
                crate::errln!("strand {strand}: {why}");
            }
        } else if !quiet {
            crate::errln!(
                "strand {strand}: {} made, {} found, {:.1} s",
                answer["made"],
                answer["found"],
                answer["seconds"].as_f64().unwrap_or(0.0)
            );
        }
        answers.push(answer);
    }
    if global.json {
        let differ = differ.into_inner().expect("bug: poisoned");
        crate::outln!("{}", json!({ "strands": answers, "differ": differ }));
    }
    if CANCEL.load(Ordering::Relaxed) {
        return Err(Fault::stopped());
    }
    match failed.is_empty() {
        true => Ok(()),
        false if global.json => Err(Fault::stage("")),
        false => Err(Fault::stage(format!(
            "{} of {} strands came to nothing: {}",
            failed.len(),
            answers.len(),
            failed.join(", ")
        ))),
    }
}

/// What came of a strand.
fn answer(strand: usize, worked: &Worked) -> Value {
    let of = |status: &Status| {
        let nodes = worked.nodes.iter().flat_map(|i| &worked.outcome.nodes[*i]);
        nodes.filter(|done| done.status == *status).count()
    };
    let mut answer = json!({
        "strand": strand, "made": of(&Status::Executed), "found": of(&Status::Hit),
        "seconds": worked.outcome.seconds,
    });
    if let Some((node, why)) = worked.outcome.failure(&worked.graph) {
        answer["node"] = node.into();
        answer["why"] = format!("{node} failed: {why}").into();
    }
    answer
}
