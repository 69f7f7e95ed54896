//! `--profile FILE`: where a run's time and memory went, as a table on the screen and a trace in the file.

use super::fault::Fault;
use super::profile::{Cost, Profile, Profiler};
use super::program::GlobalArgs;
use super::text::short;
use engine::walk::{Both, Watch};
use std::fs::File;
use std::io::Write;
use std::path::Path;
use system::private_file;
use tables::aligned::{lines, table, to_the_right};

/// Runs it with somebody who listens; where a profile is asked for, takes one, shows it and writes it.
pub(super) fn profiled<T>(
    watch: &dyn Watch,
    global: &GlobalArgs,
    run: impl FnOnce(&dyn Watch) -> T,
) -> Result<T, Fault> {
    let Some(path) = &global.profile else {
        return Ok(run(watch));
    };
    // Before any work: whether it can be written at all.
    let file = private_file(File::options().create(true).truncate(true).write(true)).open(path);
    let why = |e: std::io::Error| Fault::input(format!("{}: {e}", path.display()));
    let file = file.map_err(why)?;
    let profiler = Profiler::default();
    let made = run(&Both(&profiler, watch));
    let profile = profiler.profile();
    written(file, &profile).map_err(why)?;
    if !global.quiet && !global.json {
        crate::errln!("{}", shown(&profile, path));
    }
    Ok(made)
}

fn written(mut file: File, profile: &Profile) -> std::io::Result<()> {
    file.write_all(profile.trace().to_string().as_bytes())
}

/// What is shown: a line for each node, and under it its loops.
fn shown(profile: &Profile, path: &Path) -> String {
    let costs = profile.costs();
    if costs.is_empty() {
        return format!(
            "nothing ran: all results were found; {} holds an empty trace",
            path.display()
        );
    }
    let mut all = table();
    all.set_header([
        "node, loop",
        "clock s",
        "processor s",
        "threads busy",
        "memory MB",
    ]);
    (1..5).for_each(|column| to_the_right(&mut all, column));
    let row = |c: &Cost| {
        let name = match &c.label {
            Some(label) => format!("  {label}"),
            None => c.node.clone(),
        };
        let or = |x: Option<f64>| x.map_or("-".to_owned(), short);
        let processor = c.spent.processor;
        let busy = processor
            .map(|p| p / c.seconds)
            .filter(|_| c.seconds >= 0.1);
        let tenth = |x: f64| (x * 10.0).round() / 10.0;
        [
            name,
            short(tenth(c.seconds)),
            or(processor.map(tenth)),
            or(busy.map(|b| (b * 100.0).round() / 100.0)),
            or(c.spent.memory.map(|bytes| (bytes as f64 / 1e6).round())),
        ]
    };
    for node in costs.iter().filter(|c| c.label.is_none()) {
        all.add_row(row(node));
        // Loops that are over at once show nothing.
        let loops = costs
            .iter()
            .filter(|c| c.label.is_some() && c.node == node.node);
        for one in loops.filter(|c| c.seconds >= 0.05) {
            all.add_row(row(one));
        }
    }
    format!(
        "\n{}\n\ntrace: {} (open it in ui.perfetto.dev or about:tracing)",
        lines(&mut all),
        path.display()
    )
}
