//! `tailor compare` over replicates: the same points by two or more methods, pair by pair.

use crate::recipe::{Overrides, Pipeline};
use crate::sweep::{self, Point, Points, Replicates, Sweeping};
use command::{Change, Fault, GlobalArgs, folders};
use engine::Options;
use serde_json::{Value, json};
use stage::{Message, message};
use std::path::Path;
use tables::{Pairs, Reported, paired, pairs_page, pairs_text};

stage::messages! {
    NO_POINT = "cli-compare-point": "these sweeps have no point in common: the same params and replicates are compared, one by one";
    NO_SWEEP = "cli-compare-sweep": "this is no sweep.json of `sweep --out`";
    VARIANTS = "cli-compare-variants": "its points are of several variants, which its own page compares; give folders of one each";
    WRONG = "cli-compare-file": "{file}: {why}";
}

/// What each side is called, and its points.
type Sides = Vec<(String, Vec<Reported>)>;

/// What two or more sides came to, and against the first.
pub(super) struct Against {
    sides: Sides,
    pairs: Vec<Vec<Pairs>>,
}

/// `quick+hull.voxel_mm=2` beside what is changed for all.
pub(super) fn changed(text: &str, all: &Change) -> Change {
    let mut change = all.clone();
    let mut variants: Vec<String> = change.variant.into_iter().collect();
    for part in text.split('+').filter(|p| *p != "as-is") {
        match part.contains('=') {
            true => change.set.push(part.to_owned()),
            false => variants.push(part.to_owned()),
        }
    }
    change.variant = (!variants.is_empty()).then(|| variants.join(","));
    change
}

/// Runs every side so often, replicate by replicate with the same seeds.
pub(super) fn of_variants(
    pipeline: &str,
    what: &[&String],
    (times, tell, change): (u32, &[String], &Change),
    global: &GlobalArgs,
) -> Result<Against, Fault> {
    let pipeline =
        Pipeline::read(Path::new(pipeline), global.catalog()).map_err(Fault::mistakes)?;
    let over = |text: &str, more: Vec<String>| {
        let change = changed(text, change);
        Overrides {
            variant: change.variant,
            sets: [change.set, more].concat(),
        }
    };
    let graphs = what.iter().map(|text| pipeline.graph(&over(text, vec![])));
    let graphs = graphs
        .collect::<Result<Vec<_>, _>>()
        .map_err(Fault::mistakes)?;
    for reported in tell {
        let (node, _) = reported.split_once('.').unwrap_or((reported, ""));
        command::node(&graphs[0], node)?;
    }
    let replicates = Replicates::of(times, &graphs, &[], &[]).map_err(Fault::input)?;
    let names = what.iter().map(|text| Some((*text).clone())).collect();
    let points = Points::new(&graphs[0], names, vec![]).repeated(replicates);
    let options = Options {
        cache: global.cache.clone(),
        threads: global.threads.map(Into::into),
        keep_going: true,
    };
    let open = |point: &Point| {
        let side = point.variant.as_deref().unwrap_or("as-is");
        pipeline
            .graph(&over(side, point.sets()))
            .map_err(|m| m.to_string())
    };
    let sweeping = Sweeping {
        open: &open,
        nodes: &[],
        folders: &folders(change)?,
        options: &options,
        tell,
        errors: None,
        watch: &(),
        cancel: global.host.cancel(),
    };
    let count = points.count();
    let mut at = 0;
    let rows = sweep::run(&sweeping, points.iter(), |row| {
        at += 1;
        if !global.quiet && !global.json {
            command::errln!("[{at:>3}/{count}] {}", row.point.name("compare"));
        }
    });
    let rows = rows.map_err(Fault::input)?;
    if global
        .host
        .cancel()
        .load(std::sync::atomic::Ordering::Relaxed)
    {
        return Err(Fault::stopped());
    }
    let reported: Vec<Reported> = rows.iter().map(Reported::of).collect();
    let own = |text: &&String| {
        let own = reported.iter().filter(|t| t.variant.as_ref() == Some(text));
        ((*text).clone(), own.cloned().collect())
    };
    Ok(Against::new(what.iter().map(own).collect()))
}

/// Folders that `sweep --out` wrote; `None` where one is no such folder.
pub(super) fn of_folders(what: &[&String]) -> Option<Result<Against, Fault>> {
    let file = |text: &String| Path::new(text).join("sweep.json");
    if !what.iter().all(|text| file(text).is_file()) {
        return None;
    }
    let read = |text: &&String| {
        let shown = file(text).display().to_string();
        let wrong = |why: Message| Fault::coded(&message!(WRONG, file = &shown, why = why));
        let bytes = std::fs::read(file(text)).map_err(|e| wrong(e.to_string().into()))?;
        let sweep: Value =
            serde_json::from_slice(&bytes).map_err(|e| wrong(e.to_string().into()))?;
        let reported = Reported::read(&sweep).ok_or_else(|| wrong(message!(NO_SWEEP)))?;
        if reported
            .iter()
            .any(|t| t.variant.is_some() && t.variant != reported[0].variant)
        {
            return Err(wrong(message!(VARIANTS)));
        }
        Ok(((*text).clone(), reported))
    };
    let sides: Result<Sides, Fault> = what.iter().map(read).collect();
    Some(sides.and_then(|sides| {
        let against = Against::new(sides);
        match against.pairs.iter().any(Vec::is_empty) {
            true => Err(Fault::coded(&message!(NO_POINT))),
            false => Ok(against),
        }
    }))
}

impl Against {
    fn new(sides: Sides) -> Against {
        let rest = sides.iter().skip(1);
        let pairs = rest
            .map(|(_, reported)| paired(&sides[0].1, reported))
            .collect();
        Against { sides, pairs }
    }

    /// For people.
    pub(super) fn text(&self) -> String {
        let names = self.sides.iter().skip(1);
        let each = names.zip(&self.pairs);
        each.map(|((name, _), pairs)| pairs_text(&self.sides[0].0, name, pairs))
            .collect()
    }

    /// For other programs.
    pub(super) fn json(&self) -> Value {
        let names = self.sides.iter().skip(1);
        let each = names.zip(&self.pairs).map(|((name, _), pairs)| {
            let pairs: Vec<Value> = pairs.iter().map(Pairs::json).collect();
            json!({ "first": self.sides[0].0, "second": name, "pairs": pairs })
        });
        json!({ "paired": each.collect::<Vec<_>>() })
    }

    /// As a page.
    pub(super) fn page(&self) -> String {
        let names = self.sides.iter().skip(1).map(|(name, _)| name.as_str());
        let each: Vec<(&str, &str, &[Pairs])> = names
            .zip(&self.pairs)
            .map(|(name, pairs)| (self.sides[0].0.as_str(), name, pairs.as_slice()))
            .collect();
        pairs_page(&each)
    }
}
