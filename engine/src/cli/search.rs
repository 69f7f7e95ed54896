//! `search`: the best set of params within ranges.

use super::arguments::Change;
use super::deliver;
use super::fault::Fault;
use super::open::{folders, options};
use super::program::GlobalArgs;
use super::programs::permitted;
use super::text::{count, lines, short, table, to_the_right};
use crate::delivery::{self, Delivery};
use crate::graph::Graph;
use crate::outcome::Outcome;
use crate::recipe::{Overrides, Pipeline, Search};
use crate::search::{Found, Round, Tried, Values, search as searched, variant};
use crate::store::Store;
use crate::sweep::{self, End, Errors, Point, Points, Replicates, Row, Sweeping};
use crate::walk::Watch;
use clap::Args;
use serde_json::{Value, json};
use std::path::PathBuf;
use std::sync::atomic::Ordering;

/// Arguments of `search`.
#[derive(Args)]
pub(crate) struct SearchArgs {
    /// The pipeline file, or the name of a built-in one
    pipeline: PathBuf,
    /// A search that it declares
    name: Option<String>,
    #[command(flatten)]
    change: Change,
    /// Ground truth, for a search of the least `error.…`
    #[arg(long)]
    truth: Option<PathBuf>,
    /// Write search.csv, search.json and best.toml (the best set as a variant) into this folder
    #[arg(long)]
    out: Option<PathBuf>,
}

struct Nobody;
impl Watch for Nobody {}

/// The search of a name.
fn declared<'a>(args: &SearchArgs, pipeline: &'a Pipeline) -> Result<&'a Search, Fault> {
    let all = &pipeline.recipe().searches;
    let known: Vec<&str> = all.iter().map(|s| s.sweep.name.value.as_str()).collect();
    let found = match &args.name {
        Some(name) => all.iter().find(|s| s.sweep.name.value == *name),
        None if all.len() == 1 => all.first(),
        None => None,
    };
    found.ok_or_else(|| match (&args.name, known.is_empty()) {
        (_, true) => Fault::input("this pipeline declares no [search.NAME]"),
        (None, _) => Fault::input(format!("name a search: {}", known.join(", "))),
        (Some(name), _) => Fault::input(stage::unknown("search", name, &known)),
    })
}

/// `search`.
pub(crate) fn search(args: &SearchArgs, global: &GlobalArgs) -> Result<(), Fault> {
    let all = Overrides {
        variant: args.change.variant.clone(),
        sets: args.change.set.clone(),
    };
    let pipeline = Pipeline::read(&args.pipeline, global.catalog()).map_err(Fault::mistakes)?;
    let base = pipeline.graph(&all).map_err(Fault::mistakes)?;
    let declared = declared(args, &pipeline)?;
    if let Some(out) = &args.out {
        delivery::check(out).map_err(Fault::input)?;
    }
    if declared.metric.value.starts_with("error.") && args.truth.is_none() {
        let what = "needs ground truth: say --truth FOLDER";
        return Err(Fault::input(format!("`{}` {what}", declared.metric.value)));
    }
    permitted(&base, global)?;
    let found = run(args, global, (&pipeline, &all, declared))?;
    told(args, global, declared, &found)
}

/// Round by round.
fn run(
    args: &SearchArgs,
    global: &GlobalArgs,
    (pipeline, all, declared): (&Pipeline, &Overrides, &Search),
) -> Result<Found, Fault> {
    let of = &declared.sweep;
    let variants: Vec<Option<String>> = match of.with.is_empty() {
        true => vec![None],
        false => of.with.iter().map(|v| Some(v.value.clone())).collect(),
    };
    let at = |point: &Point| pipeline.graph(&point.overrides(all));
    let point = |variant: &Option<String>| Point {
        variant: variant.clone(),
        ..Point::default()
    };
    let graphs = variants.iter().map(|v| at(&point(v)));
    let graphs = graphs
        .collect::<Result<Vec<Graph>, _>>()
        .map_err(Fault::mistakes)?;
    let nodes: Vec<String> = of.goal.iter().map(|g| g.value.clone()).collect();
    let tell: Vec<String> = of.tell.iter().map(|t| t.value.clone()).collect();
    let replicates = match &of.replicate {
        None => Replicates::default(),
        Some(times) => Replicates::of(times.value, &graphs, &nodes, &[]).map_err(Fault::input)?,
    };
    let options = options(global, true);
    let against = args.truth.as_deref().map(|truth| {
        move |graph: &Graph, outcome: &Outcome| (global.program().errors)(graph, outcome, truth)
    });
    let sweeping = Sweeping {
        open: &|point| {
            let graph = at(point).map_err(|m| m.to_string())?;
            permitted(&graph, global).map_err(|fault| fault.text().to_owned())?;
            Ok(graph)
        },
        nodes: &nodes,
        folders: &folders(&args.change)?,
        options: &options,
        tell: &tell,
        errors: against.as_ref().map(|errors| errors as &Errors<'_>),
        watch: &Nobody,
        cancel: global.host.cancel(),
    };
    let mut wrong = None;
    let found = searched(declared, |round: &Round<'_>| -> Result<Values, Fault> {
        let points = Points::new(&graphs[0], variants.clone(), vec![round.axis.clone()]);
        let points = points.repeated(replicates.clone());
        if !global.quiet && !global.json {
            crate::errln!("round {}: {}", round.number, count(points.count(), "point"));
        }
        let rows = sweep::run(&sweeping, points.iter(), |_| {}).map_err(Fault::input)?;
        if global.host.cancel().load(Ordering::Relaxed) {
            let text = "stopped; run the same command to go on".into();
            return Err(Fault {
                text,
                ..Fault::stopped()
            });
        }
        let times = of.replicate.as_ref().map_or(1, |r| r.value as usize);
        wrong = wrong.take().or(rows.iter().find_map(failed));
        Ok(rows
            .chunks(times)
            .map(|own| value(own, &declared.metric.value))
            .collect())
    })?;
    match found.best {
        Some(_) => Ok(found),
        None => Err(Fault::stage(format!(
            "`{}` was told at none of {}{}",
            declared.metric.value,
            count(found.tried.len(), "point"),
            wrong.map_or(String::new(), |why| format!(": {why}"))
        ))),
    }
}

/// Why a point came to nothing.
fn failed(row: &Row) -> Option<String> {
    match &row.end {
        End::Failed(node, why) => Some(format!("{node} failed: {why}")),
        End::Wrong(why) => Some(why.clone()),
        _ => None,
    }
}

/// The mean of a point's replicates; none where one does not tell it, for a set that is refused at times is no best one.
fn value(own: &[Row], metric: &str) -> (Option<String>, Option<f64>) {
    let one = |row: &Row| {
        let (_, metric) = row.metrics.iter().find(|(n, _)| n == metric)?;
        Some(metric.as_ref()?.value).filter(|_| row.end == End::Done)
    };
    let values: Option<Vec<f64>> = own.iter().map(one).collect();
    let mean = values.map(|v| v.iter().sum::<f64>() / v.len() as f64);
    (own[0].point.variant.clone(), mean)
}

/// So many of the best are shown.
const SHOWN: usize = 10;

/// Prints and writes what was found.
fn told(
    args: &SearchArgs,
    global: &GlobalArgs,
    declared: &Search,
    found: &Found,
) -> Result<(), Fault> {
    let Some(best) = &found.best else {
        return Ok(());
    };
    let name = &declared.sweep.name.value;
    let pipeline = args.pipeline.display().to_string();
    let json = json!({
        "program": global.catalog().program, "search": name, "metric": declared.metric.value,
        "most": declared.most, "cost": found.cost(), "best": as_json(best),
        "tried": found.tried.iter().map(as_json).collect::<Vec<_>>(),
    });
    let pretty = serde_json::to_string_pretty(&json).expect("bug: JSON");
    let toml = variant(&pipeline, name, best);
    // As a file it is read from another folder.
    let whole = std::fs::canonicalize(&args.pipeline).map(|p| p.display().to_string());
    let file = variant(&whole.unwrap_or(pipeline), name, best);
    if args.out.is_some() {
        let files = [
            ("search.json", pretty.clone()),
            ("search.csv", csv(declared, found)),
            ("best.toml", file),
        ];
        delivered(args, files, global)?;
    }
    if global.json {
        crate::outln!("{pretty}");
        return Ok(());
    }
    crate::outln!("{}\n", the_best(declared, found, best));
    crate::outln!(
        "{} tried, as dear as {:.1} whole ones; the best as a variant:\n\n{toml}",
        count(found.tried.len(), "point"),
        found.cost()
    );
    Ok(())
}

/// Writes the files as a delivery.
fn delivered(
    args: &SearchArgs,
    files: [(&str, String); 3],
    global: &GlobalArgs,
) -> Result<(), Fault> {
    let Some(out) = &args.out else { return Ok(()) };
    let folders = folders(&args.change)?;
    let of = deliver::whose(&folders);
    let store = Store::open(&global.cache).map_err(Fault::input)?;
    store.note_delivery(out, &of, &folders);
    let mut delivery = Delivery::open(out, &of).map_err(Fault::stage)?;
    delivery.begin().map_err(Fault::stage)?;
    for (name, text) in files {
        let file = [(String::new(), text.into_bytes())];
        delivery.put(name, &file).map_err(Fault::stage)?;
    }
    let run = json!({ "program": global.catalog().program });
    deliver::written(delivery, run, false, global)
}

/// The best sets, best first.
fn the_best(declared: &Search, found: &Found, best: &Tried) -> String {
    let mut all = table();
    let params = best.sets.iter().map(|(n, p, _)| format!("{n}.{p}"));
    let metric = declared.metric.value.clone();
    all.add_row(
        ["round".to_owned(), "variant".to_owned()]
            .into_iter()
            .chain(params)
            .chain([metric]),
    );
    let mut order: Vec<&Tried> = found
        .tried
        .iter()
        .filter(|t| t.value.is_some() && t.cost >= 1.0)
        .collect();
    let sign = if declared.most { -1.0 } else { 1.0 };
    order.sort_by(|a, b| {
        (sign * a.value.unwrap_or(0.0)).total_cmp(&(sign * b.value.unwrap_or(0.0)))
    });
    for tried in order.iter().take(SHOWN) {
        let variant = tried.variant.clone().unwrap_or_default();
        let sets = tried.sets.iter().map(|(_, _, v)| v.to_string());
        let value = tried.value.map_or("-".to_owned(), short);
        all.add_row(
            [tried.round.to_string(), variant]
                .into_iter()
                .chain(sets)
                .chain([value]),
        );
    }
    (2..best.sets.len() + 3).for_each(|column| to_the_right(&mut all, column));
    lines(&mut all)
}

fn as_json(tried: &Tried) -> Value {
    let set =
        |(node, param, value): &(String, String, stage::Value)| format!("{node}.{param}={value}");
    json!({
        "round": tried.round, "variant": tried.variant, "value": tried.value, "cost": tried.cost,
        "set": tried.sets.iter().map(set).collect::<Vec<_>>(),
    })
}

/// A line a point.
fn csv(declared: &Search, found: &Found) -> String {
    let own = |tried: &Tried| -> Vec<String> {
        let variant = tried.variant.clone().unwrap_or_default();
        let sets = tried.sets.iter().map(|(_, _, v)| v.to_string());
        let value = tried.value.map_or(String::new(), |v| v.to_string());
        let before = [tried.round.to_string(), variant].into_iter();
        before
            .chain(sets)
            .chain([tried.cost.to_string(), value])
            .collect()
    };
    let first = found.tried.first().map_or(&[][..], |t| &t.sets);
    let params = first.iter().map(|(n, p, _)| format!("{n}.{p}"));
    let head = ["round".to_owned(), "variant".to_owned()].into_iter();
    let mut lines: Vec<Vec<String>> = vec![
        head.chain(params)
            .chain(["cost".to_owned(), declared.metric.value.clone()])
            .collect(),
    ];
    lines.extend(found.tried.iter().map(own));
    sweep::as_csv(lines)
}
