//! What `search` is asked for, and what it prints and writes.

use super::arguments::Change;
use super::deliver;
use super::fault::Fault;
use super::program::GlobalArgs;
use super::sweep_asked::SweepArgs;
use super::text::{count, short};
use clap::Args;
use engine::recipe::{Pipeline, Search};
use engine::search::{Found, Tried, variant};
use serde_json::{Value, json};
use std::path::PathBuf;
use tables::aligned::{lines, table, to_the_right};

/// Arguments of `search`.
#[derive(Args)]
pub(crate) struct SearchArgs {
    /// The pipeline file, or the name of a built-in one
    pub(super) pipeline: PathBuf,
    /// A search that it declares
    pub(super) name: Option<String>,
    #[command(flatten)]
    pub(super) change: Change,
    /// Ground truth, for a search of the least `error.…`
    #[arg(long)]
    pub(super) truth: Option<PathBuf>,
    /// Cut the next round into strands for a cluster instead of running it; once all rounds are there, the best set
    #[arg(long, conflicts_with = "truth")]
    pub(super) strands: bool,
    /// With --strands, a plan that was worked on: points that it did not make count as refused
    #[arg(long, value_name = "PLAN", requires = "strands")]
    pub(super) after: Vec<String>,
    /// Write search.csv, search.json and best.toml (the best set as a variant) into this folder
    #[arg(long)]
    pub(super) out: Option<PathBuf>,
}

impl SearchArgs {
    /// Of a `sweep` whose name is that of a search.
    pub(super) fn declared_as(
        sweep: &SweepArgs,
        global: &GlobalArgs,
    ) -> Result<Option<SearchArgs>, Fault> {
        let Some(name) = &sweep.name else {
            return Ok(None);
        };
        let pipeline =
            Pipeline::read(&sweep.pipeline, global.catalog()).map_err(Fault::mistakes)?;
        let mut names = pipeline.recipe().searches.iter().map(|s| &s.sweep.name);
        if !names.any(|known| known.value == *name) {
            return Ok(None);
        }
        if let Some(flag) = sweep.of_no_search() {
            let what = format!("`{name}` is a search, which takes no {flag}");
            return Err(Fault::input(what));
        }
        Ok(Some(SearchArgs {
            pipeline: sweep.pipeline.clone(),
            name: Some(name.clone()),
            change: sweep.change.clone(),
            truth: sweep.truth.clone(),
            strands: sweep.strands,
            after: vec![],
            out: sweep.out.clone(),
        }))
    }
}

/// So many of the best are shown.
const SHOWN: usize = 10;

/// Prints and writes what was found.
pub(super) fn reported(
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
    if let Some(out) = &args.out {
        let files = [
            ("search.json", pretty.clone()),
            ("search.csv", csv(declared, found)),
            ("best.toml", file),
        ];
        let files = files.map(|(name, text)| (name.to_owned(), text.into_bytes()));
        let delivery = deliver::begun(out, &args.change, global)?;
        deliver::tables(delivery, files, vec![], false, global)?;
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
    tables::as_csv(lines)
}
