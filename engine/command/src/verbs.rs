//! The engine's verbs, those of before among them: these work for a release, with a hint.

use super::fault::Fault;
use super::program::GlobalArgs;
use super::{
    ahead, answers, cache, cluster, export, impact, manual, run_verb, search, search_report, show,
    strands, study, sweep, sweep_asked, why,
};
use clap::{ArgMatches, Subcommand};
use engine::store::remote::Sharing;
use std::path::PathBuf;

/// The engine's verbs.
#[derive(Subcommand)]
pub(super) enum Own {
    /// Run a pipeline
    Run(run_verb::Run),
    /// What would run, and why; what a param reaches; the pipeline as a drawing; its mistakes
    Plan(ahead::PlanArgs),
    /// Every point of a sweep, or a search of the best, what they share made once: a table, plots
    Sweep(sweep_asked::SweepArgs),
    /// Tables that sweeps make, kept as pages: made again, and what moved
    Study(study::Study),
    /// One artifact out of the cache as a file
    Show(show::Show),
    /// Every stage with its ports, params, units, ranges and defaults
    Stages {
        /// One stage, or all of a crate
        name: Option<String>,
        /// The JSON schema of a pipeline file instead, for editors
        #[arg(long)]
        json_schema: bool,
        /// Where the default of each numeric param comes from instead
        #[arg(long, conflicts_with = "json_schema")]
        provenance: bool,
    },
    /// The built-in pipelines, or one of them printed: every verb takes their names in place of a file
    Pipelines {
        /// The one to print
        name: Option<String>,
    },
    /// A plan on several machines: submit, status, cancel, export, work
    Cluster {
        #[command(subcommand)]
        verb: OnCluster,
    },
    /// The store: ls, runs, pin, gc, forget, verify; the shared one: store, push, sweep-store, keygen
    Cache(cache::Cache),
    /// A script that completes arguments in a shell
    Completions(manual::Completions),
    /// Pages for `man`
    #[command(hide = true)]
    Man(manual::Man),
    /// `plan --why NODE`
    #[command(hide = true)]
    Why(why::Why),
    /// `plan --reach PARAM`
    #[command(hide = true)]
    Impact(impact::ImpactArgs),
    /// `plan --as dot`
    #[command(hide = true)]
    Graph(answers::Drawing),
    /// `plan --check`
    #[command(hide = true)]
    Check {
        /// The pipeline file, or the name of a built-in one
        pipeline: PathBuf,
    },
    /// `sweep PIPELINE NAME`
    #[command(hide = true)]
    Search(search_report::SearchArgs),
    /// `cluster work`
    #[command(hide = true)]
    Work(strands::Work),
    /// `cluster submit`
    #[command(hide = true)]
    Submit(cluster::Submit),
    /// `cluster status`
    #[command(hide = true)]
    Status(cluster::Asked),
    /// `cluster cancel`
    #[command(hide = true)]
    Cancel(cluster::Asked),
    /// `cluster export`
    #[command(hide = true)]
    Export(export::Export),
}

/// The verbs of `cluster`.
#[derive(Subcommand)]
pub(super) enum OnCluster {
    /// A plan onto a cluster: what is neither done nor sent; submitting again sends nothing twice
    Submit(cluster::Submit),
    /// How far a plan is: what is done by the cache, and why the rest is not
    Status(cluster::Asked),
    /// End the jobs of a plan; what is done stays
    Cancel(cluster::Asked),
    /// A plan as a Makefile or a Snakefile: one rule a strand
    Export(export::Export),
    /// Strands of a plan (`plan --strands`), on any machine that sees the cache
    Work(strands::Work),
}

/// Words of before, and those that took their place.
const BEFORE: [(&str, &str); 10] = [
    ("why", "plan --why NODE"),
    ("impact", "plan --reach PARAM"),
    ("graph", "plan --as dot"),
    ("check", "plan --check"),
    ("search", "sweep PIPELINE NAME"),
    ("work", "cluster work"),
    ("submit", "cluster submit"),
    ("status", "cluster status"),
    ("cancel", "cluster cancel"),
    ("export", "cluster export"),
];

/// Names the words that took the place of those of before.
pub(super) fn hint(verb: &str, global: &GlobalArgs) {
    let now = BEFORE.iter().find(|(before, _)| *before == verb);
    if let Some((before, now)) = now
        && !global.json
        && !global.quiet
    {
        let program = global.program().name;
        crate::errln!(
            "`{program} {before}` is `{program} {now}` now; the old word works for one more release"
        );
    }
}

impl Own {
    /// Does it. `own`: its matches; `command`: the whole command line.
    pub(super) fn done(
        &self,
        own: &ArgMatches,
        command: clap::Command,
        (global, sharing): (&GlobalArgs, Option<&Sharing>),
    ) -> Result<(), Fault> {
        match self {
            Self::Run(verb) => run_verb::run(verb, global),
            Self::Plan(verb) => ahead::plan(verb, own.subcommand(), global),
            Self::Sweep(verb) => sweep::sweep(verb, global),
            Self::Study(verb) => study::study(verb, global),
            Self::Show(verb) => show::show(verb, global),
            Self::Stages {
                json_schema: true, ..
            } => answers::schema(global),
            Self::Stages {
                name, provenance, ..
            } => answers::stages(name.as_deref(), *provenance, global),
            Self::Pipelines { name } => answers::pipelines(name.as_deref(), global),
            Self::Cluster { verb } => verb.done(global),
            Self::Cache(verb) => cache::cache(verb, global, sharing),
            Self::Completions(verb) => {
                manual::completions(verb, command);
                Ok(())
            }
            Self::Man(verb) => manual::man(verb, command),
            Self::Why(verb) => why::why(verb, own.subcommand(), global),
            Self::Impact(verb) => impact::impact(verb, global),
            Self::Graph(verb) => answers::graph(verb, own.subcommand(), global),
            Self::Check { pipeline } => answers::check(pipeline, global),
            Self::Search(verb) => search::search(verb, global),
            Self::Work(verb) => strands::work(verb, global),
            Self::Submit(verb) => cluster::submit(verb, global),
            Self::Status(verb) => cluster::status(verb, global),
            Self::Cancel(verb) => cluster::cancel(verb, global),
            Self::Export(verb) => export::export(verb, global),
        }
    }
}

impl OnCluster {
    fn done(&self, global: &GlobalArgs) -> Result<(), Fault> {
        match self {
            Self::Submit(verb) => cluster::submit(verb, global),
            Self::Status(verb) => cluster::status(verb, global),
            Self::Cancel(verb) => cluster::cancel(verb, global),
            Self::Export(verb) => export::export(verb, global),
            Self::Work(verb) => strands::work(verb, global),
        }
    }
}
