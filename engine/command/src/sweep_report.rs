//! What is printed beside the rows of a sweep: commands behind a point, metrics that are missing.

use super::program::GlobalArgs;
use super::sweep_asked::{Asked, SweepArgs};
use super::text::count;
use engine::recipe::Overrides;
use engine::sweep::{End, Row};

/// Commands that give what is behind a point: its results into a folder, one of them as a file, what it hangs on.
pub(super) fn how(row: &Row, args: &SweepArgs, global: &GlobalArgs) -> Vec<String> {
    let quoted = |word: &str| match word.contains([' ', '"', '\'', '[', '$', '(']) {
        true => format!("'{}'", word.replace('\'', "'\\''")),
        false => word.to_owned(),
    };
    let all = Overrides {
        variant: args.change.variant.clone(),
        sets: args.change.set.clone(),
    };
    let over = row.point.overrides(&all);
    let variant = over
        .variant
        .iter()
        .map(|v| format!(" --variant {}", quoted(v)));
    let sets = over.sets.iter().map(|s| format!(" --set {}", quoted(s)));
    let inputs = args
        .change
        .input
        .iter()
        .map(|i| format!(" --input {}", quoted(i)));
    let cache = [format!(
        " --cache {}",
        quoted(&global.cache.display().to_string())
    )];
    let words: String = variant.chain(sets).chain(inputs).chain(cache).collect();
    let (name, pipeline) = (
        global.program().name,
        quoted(&args.pipeline.display().to_string()),
    );
    vec![
        format!("{name} run {pipeline}{words} --out point"),
        format!("{name} show NODE --pipeline {pipeline}{words} -o FILE"),
        format!("{name} why {pipeline} NODE{words}"),
    ]
}

/// What was asked for and no point has, or not all have.
pub(super) fn missing_metrics(asked: &Asked, rows: &[Row]) -> Vec<String> {
    let mut lines = Vec::new();
    let done: Vec<&Row> = rows.iter().filter(|r| r.end == End::Done).collect();
    for name in asked.tell.iter().filter(|_| !done.is_empty()) {
        let has = |row: &&Row| row.metrics.iter().any(|(n, m)| n == name && m.is_some());
        let reported = done.iter().filter(|row| has(row)).count();
        if reported > 0 && reported < done.len() {
            lines.push(format!(
                "`{name}` was measured at {reported} of {}: the rest refused it or have no such node (see their warnings), so means and plots are of these alone",
                count(done.len(), "point")
            ));
        }
        if reported == 0 {
            let known: Vec<&str> = done[0].known.iter().map(String::as_str).collect();
            lines.push(format!(
                "`{name}` was not measured at any point (see the warnings); available: {}",
                known.join(", ")
            ));
        }
    }
    lines
}

/// Whether the truth may be another body's: at no point is any error within its limits.
pub(super) fn another(args: &SweepArgs, rows: &[Row], global: &GlobalArgs) -> Option<String> {
    let truth = args.truth.as_deref()?;
    let done = rows.iter().filter(|r| r.end == End::Done);
    let (mut of, mut within) = (0, 0);
    for (name, metric) in done.flat_map(|row| &row.metrics) {
        let Some(metric) = metric.as_ref().filter(|_| name.starts_with("error.")) else {
            continue;
        };
        let lines = (global.program().references)(name, &metric.unit, Some(truth));
        let limits = lines.iter().map(|line| line.value);
        let least = limits.clone().fold(f64::MAX, f64::min);
        let most = limits.fold(f64::MIN, f64::max);
        if least < most {
            of += 1;
            within += usize::from((least..=most).contains(&metric.value));
        }
    }
    (of > 0 && within == 0).then(|| {
        format!(
            "none of {} is within its limits: is {} the truth of this body?",
            count(of, "error"),
            truth.display()
        )
    })
}
