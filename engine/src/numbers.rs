//! Which numbers a node can have: its stage's metrics, its result's own numbers, time, processor, memory and size.

use programs::Catalog;
use stage::{AnyStage, Value, fits_any, nearest};

/// What every node has.
pub(crate) const BESIDE: [(&str, &str); 4] = [
    ("seconds", "s"),
    ("bytes", "B"),
    ("processor", "s"),
    ("memory", "B"),
];

/// Ends of an interval that a result has for one of its numbers.
pub const ENDS: [&str; 2] = [".interval.lo", ".interval.hi"];

/// How many names are listed to somebody who asked for one that there is not.
const LISTED: usize = 24;

/// What is wrong with asking a node of this stage for a number, if it cannot have it: the nearest that
/// it can, and what there is. `declared` are the entries of the pipeline's sections.
pub fn missing_number(
    node: &str,
    stage: &dyn AnyStage,
    metric: &str,
    declared: &[String],
    catalog: &Catalog,
) -> Option<String> {
    let facts = catalog.names(stage.yields(), declared);
    let beside = BESIDE.map(|(name, _)| name);
    let known = || {
        let metrics = stage.metrics().iter().copied();
        let facts = facts.iter().map(String::as_str);
        metrics.chain(facts).chain(beside)
    };
    if fits_any(&known().collect::<Vec<_>>(), metric) {
        return None;
    }
    let mut all: Vec<&str> = Vec::new();
    known().for_each(|name| {
        if !all.contains(&name) {
            all.push(name);
        }
    });
    let asked = match nearest(metric, &all) {
        Some(near) => format!("did you mean `{near}`? "),
        None => String::new(),
    };
    let more = match all.len() > LISTED {
        true => ", …",
        false => "",
    };
    all.truncate(LISTED);
    let stage = stage.name();
    Some(format!(
        "`{node}` ({stage}) has no `{metric}`; {asked}it has: {}{more}",
        all.join(", ")
    ))
}

/// The entries of the sections among some params.
pub fn entries<'a>(params: impl Iterator<Item = &'a Value>) -> Vec<String> {
    let tables = params.filter_map(|value| match value {
        Value::Table(table) => Some(table.keys().cloned()),
        _ => None,
    });
    tables.flatten().collect()
}
