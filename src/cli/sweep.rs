//! `tailor sweep`: every point of a sweep, one table.

use super::run::{folders, node, options};
use super::{CANCEL, Change, Fault, House};
use crate::graph::Graph;
use crate::lasttime::History;
use crate::past::Of;
use crate::recipe::{self, Mistakes, Overrides, Recipe, Sweep};
use crate::sweep::{self, Axis, End, Point, Points, Row, Sweeping, axes};
use crate::walk::Watch;
use crate::{delivery, sweep::outlook};
use clap::Args;
use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;

/// More points than this ask for `--yes`.
const MANY: u128 = 1000;

/// Arguments of `tailor sweep`.
#[derive(Args)]
pub(crate) struct SweepArgs {
    /// The pipeline file
    pipeline: PathBuf,
    /// A sweep that it declares; none if `--sweep` says all
    name: Option<String>,
    #[command(flatten)]
    change: Change,
    /// A param and its values: NODE.PARAM=2,3,4 or NODE.PARAM=2..8/4 (4 values), or 1..100/3log
    #[arg(long = "sweep")]
    over: Vec<String>,
    /// A number to be told: NODE.METRIC
    #[arg(long)]
    tell: Vec<String>,
    /// Nodes that are wanted instead of the goal of the sweep or the pipeline, separated by commas
    #[arg(long, value_delimiter = ',')]
    nodes: Vec<String>,
    /// Ground truth: errors are told beside
    #[arg(long)]
    truth: Option<PathBuf>,
    /// Write sweep.csv, sweep.json and sweep.html into this folder
    #[arg(long)]
    out: Option<PathBuf>,
    /// Run even if there are more than a thousand points
    #[arg(long)]
    yes: bool,
}

/// What varies and what is asked, from the file and the command line.
struct Asked {
    points: Points,
    name: String,
    about: String,
    tell: Vec<String>,
    /// The nodes that are wanted; none is the pipeline's goal.
    nodes: Vec<String>,
}

/// Does it.
pub(crate) fn sweep(args: &SweepArgs, house: &House) -> Result<(), Fault> {
    let file = args.pipeline.display().to_string();
    if let Some(out) = &args.out {
        delivery::check(out).map_err(Fault::input)?;
    }
    let all = Overrides {
        variant: args.change.variant.clone(),
        sets: args.change.set.clone(),
    };
    let base = recipe::open(&args.pipeline, &all).map_err(Fault::mistakes)?;
    let text = std::fs::read_to_string(&args.pipeline).map_err(Fault::input)?;
    let recipe =
        recipe::read(&text).map_err(|m| Fault::mistakes(Mistakes::new(&file, &text, m)))?;
    let asked = asked(args, &recipe, &base)?;
    let at = |point: &Point| {
        let overrides = point.overrides(&all);
        recipe::open_text(&file, &text, &overrides, &crate::catalog::find)
    };
    checked(args, &base, &asked, &at)?;
    let wanted: Vec<usize> = match asked.nodes.is_empty() {
        true => base.goal.clone(),
        false => asked.nodes.iter().filter_map(|n| base.node(n)).collect(),
    };
    let history = History::of(&house.cache, Of::default());
    let last = |node: &str| history.last(node).map(|n| n.seconds);
    let outlook = outlook(&asked.points, &base, &wanted, &last);
    if asked.points.count() > MANY && !args.yes {
        return Err(Fault::input(format!(
            "this sweep has {outlook}; if you mean it, say --yes"
        )));
    }
    let voice = Voice(!house.quiet && !house.json);
    voice.say(&outlook.to_string());
    let options = options(house, true);
    let sweeping = Sweeping {
        open: &|point| at(point).map_err(|m| m.to_string()),
        nodes: &asked.nodes,
        folders: &folders(&args.change)?,
        options: &options,
        tell: &asked.tell,
        truth: args.truth.as_deref(),
        watch: &voice,
        cancel: &CANCEL,
    };
    let (count, mut so_far) = (asked.points.count(), 0);
    let done = |row: &Row| {
        so_far += 1;
        let end = match &row.end {
            End::Done => format!("{} made in {:.1} s", row.made, row.seconds),
            End::Failed(node, _) => format!("{node} FAILED"),
            End::Wrong(_) => "WRONG".into(),
            End::Stopped => "stopped".into(),
        };
        voice.say(&format!(
            "[{so_far:>3}/{count}] {}  {end}",
            row.point.name(&asked.name)
        ));
    };
    let rows = sweep::run(&sweeping, asked.points.iter(), done).map_err(Fault::input)?;
    finish(args, house, &asked, &rows)
}

/// The sweep by its name, with what the command line adds.
fn asked(args: &SweepArgs, recipe: &Recipe, base: &Graph) -> Result<Asked, Fault> {
    let known: Vec<&str> = recipe
        .sweeps
        .iter()
        .map(|s| s.name.value.as_str())
        .collect();
    let declared: Option<&Sweep> = match &args.name {
        None if args.over.is_empty() => {
            let what = match known.is_empty() {
                true => "this pipeline declares none".to_owned(),
                false => format!("known: {}", known.join(", ")),
            };
            return Err(Fault::input(format!(
                "name a sweep ({what}) or say --sweep NODE.PARAM=VALUES"
            )));
        }
        None => None,
        Some(name) => {
            let found = recipe.sweeps.iter().find(|s| s.name.value == *name);
            Some(found.ok_or_else(|| Fault::input(stage::unknown("sweep", name, &known)))?)
        }
    };
    let folder = args.pipeline.parent().unwrap_or(Path::new("."));
    let mut all: Vec<Axis> = match declared {
        Some(sweep) => axes::axes(sweep, folder).map_err(Fault::input)?,
        None => vec![],
    };
    for text in &args.over {
        all.push(axes::said(text).map_err(Fault::input)?);
    }
    let variants = match declared.map(|s| &s.with) {
        Some(with) if !with.is_empty() => with.iter().map(|v| Some(v.value.clone())).collect(),
        _ => vec![None],
    };
    let mut tell: Vec<String> =
        declared.map_or(vec![], |s| s.tell.iter().map(|t| t.value.clone()).collect());
    tell.extend(args.tell.iter().cloned());
    Ok(Asked {
        points: Points::new(base, variants, all),
        name: args.name.clone().unwrap_or_else(|| "sweep".into()),
        about: declared.map_or(String::new(), |s| s.about.clone()),
        tell,
        nodes: match (args.nodes.is_empty(), declared) {
            (true, Some(sweep)) => sweep.goal.iter().map(|g| g.value.clone()).collect(),
            _ => args.nodes.clone(),
        },
    })
}

/// Says what is wrong before anything runs: names, and the values of every axis.
fn checked(
    args: &SweepArgs,
    base: &Graph,
    asked: &Asked,
    at: &dyn Fn(&Point) -> Result<Graph, Mistakes>,
) -> Result<(), Fault> {
    for name in &asked.nodes {
        node(base, name)?;
    }
    for tell in &asked.tell {
        let (of, _) = tell.split_once('.').unwrap_or((tell, ""));
        if of == "error" && args.truth.is_none() {
            let what = "is told against ground truth: say --truth FOLDER";
            return Err(Fault::input(format!("`{tell}` {what}")));
        }
        if of != "error" && asked.points.variants == [None] {
            node(base, of)?;
        }
    }
    tellable(args, asked, at)?;
    // Each row of each axis alone: a param or a value that cannot be is told before anything runs.
    let mut told = Vec::new();
    for axis in &asked.points.axes {
        for row in axis.rows.iter().take(10_000) {
            let pairs = axis.params.iter().zip(row);
            let point = Point {
                variant: asked.points.variants[0].clone(),
                values: pairs
                    .map(|((n, p), v)| (n.clone(), p.clone(), v.clone()))
                    .collect(),
            };
            if let Err(mistakes) = at(&point) {
                let text = mistakes.to_string().replace("--set", "--sweep");
                if !told.contains(&text) {
                    told.push(text);
                }
            }
        }
    }
    match told.is_empty() {
        true => Ok(()),
        false => Err(Fault::input(told.join("\n"))),
    }
}

/// Whether what `--tell` asks for can be told at all; what the file asks for was looked at with it.
fn tellable(
    args: &SweepArgs,
    asked: &Asked,
    at: &dyn Fn(&Point) -> Result<Graph, Mistakes>,
) -> Result<(), Fault> {
    let point = |variant: &Option<String>| Point {
        variant: variant.clone(),
        values: vec![],
    };
    let graphs = asked.points.variants.iter().map(|v| at(&point(v)));
    let graphs: Vec<Graph> = graphs.collect::<Result<_, _>>().map_err(Fault::mistakes)?;
    for tell in &args.tell {
        let (node, metric) = tell.split_once('.').unwrap_or((tell, ""));
        let what = graphs.iter().map(|graph| {
            let bound = &graph.nodes[graph.node(node)?];
            let params = graph.nodes.iter().flat_map(|n| &n.params.values);
            let declared = sweep::entries(params.map(|(_, value)| value));
            sweep::untellable(node, bound.stage, metric, &declared)
        });
        // It is enough that one variant tells it, or leaves the node out.
        if let Some(what) = what.collect::<Option<Vec<String>>>() {
            return Err(Fault::input(format!("`--tell {tell}`: {}", what[0])));
        }
    }
    Ok(())
}

/// Prints and writes what came out; a point without a result is a failure, a stop is a stop.
fn finish(args: &SweepArgs, house: &House, asked: &Asked, rows: &[Row]) -> Result<(), Fault> {
    let (name, about) = (&asked.name, &asked.about);
    let json = sweep::json(name, about, rows);
    if let Some(folder) = &args.out {
        let pretty = serde_json::to_string_pretty(&json).expect("bug: JSON");
        for (file, text) in [
            ("sweep.csv", sweep::csv(rows)),
            ("sweep.json", pretty),
            ("sweep.html", sweep::page(name, about, rows)),
        ] {
            let file = folder.join(file);
            delivery::write(&file, &[(String::new(), text.into_bytes())]).map_err(Fault::stage)?;
        }
    }
    match house.json {
        true => super::outln!(
            "{}",
            serde_json::to_string_pretty(&json).expect("bug: JSON")
        ),
        false => super::out!("{}", sweep::text(about, rows)),
    }
    untold(asked, rows)
        .iter()
        .for_each(|line| super::errln!("{line}"));
    if CANCEL.load(Ordering::Relaxed) {
        let text = "stopped; run the same command to go on".into();
        return Err(Fault {
            text,
            ..Fault::stopped()
        });
    }
    match rows.iter().filter(|r| r.end != End::Done).count() {
        0 => Ok(()),
        // The table has said which and why.
        _ => Err(Fault::stage("")),
    }
}

/// What was asked for and no point tells.
fn untold(asked: &Asked, rows: &[Row]) -> Vec<String> {
    let mut lines = Vec::new();
    let done: Vec<&Row> = rows.iter().filter(|r| r.end == End::Done).collect();
    for name in asked.tell.iter().filter(|_| !done.is_empty()) {
        let told = |row: &&Row| row.told.iter().any(|(n, m)| n == name && m.is_some());
        if !done.iter().any(told) {
            let known: Vec<&str> = done[0].known.iter().map(String::as_str).collect();
            lines.push(format!(
                "no point tells `{name}`; there are {}",
                known.join(", ")
            ));
        }
    }
    lines
}

/// A line a point on standard error.
struct Voice(bool);

impl Voice {
    fn say(&self, line: &str) {
        if self.0 {
            super::errln!("{line}");
        }
    }
}

impl Watch for Voice {}
