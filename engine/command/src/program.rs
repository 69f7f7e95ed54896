//! A program: an application's catalog, what it adds to the engine's command line, and what every verb takes.

use super::fault::Fault;
use super::host::Host;
use super::ran::Ran;
use super::size::bytes;
use clap::{ArgMatches, Args, Command};
use engine::Catalog;
use engine::Outcome;
use engine::graph::Graph;
use stage::{AnyArtifact, Metric};
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use tables::Reference;

/// A program. [`Program::new`] has the engine's verbs and nothing else.
pub struct Program {
    /// What it is called on the command line.
    pub name: &'static str,
    /// Its version.
    pub version: &'static str,
    /// What it does, in a sentence.
    pub about: &'static str,
    /// Its stages and kinds.
    pub catalog: &'static Catalog,
    /// The environment variable for the folder where results are kept.
    pub cache_env: &'static str,
    /// The environment variable for the most that the cache may hold.
    pub size_env: &'static str,
    /// The environment variable for the store that machines share.
    pub store_env: &'static str,
    /// The environment variable for the file that signs what goes there.
    pub sign_env: &'static str,
    /// The environment variable for the file that lists whose signatures are believed.
    pub trust_env: &'static str,
    /// The built-in pipeline that is used where none is given.
    pub pipeline: Option<&'static str>,
    /// The input whose folder alone marks results as its own, where a verb of the program's asks for that.
    pub input: Option<&'static str>,
    /// Verbs of its own, before the engine's.
    pub verbs: &'static [Verb],
    /// What verbs of its own would run, for `plan` and `why`: the verb, and how its words become a job.
    pub jobs: &'static [(&'static str, JobOf)],
    /// What a page in HTML that is written gets from its run: warnings, how it was made.
    pub complete: fn(&[u8], &Ran<'_>) -> Vec<u8>,
    /// A result as it is written: with what only its run knows of it.
    pub present: fn(AnyArtifact, &Ran<'_>) -> AnyArtifact,
    /// The last screen of a run, if it made something that the program shows.
    pub screen: fn(&Ran<'_>) -> Option<String>,
    /// Errors of results against a folder of ground truth, for `sweep --truth`.
    pub errors: fn(&Graph, &Outcome, &Path) -> Result<Vec<Metric>, String>,
    /// What a metric is compared with on plots, by its name and unit: the truth of that folder, limits.
    pub references: fn(&str, &str, Option<&Path>) -> Vec<Reference>,
}

/// What a verb would run.
pub struct Job {
    /// The pipeline.
    pub graph: Graph,
    /// The folder of each input.
    pub folders: Vec<(String, PathBuf)>,
    /// The nodes whose results it wants.
    pub goal: Vec<usize>,
    /// The nodes that are asked after; none is all.
    pub nodes: Vec<String>,
}

/// What a verb would run, by its words.
pub type JobOf = fn(&ArgMatches, &GlobalArgs) -> Result<Job, Fault>;

/// A verb of a program's own.
pub struct Verb {
    /// The word.
    pub name: &'static str,
    /// Adds its arguments and its help.
    pub arguments: fn(Command) -> Command,
    /// What it runs.
    pub run: fn(&ArgMatches, &GlobalArgs) -> Result<(), Fault>,
    /// Whether it runs stages: then the cache is swept after it if it is over its size.
    pub runs: bool,
}

impl Program {
    /// With the engine's verbs alone.
    pub const fn new(
        name: &'static str,
        version: &'static str,
        about: &'static str,
        catalog: &'static Catalog,
    ) -> Program {
        Program {
            name,
            version,
            about,
            catalog,
            cache_env: "STAGE_CACHE",
            size_env: "STAGE_MAX_SIZE",
            store_env: "STAGE_STORE",
            sign_env: "STAGE_SIGN_KEY",
            trust_env: "STAGE_TRUST",
            pipeline: None,
            input: None,
            verbs: &[],
            jobs: &[],
            complete: |page, _| page.to_vec(),
            present: |artifact, _| artifact,
            screen: |_| None,
            errors: |_, _, _| Err("this program has no ground truth".into()),
            references: |_, _, _| vec![],
        }
    }
}

/// When programs run in a sandbox.
#[derive(clap::ValueEnum, Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Walls {
    /// Where there is one; what is missing is reported
    #[default]
    Auto,
    /// Always: else no program runs
    Required,
}

/// What every verb takes.
#[derive(Args, Clone)]
pub struct GlobalArgs {
    /// Answer in JSON
    #[arg(long, global = true)]
    pub json: bool,
    /// Where results are kept
    #[arg(long, global = true, default_value = "cache")]
    pub cache: PathBuf,
    /// Number of threads (default one per core, at most four per core)
    #[arg(long, global = true)]
    pub threads: Option<NonZeroUsize>,
    /// What the cache may hold, such as 500M or 20G: what is worth least goes at the end of a run
    #[arg(long, global = true, value_parser = bytes)]
    pub max_size: Option<u64>,
    /// Share results with other machines: s3://BUCKET/PREFIX, gs://…, az://…, or file:///FOLDER
    #[arg(long, global = true, value_name = "ADDRESS")]
    pub store: Option<String>,
    /// Take results from the shared store, and put none there
    #[arg(long, global = true, requires = "store")]
    pub store_read_only: bool,
    /// Sign what goes to the shared store with the key of this file (`cache keygen`)
    #[arg(long, global = true, value_name = "FILE")]
    pub sign_key: Option<PathBuf>,
    /// Believe of the shared store only what one of the public keys in this file signed
    #[arg(long, global = true, value_name = "FILE")]
    pub trust: Option<PathBuf>,
    /// Give up on uploads after SECONDS without progress; what is left stays in the cache for the next run
    #[arg(long, global = true, default_value_t = 60.0, value_name = "SECONDS")]
    pub store_wait: f64,
    /// Let the programs of the pipeline run (`stage = "exec"`); remembered for you until one changes
    #[arg(long, global = true)]
    pub allow_exec: bool,
    /// Whether the pipeline's programs may run where there is no full sandbox
    #[arg(long, global = true, value_name = "WHEN", value_enum, default_value_t)]
    pub sandbox: Walls,
    /// Print nothing but results and errors
    #[arg(long, global = true)]
    pub quiet: bool,
    /// Where a profile of the run is written, if one is wanted.
    #[arg(skip)]
    pub profile: Option<PathBuf>,
    /// The program whose command line it is.
    #[arg(skip)]
    pub program: Option<&'static Program>,
    /// Who starts its verbs.
    #[arg(skip)]
    pub host: Host,
}

impl GlobalArgs {
    /// For a program that is no command line: nothing is printed but answers and errors.
    pub fn of(program: &'static Program, cache: PathBuf, host: Host) -> GlobalArgs {
        GlobalArgs {
            json: true,
            cache,
            threads: None,
            max_size: None,
            store: None,
            store_read_only: false,
            sign_key: None,
            trust: None,
            store_wait: 60.0,
            allow_exec: false,
            sandbox: Walls::default(),
            quiet: true,
            profile: None,
            program: Some(program),
            host,
        }
    }

    /// The program whose command line it is.
    pub fn program(&self) -> &'static Program {
        self.program.expect("bug: arguments of no program")
    }

    /// Its stages and kinds.
    pub fn catalog(&self) -> &'static Catalog {
        self.program().catalog
    }
}
