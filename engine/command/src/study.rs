//! `study`: tables that sweeps make, kept as pages: made again, and what moved.

use super::fault::Fault;
use super::program::GlobalArgs;
use super::sweep::{Heard, swept};
use super::sweep_asked::SweepArgs;
use super::text::count;
use clap::{Args, Subcommand};
use engine::delivery;
use engine::recipe::Pipeline;
use engine::sweep::End;
use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;
use tables::Table;

/// Arguments of `study`.
#[derive(Args)]
pub(crate) struct Study {
    #[command(subcommand)]
    what: What,
}

#[derive(Subcommand)]
enum What {
    /// Make studies' tables again, from the cache as far as it has them, and print what moved
    Run(Run),
    /// The studies with what they ask
    Ls {
        /// The folder with the studies
        #[arg(long, default_value = "studies")]
        studies: PathBuf,
    },
}

#[derive(Args)]
struct Run {
    /// Names of studies, or `all`
    #[arg(required = true)]
    names: Vec<String>,
    /// The folder with the studies: a pipeline file each, with a sweep of the file's name
    #[arg(long, default_value = "studies")]
    studies: PathBuf,
    /// The folder with their pages and data
    #[arg(long, default_value = "docs/lab")]
    out: PathBuf,
    /// Write nothing; fail if a number moved
    #[arg(long)]
    check: bool,
}

/// The names of the studies in a folder, in order.
fn known(folder: &Path) -> Result<Vec<String>, Fault> {
    let wrong = |e: std::io::Error| Fault::input(format!("{}: {e}", folder.display()));
    let mut names = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(wrong)? {
        let path = entry.map_err(wrong)?.path();
        let name = path.file_stem().map(|s| s.to_string_lossy().into_owned());
        names.extend(name.filter(|_| path.extension().is_some_and(|e| e == "toml")));
    }
    names.sort();
    Ok(names)
}

/// What a study asks; its sweep is called as its file.
fn about(folder: &Path, name: &str, global: &GlobalArgs) -> Result<String, Fault> {
    let file = folder.join(format!("{name}.toml"));
    let pipeline = Pipeline::read(&file, global.catalog()).map_err(Fault::mistakes)?;
    let sweeps = &pipeline.recipe().sweeps;
    let own = sweeps.iter().find(|s| s.name.value == name);
    let own = own.ok_or_else(|| {
        Fault::input(format!(
            "{}: a study has a sweep of its file's name: [sweep.{name}]",
            file.display()
        ))
    })?;
    Ok(own.about.clone())
}

/// `study`.
pub(crate) fn study(args: &Study, global: &GlobalArgs) -> Result<(), Fault> {
    match &args.what {
        What::Ls { studies } => {
            for name in known(studies)? {
                crate::outln!("{name}  {}", about(studies, &name, global)?);
            }
            Ok(())
        }
        What::Run(run) => made(run, global),
    }
}

fn made(run: &Run, global: &GlobalArgs) -> Result<(), Fault> {
    let all = known(&run.studies)?;
    let names: Vec<String> = match run.names.iter().any(|n| n == "all") {
        true => all,
        false => {
            let known: Vec<&str> = all.iter().map(String::as_str).collect();
            if let Some(name) = run.names.iter().find(|n| !known.contains(&n.as_str())) {
                return Err(Fault::coded(&stage::unknown("study", name, &known)));
            }
            run.names.clone()
        }
    };
    let mut moved = 0;
    for name in &names {
        moved += one(run, name, global)?;
    }
    match moved {
        0 => crate::outln!("{}: nothing moved", count_of(names.len())),
        n => crate::outln!("{}: {} moved", count_of(names.len()), count(n, "number")),
    }
    match run.check && moved > 0 {
        true => Err(Fault::stage("")),
        false => Ok(()),
    }
}

fn count_of(n: usize) -> String {
    match n {
        1 => "1 study".to_owned(),
        n => format!("{n} studies"),
    }
}

/// Makes one; how many numbers moved.
fn one(run: &Run, name: &str, global: &GlobalArgs) -> Result<usize, Fault> {
    let asks = about(&run.studies, name, global)?;
    let file = run.studies.join(format!("{name}.toml"));
    let data = run.out.join(format!("{name}.json"));
    let before: Option<serde_json::Value> = std::fs::read(&data)
        .ok()
        .and_then(|b| serde_json::from_slice(&b).ok());
    if run.check && before.is_none() {
        return Err(Fault::input(format!(
            "{}: there is no earlier data to hold it against; run without --check once",
            data.display()
        )));
    }
    let args = SweepArgs::read(&[
        file.display().to_string(),
        name.to_owned(),
        "--yes".to_owned(),
    ])?;
    let voice = !global.quiet && !global.json;
    let swept = swept(&args, global, &(), &mut |heard| match heard {
        Heard::Outlook(outlook) if voice => crate::errln!("{name}: {outlook}"),
        Heard::Row(row, at, _) if voice && row.made > 0 => {
            crate::errln!("{name}: point {at}, {} made", row.made);
        }
        _ => {}
    })?;
    if global.host.cancel().load(Ordering::Relaxed) {
        let text = "stopped; run the same command to go on".into();
        return Err(Fault {
            text,
            ..Fault::stopped()
        });
    }
    if let Some(row) = swept
        .rows
        .iter()
        .find(|r| !matches!(r.end, End::Done | End::Failed(..)))
    {
        return Err(Fault::stage(format!("{name}: {:?}", row.end)));
    }
    let program = global.catalog().program;
    let table = Table::new(name, &asks, &swept.rows);
    let moved = match &before {
        Some(before) => table.moved(before, program),
        None => vec![],
    };
    moved.iter().for_each(|m| crate::outln!("{name}: {m}"));
    if !run.check {
        let pretty = serde_json::to_string_pretty(&table.data(program)).expect("bug: JSON") + "\n";
        for (file, text) in [
            (data, pretty),
            (run.out.join(format!("{name}.md")), table.page(program)),
        ] {
            delivery::write(&file, &[(String::new(), text.into_bytes())]).map_err(Fault::stage)?;
        }
    }
    Ok(moved.len())
}
