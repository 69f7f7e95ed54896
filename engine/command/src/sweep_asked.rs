//! What a sweep is asked for, by its file and the command line, and whether it can be.

use super::arguments::Change;
use super::fault::Fault;
use super::open::node;
use clap::{Args, FromArgMatches};
use engine::graph::Graph;
use engine::recipe::{Mistakes, Pipeline, Sweep};
use engine::sweep::{self, Axis, Point, Points, Replicates, axes};
use std::path::PathBuf;

/// Arguments of `sweep`.
#[derive(Args)]
pub struct SweepArgs {
    /// The pipeline file, or the name of a built-in one
    pub(super) pipeline: PathBuf,
    /// A sweep that it declares; none if `--sweep` gives all
    pub(super) name: Option<String>,
    #[command(flatten)]
    pub(super) change: Change,
    /// A param and its values: NODE.PARAM=2,3,4 or NODE.PARAM=2..8/4 (4 values), or 1..100/3log
    #[arg(long = "sweep", visible_alias = "over")]
    pub(super) over: Vec<String>,
    /// Metrics to report, NODE.METRIC, separated by commas
    #[arg(long, value_delimiter = ',')]
    pub(super) tell: Vec<String>,
    /// Nodes that are wanted instead of the goal of the sweep or the pipeline, separated by commas
    #[arg(long, value_delimiter = ',')]
    pub(super) nodes: Vec<String>,
    /// Ground truth: errors are reported beside
    #[arg(long)]
    pub(super) truth: Option<PathBuf>,
    /// Write sweep.csv, sweep.json and sweep.html into this folder
    #[arg(long)]
    pub(super) out: Option<PathBuf>,
    /// Results to write beside the page and to link from each point: NODE, or NODE:FORMAT, separated by commas
    #[arg(long, value_delimiter = ',', requires = "out")]
    pub(super) show: Vec<String>,
    /// Remove from that folder what an earlier run wrote there and this one does not
    #[arg(long, requires = "out")]
    pub(super) clean: bool,
    /// Cut it into strands for a cluster instead of running it; the plan goes into the cache, and its name is printed
    #[arg(long, conflicts_with_all = ["out", "truth"])]
    pub(super) strands: bool,
    /// Repeat each point so often, each time with other seeds of what is by chance (noise, jitter, draws)
    #[arg(long, value_parser = clap::value_parser!(u32).range(2..=10_000))]
    pub(super) replicate: Option<u32>,
    /// Run even if there are more than a thousand points
    #[arg(long)]
    pub(super) yes: bool,
}

impl SweepArgs {
    /// A flag that has no meaning for a search.
    pub(super) fn of_no_search(&self) -> Option<&'static str> {
        let given = [
            (!self.over.is_empty(), "--sweep"),
            (!self.tell.is_empty(), "--tell"),
            (!self.nodes.is_empty(), "--nodes"),
            (self.clean, "--clean"),
            (!self.show.is_empty(), "--show"),
            (self.replicate.is_some(), "--replicate"),
        ];
        given
            .into_iter()
            .find(|(given, _)| *given)
            .map(|(_, flag)| flag)
    }

    /// From the words behind `sweep` on a command line.
    ///
    /// # Errors
    ///
    /// What is wrong with them.
    pub fn read(words: &[String]) -> Result<SweepArgs, Fault> {
        let command = SweepArgs::augment_args(clap::Command::new("sweep").no_binary_name(true));
        let printed = command.try_get_matches_from(words);
        let printed = printed.map_err(|why| Fault::input(why.to_string().trim_end()))?;
        SweepArgs::from_arg_matches(&printed).map_err(Fault::input)
    }
}

/// What varies and what is asked, from the file and the command line.
pub(super) struct Asked {
    pub(super) points: Points,
    pub(super) name: String,
    pub(super) about: String,
    pub(super) tell: Vec<String>,
    /// The nodes that are wanted; none is the pipeline's goal.
    pub(super) nodes: Vec<String>,
}

/// The axes of the command line.
fn given(over: &[String]) -> Result<Vec<Axis>, Fault> {
    let all = over.iter().map(|text| axes::given(text));
    let all: Vec<Axis> = all.collect::<Result<_, _>>().map_err(Fault::input)?;
    for (k, axis) in all.iter().enumerate() {
        let before = || all[..k].iter().flat_map(|a| &a.params);
        if let Some((node, param)) = before().find(|p| axis.params.contains(p)) {
            return Err(Fault::input(format!(
                "`{node}.{param}` is in two --sweep: put all its values into one"
            )));
        }
    }
    Ok(all)
}

/// The sweep by its name, with what the command line adds.
pub(super) fn asked(
    args: &SweepArgs,
    pipeline: &Pipeline,
    base: &Graph,
    at: &dyn Fn(&Point) -> Result<Graph, Mistakes>,
) -> Result<Asked, Fault> {
    let recipe = pipeline.recipe();
    let known: Vec<&str> = recipe
        .sweeps
        .iter()
        .map(|s| s.name.value.as_str())
        .collect();
    let declared: Option<&Sweep> = match &args.name {
        None if args.over.is_empty() && args.replicate.is_none() => {
            let what = match known.is_empty() {
                true => "this pipeline declares none".to_owned(),
                false => format!("known: {}", known.join(", ")),
            };
            return Err(Fault::input(format!(
                "name a sweep ({what}) or give --sweep NODE.PARAM=VALUES"
            )));
        }
        None => None,
        Some(name) => {
            let found = recipe.sweeps.iter().find(|s| s.name.value == *name);
            Some(found.ok_or_else(|| Fault::coded(&stage::unknown("sweep", name, &known)))?)
        }
    };
    let mut all: Vec<Axis> = match declared {
        Some(sweep) => axes::axes(sweep, &pipeline.folder(&sweep.name)).map_err(Fault::input)?,
        None => vec![],
    };
    all.extend(given(&args.over)?);
    let variants: Vec<Option<String>> = match declared.map(|s| &s.with) {
        Some(with) if !with.is_empty() => with.iter().map(|v| Some(v.value.clone())).collect(),
        _ => vec![None],
    };
    let mut tell: Vec<String> =
        declared.map_or(vec![], |s| s.tell.iter().map(|t| t.value.clone()).collect());
    tell.extend(args.tell.iter().cloned());
    let nodes: Vec<String> = match (args.nodes.is_empty(), declared) {
        (true, Some(sweep)) => sweep.goal.iter().map(|g| g.value.clone()).collect(),
        _ => args.nodes.clone(),
    };
    let points = Points::new(base, variants, all);
    let declared_times = declared.and_then(|s| Some(s.replicate.as_ref()?.value));
    let points = match args.replicate.or(declared_times) {
        None => points,
        Some(times) => {
            let point = |variant: &Option<String>| {
                at(&Point {
                    variant: variant.clone(),
                    ..Point::default()
                })
            };
            let graphs = points.variants.iter().map(point);
            let graphs = graphs
                .collect::<Result<Vec<Graph>, _>>()
                .map_err(Fault::mistakes)?;
            let replicates = Replicates::of(times, &graphs, &nodes, &points.axes);
            points.repeated(replicates.map_err(Fault::input)?)
        }
    };
    Ok(Asked {
        points,
        name: args.name.clone().unwrap_or_else(|| "sweep".into()),
        about: declared.map_or(String::new(), |s| s.about.clone()),
        tell,
        nodes,
    })
}

/// Checks names and the values of every axis before anything runs. Returns the pipeline in each variant.
pub(super) fn checked(
    args: &SweepArgs,
    base: &Graph,
    asked: &Asked,
    at: &dyn Fn(&Point) -> Result<Graph, Mistakes>,
) -> Result<Vec<Graph>, Fault> {
    for name in &asked.nodes {
        node(base, name)?;
    }
    for tell in &asked.tell {
        let (of, _) = tell.split_once('.').unwrap_or((tell, ""));
        if of == "error" && args.truth.is_none() {
            let what = "needs ground truth: give --truth FOLDER";
            return Err(Fault::input(format!("`{tell}` {what}")));
        }
        if of != "error" && asked.points.variants == [None] {
            node(base, of)?;
        }
    }
    let graphs = graphs(asked, at)?;
    tellable(args, &graphs)?;
    // Each row of each axis alone: a param or a value that cannot be is refused before anything runs.
    let mut mistakes = Vec::new();
    for axis in &asked.points.axes {
        for row in axis.rows.iter().take(10_000) {
            let pairs = axis.params.iter().zip(row);
            let point = Point {
                variant: asked.points.variants[0].clone(),
                values: pairs
                    .map(|((n, p), v)| (n.clone(), p.clone(), v.clone()))
                    .collect(),
                ..Point::default()
            };
            if let Err(found) = at(&point) {
                let text = found.to_string().replace("--set", "--sweep");
                if !mistakes.contains(&text) {
                    mistakes.push(text);
                }
            }
        }
    }
    if !mistakes.is_empty() {
        return Err(Fault::input(mistakes.join("\n")));
    }
    let same = sweep::alike(&asked.points, &asked.nodes, at).map_err(Fault::mistakes)?;
    same.map_or(Ok(graphs), |why| Err(Fault::input(why)))
}

/// The pipeline in each variant.
fn graphs(
    asked: &Asked,
    at: &dyn Fn(&Point) -> Result<Graph, Mistakes>,
) -> Result<Vec<Graph>, Fault> {
    let point = |variant: &Option<String>| Point {
        variant: variant.clone(),
        ..Point::default()
    };
    let graphs = asked.points.variants.iter().map(|v| at(&point(v)));
    graphs.collect::<Result<_, _>>().map_err(Fault::mistakes)
}

/// Whether what `--tell` asks for is there at all; what the file asks for was looked at with it.
fn tellable(args: &SweepArgs, graphs: &[Graph]) -> Result<(), Fault> {
    for tell in &args.tell {
        let (node, metric) = tell.split_once('.').unwrap_or((tell, ""));
        let what = graphs.iter().map(|graph| {
            let bound = &graph.nodes[graph.node(node)?];
            let params = graph.nodes.iter().flat_map(|n| &n.params.values);
            let declared = sweep::entries(params.map(|(_, value)| value));
            sweep::missing_number(node, bound.stage, metric, &declared, graph.catalog)
        });
        // It is enough that one variant has it, or leaves the node out.
        if let Some(what) = what.collect::<Option<Vec<String>>>() {
            return Err(Fault::input(format!("`--tell {tell}`: {}", what[0])));
        }
    }
    Ok(())
}
