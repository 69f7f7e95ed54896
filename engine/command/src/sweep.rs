//! `sweep`: every point of a sweep, one table.

use super::deliver;
use super::fault::Fault;
use super::open::{folders, options, truth_is_there};
use super::program::GlobalArgs;
use super::programs::{permitted, unguarded};
use super::search;
use super::search_report::SearchArgs;
use super::strands::written;
use super::sweep_asked::{Asked, SweepArgs, asked, checked};
use super::sweep_behind;
use super::sweep_report::{another, missing_metrics};
use engine::Outcome;
use engine::delivery;
use engine::graph::Graph;
use engine::lasttime::History;
use engine::past::Of;
use engine::recipe::{Overrides, Pipeline};
use engine::store::Store;
use engine::strands;
use engine::sweep::{self, End, Errors, Outlook, Point, Row, Sweeping, outlook};
use engine::walk::Watch;
use std::sync::atomic::Ordering;

/// More points than this ask for `--yes`.
const MANY: u128 = 1000;

/// What is heard of a sweep while it goes on.
pub enum Heard<'a> {
    /// How many points, and how long they may take.
    Outlook(&'a Outlook),
    /// A point came to its end: what came of it, its place from 1 on, and what people call it.
    Row(&'a Row, usize, String),
}

/// A sweep that came to its end, or was stopped.
pub struct Swept {
    asked: Asked,
    pipeline: Pipeline,
    all: Overrides,
    /// What came of each point.
    pub rows: Vec<Row>,
}

impl Swept {
    /// For other programs.
    pub fn json(&self, program: &str) -> serde_json::Value {
        tables::json(program, &self.asked.name, &self.asked.about, &self.rows)
    }

    /// What was asked for and no point has.
    pub fn missing(&self) -> Vec<String> {
        missing_metrics(&self.asked, &self.rows)
    }
}

/// A sweep that may run.
struct Ready {
    pipeline: Pipeline,
    all: Overrides,
    base: Graph,
    asked: Asked,
    wanted: Vec<usize>,
    outlook: Outlook,
}

fn ready(args: &SweepArgs, global: &GlobalArgs) -> Result<Ready, Fault> {
    truth_is_there(args.truth.as_deref())?;
    let all = Overrides {
        variant: args.change.variant.clone(),
        sets: args.change.set.clone(),
    };
    let pipeline = Pipeline::read(&args.pipeline, global.catalog()).map_err(Fault::mistakes)?;
    let base = pipeline.graph(&all).map_err(Fault::mistakes)?;
    let at = |point: &Point| pipeline.graph(&point.overrides(&all));
    let asked = asked(args, &pipeline, &base, &at)?;
    permitted(&base, global)?;
    let graphs = checked(args, &base, &asked, &at)?;
    sweep_behind::check(args, &graphs)?;
    let wanted: Vec<usize> = match asked.nodes.is_empty() {
        true => base.goal.clone(),
        false => asked.nodes.iter().filter_map(|n| base.node(n)).collect(),
    };
    let history = History::of(&global.cache, Of::default());
    let last = |node: &str| history.last(node).map(|n| n.seconds);
    let outlook = outlook(&asked.points, &base, &wanted, &last);
    if asked.points.count() > MANY && !args.yes {
        return Err(Fault::input(format!(
            "this sweep has {outlook}; if you mean it, give --yes"
        )));
    }
    Ok(Ready {
        pipeline,
        all,
        base,
        asked,
        wanted,
        outlook,
    })
}

/// Cuts a sweep into strands instead of running it.
fn cut(args: &SweepArgs, global: &GlobalArgs) -> Result<(), Fault> {
    let ready = ready(args, global)?;
    let folders = folders(&args.change)?;
    let one = |p: Point| (p.overrides(&ready.all), folders.clone());
    let points: Vec<_> = ready.asked.points.iter().map(one).collect();
    let asked = strands::Asked {
        pipeline: &ready.pipeline,
        points: &points,
        nodes: &ready.asked.nodes,
    };
    written(&asked, global)
}

/// Runs the points of a sweep and writes the table.
pub(crate) fn sweep(args: &SweepArgs, global: &GlobalArgs) -> Result<(), Fault> {
    if let Some(search) = SearchArgs::declared_as(args, global)? {
        return search::search(&search, global);
    }
    if args.strands {
        return cut(args, global);
    }
    if let Some(out) = &args.out {
        delivery::check(out).map_err(Fault::input)?;
    }
    let voice = Voice(!global.quiet && !global.json);
    let mut count = 0;
    let swept = swept(args, global, &voice, &mut |heard| match heard {
        Heard::Outlook(outlook) => {
            count = outlook.points;
            voice.line(&outlook.to_string());
        }
        Heard::Row(row, at, name) => {
            let end = match &row.end {
                End::Done => format!("{} made in {:.1} s", row.made, row.seconds),
                End::Failed(node, _) => format!("{node} FAILED"),
                End::Wrong(_) => "WRONG".into(),
                End::Stopped => "stopped".into(),
            };
            voice.line(&format!("[{at:>3}/{count}] {name}  {end}"));
        }
    })?;
    finish(args, global, &swept)
}

/// Runs the points of a sweep that the command line describes.
///
/// # Errors
///
/// The pipeline, the sweep or its inputs are wrong. A point that fails is in its row.
pub fn swept(
    args: &SweepArgs,
    global: &GlobalArgs,
    watch: &dyn Watch,
    heard: &mut dyn FnMut(Heard<'_>),
) -> Result<Swept, Fault> {
    let ready = ready(args, global)?;
    let (all, base, asked, wanted) = (&ready.all, &ready.base, ready.asked, &ready.wanted);
    let at = |point: &Point| ready.pipeline.graph(&point.overrides(all));
    let outlook = &ready.outlook;
    heard(Heard::Outlook(outlook));
    unguarded(base, wanted, global);
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
        nodes: &asked.nodes,
        folders: &folders(&args.change)?,
        options: &options,
        tell: &asked.tell,
        errors: against.as_ref().map(|errors| errors as &Errors<'_>),
        watch,
        cancel: global.host.cancel(),
    };
    let mut so_far = 0;
    let done = |row: &Row| {
        so_far += 1;
        heard(Heard::Row(row, so_far, row.point.name(&asked.name)));
    };
    let rows = sweep::run(&sweeping, asked.points.iter(), done).map_err(Fault::input)?;
    Ok(Swept {
        asked,
        rows,
        pipeline: ready.pipeline,
        all: ready.all,
    })
}

/// Prints and writes what came out; a point without a result is a failure, a stop is a stop.
fn finish(args: &SweepArgs, global: &GlobalArgs, swept: &Swept) -> Result<(), Fault> {
    let Swept { asked, rows, .. } = swept;
    let (name, about) = (&asked.name, &asked.about);
    let json = swept.json(global.catalog().program);
    if let Some(folder) = &args.out {
        let store = Store::open(&global.cache).map_err(Fault::input)?;
        let mut delivery = deliver::begun(folder, &args.change, global)?;
        let at = |point: &Point| swept.pipeline.graph(&point.overrides(&swept.all)).ok();
        let files = sweep_behind::written(args, rows, &at, (&store, &mut delivery))?;
        let pretty = serde_json::to_string_pretty(&json).expect("bug: JSON");
        let references = |metric: &str, unit: &str| {
            (global.program().references)(metric, unit, args.truth.as_deref())
        };
        let shown = tables::page(name, about, rows, &references, &|row| {
            sweep_behind::behind(row, &files, (args, &store, global))
        });
        let mut files = vec![
            ("sweep.csv".to_owned(), tables::csv(rows)),
            ("sweep.json".to_owned(), pretty),
            ("sweep.html".to_owned(), shown.page),
        ];
        files.extend(tables::statistics(rows));
        let files = files
            .into_iter()
            .map(|(name, text)| (name, text.into_bytes()));
        let files = files.chain(typed(rows)?);
        deliver::tables(delivery, files, shown.plots, args.clean, global)?;
    }
    match global.json {
        true => crate::outln!(
            "{}",
            serde_json::to_string_pretty(&json).expect("bug: JSON")
        ),
        false => crate::out!("{}", tables::text(about, rows)),
    }
    swept
        .missing()
        .iter()
        .for_each(|line| crate::errln!("{line}"));
    if let Some(line) = another(args, rows, global) {
        crate::errln!("{line}");
    }
    if global.host.cancel().load(Ordering::Relaxed) {
        let text = "stopped; run the same command to go on".into();
        return Err(Fault {
            text,
            ..Fault::stopped()
        });
    }
    match rows.iter().filter(|r| r.end != End::Done).count() {
        0 => Ok(()),
        // The table has reported which and why.
        _ => Err(Fault::stage("")),
    }
}

/// The points with types, where this program writes Parquet.
#[cfg(feature = "parquet")]
fn typed(rows: &[Row]) -> Result<Vec<(String, Vec<u8>)>, Fault> {
    super::parquet::columns(rows)
}

#[cfg(not(feature = "parquet"))]
fn typed(_: &[Row]) -> Result<Vec<(String, Vec<u8>)>, Fault> {
    Ok(vec![])
}

/// A line a point on standard error.
struct Voice(bool);

impl Voice {
    fn line(&self, line: &str) {
        if self.0 {
            crate::errln!("{line}");
        }
    }
}

impl Watch for Voice {}
