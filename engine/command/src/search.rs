//! `search`: the best set of params within ranges.

use super::fault::Fault;
use super::open::{folders, options, truth_is_there};
use super::program::GlobalArgs;
use super::programs::permitted;
use super::search_report::{SearchArgs, reported};
use super::search_strands::{self, Halt};
use super::strands::named;
use super::text::count;
use engine::Outcome;
use engine::delivery;
use engine::graph::Graph;
use engine::recipe::{Overrides, Pipeline, Search};
use engine::search::{Found, Round, Values, search as searched};
use engine::store::Store;
use engine::sweep::{self, End, Errors, Point, Points, Replicates, Row, Sweeping};
use std::sync::atomic::Ordering;

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
        (Some(name), _) => Fault::coded(&stage::unknown("search", name, &known)),
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
        let what = "needs ground truth: give --truth FOLDER";
        return Err(Fault::input(format!("`{}` {what}", declared.metric.value)));
    }
    truth_is_there(args.truth.as_deref())?;
    permitted(&base, global)?;
    match run(args, global, (&pipeline, &all, declared)) {
        Ok(found) => reported(args, global, declared, &found),
        Err(Halt::Fault(fault)) => Err(fault),
        Err(Halt::Next(round, plan)) => {
            let store = Store::open(&global.cache).map_err(Fault::input)?;
            named(&plan, Some(round), &store, global)
        }
    }
}

/// Round by round.
fn run(
    args: &SearchArgs,
    global: &GlobalArgs,
    (pipeline, all, declared): (&Pipeline, &Overrides, &Search),
) -> Result<Found, Halt> {
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
    let folders = folders(&args.change)?;
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
        folders: &folders,
        options: &options,
        tell: &tell,
        errors: against.as_ref().map(|errors| errors as &Errors<'_>),
        watch: &(),
        cancel: global.host.cancel(),
    };
    let mut wrong = None;
    let found = searched(declared, |round: &Round<'_>| -> Result<Values, Halt> {
        let points = Points::new(&graphs[0], variants.clone(), vec![round.axis.clone()]);
        let points: Vec<Point> = points.repeated(replicates.clone()).iter().collect();
        if !global.quiet && !global.json {
            crate::errln!("round {}: {}", round.number, count(points.len(), "point"));
        }
        let there = match args.strands {
            false => vec![true; points.len()],
            true => search_strands::Round {
                number: round.number,
                args,
                pipeline,
                all,
                folders: &folders,
                nodes: &nodes,
                global,
            }
            .there(&points)?,
        };
        let whole = points.iter().zip(&there).filter(|(_, there)| **there);
        let whole = whole.map(|(point, _)| point.clone());
        let rows = sweep::run(&sweeping, whole, |_| {}).map_err(Fault::input)?;
        if global.host.cancel().load(Ordering::Relaxed) {
            let text = "stopped; run the same command to go on".into();
            return Err(Halt::Fault(Fault {
                text,
                ..Fault::stopped()
            }));
        }
        wrong = wrong.take().or(rows.iter().find_map(failed));
        Ok(values(&points, &there, &rows, declared))
    })?;
    found_or(found, declared, wrong)
}

/// What was found, if anything was.
fn found_or(found: Found, declared: &Search, wrong: Option<String>) -> Result<Found, Halt> {
    match found.best {
        Some(_) => Ok(found),
        None => Err(Halt::Fault(Fault::stage(format!(
            "`{}` was measured at none of {}{}",
            declared.metric.value,
            count(found.tried.len(), "point"),
            wrong.map_or(String::new(), |why| format!(": {why}"))
        )))),
    }
}

/// What a round's points came to: those that are not there, to nothing.
fn values(points: &[Point], there: &[bool], rows: &[Row], declared: &Search) -> Values {
    let times = declared.sweep.replicate.as_ref();
    let times = times.map_or(1, |r| r.value as usize);
    let mut rows = rows.iter();
    let row = |there: &bool| there.then(|| rows.next()).flatten();
    let rows: Vec<Option<&Row>> = there.iter().map(row).collect();
    let own = points.chunks(times).zip(rows.chunks(times));
    let value = |(points, rows): (&[Point], &[Option<&Row>])| {
        let variant = points[0].variant.clone();
        (variant, value(rows, &declared.metric.value))
    };
    own.map(value).collect()
}

/// Why a point came to nothing.
fn failed(row: &Row) -> Option<String> {
    match &row.end {
        End::Failed(node, why) => Some(format!("{node} failed: {why}")),
        End::Wrong(why) => Some(why.clone()),
        _ => None,
    }
}

/// The mean of a point's replicates; none where one has none: a set that is refused at times is no best one.
fn value(own: &[Option<&Row>], metric: &str) -> Option<f64> {
    let one = |row: &Option<&Row>| {
        let row = (*row)?;
        let (_, metric) = row.metrics.iter().find(|(n, _)| n == metric)?;
        Some(metric.as_ref()?.value).filter(|_| row.end == End::Done)
    };
    let values: Option<Vec<f64>> = own.iter().map(one).collect();
    values.map(|v| v.iter().sum::<f64>() / v.len() as f64)
}
