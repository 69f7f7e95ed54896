//! `export`: a plan as rules for another engine.

use super::fault::Fault;
use super::itself;
use super::program::GlobalArgs;
use clap::{Args, ValueEnum};
use engine::delivery;
use engine::store::Store;
use engine::strands::Plan;
use std::path::PathBuf;

/// For whom a plan is written.
#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum Form {
    /// GNU make
    Makefile,
    /// Snakemake
    Snakemake,
}

/// Arguments of `export`.
#[derive(Args)]
pub(crate) struct Export {
    /// The plan that `--strands` named, or its first digits
    plan: String,
    /// For whom
    #[arg(long = "as")]
    form: Form,
    /// Threads of a rule
    #[arg(long, default_value_t = 1)]
    cpus: usize,
    /// Write it there instead of printing it
    #[arg(short, long)]
    out: Option<PathBuf>,
}

/// `export`: a plan as rules for another engine, one a strand.
pub(crate) fn export(args: &Export, global: &GlobalArgs) -> Result<(), Fault> {
    let store = Store::open(&global.cache).map_err(Fault::input)?;
    let (name, plan) = Plan::read(&store, &args.plan).map_err(Fault::plan)?;
    let rules = cluster::Rules {
        called: global.program().name,
        name: &name,
        program: &itself::program(global)?,
        cache: &std::path::absolute(&global.cache).map_err(Fault::input)?,
        flags: &super::shared::words(global)?,
        threads: args.cpus.max(1),
    };
    let text = match args.form {
        Form::Makefile => cluster::makefile(&plan, rules),
        Form::Snakemake => cluster::snakefile(&plan, rules),
    };
    match &args.out {
        None => crate::out!("{text}"),
        Some(file) => {
            let file_of = [(String::new(), text.into_bytes())];
            delivery::write(file, &file_of).map_err(Fault::stage)?;
        }
    }
    Ok(())
}
