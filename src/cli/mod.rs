//! Arguments, and which verb they mean.

/// Prints to standard output; a reader that has gone away is no fault of ours.
macro_rules! out {
    ($($t:tt)*) => {{
        use std::io::Write;
        let text = $crate::cli::screen::plain(format!($($t)*));
        $crate::cli::printed(write!(std::io::stdout(), "{text}"));
    }};
}

/// As `out!`, with an end of line.
macro_rules! outln {
    ($($t:tt)*) => {{
        use std::io::Write;
        let text = $crate::cli::screen::plain(format!($($t)*));
        $crate::cli::printed(writeln!(std::io::stdout(), "{text}"));
    }};
}

/// Prints to standard error, if anybody takes it.
macro_rules! errln {
    ($($t:tt)*) => {{
        use std::io::Write;
        let text = $crate::cli::screen::plain(format!($($t)*));
        let _ = writeln!(std::io::stderr(), "{text}");
    }};
}
use {errln, out, outln};

mod answers;
mod budget;
mod cache;
mod compare;
mod deliver;
mod door;
mod impact;
mod mat;
mod private;
mod provenance;
mod run;
mod scoring;
mod screen;
mod show;
mod speak;
mod sweep;
mod sweep_asked;

use crate::recipe::Mistakes;
use clap::{Args, Parser, Subcommand};
use serde_json::{Map, Value};
use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::atomic::{AtomicBool, Ordering};

/// Girths of a body from the photographs of one turn, as a stage graph with cached artifacts.
#[derive(Parser)]
#[command(name = "tailor", version)]
struct Cli {
    #[command(flatten)]
    house: House,
    #[command(subcommand)]
    verb: Verb,
}

/// What every verb takes.
#[derive(Args, Clone)]
pub(crate) struct House {
    /// Answer in JSON
    #[arg(long, global = true)]
    json: bool,
    /// Where results are kept
    #[arg(long, global = true, env = "TAILOR_CACHE", default_value = "cache")]
    cache: PathBuf,
    /// How many threads work; one a core if not said, four a core at most
    #[arg(long, global = true)]
    threads: Option<NonZeroUsize>,
    /// What the cache may hold, such as 500M or 20G: what is worth least goes at the end of a run
    #[arg(long, global = true, env = "TAILOR_MAX_SIZE", value_parser = budget::bytes)]
    max_size: Option<u64>,
    /// Say nothing but results and errors
    #[arg(long, global = true)]
    quiet: bool,
}

/// What is to be run, and with what changed.
#[derive(Args, Clone)]
pub(crate) struct Wanted {
    /// The pipeline file
    pipeline: PathBuf,
    /// Nodes that are wanted instead of the pipeline's goal
    nodes: Vec<String>,
    #[command(flatten)]
    change: Change,
}

/// What is changed on the command line.
#[derive(Args, Clone)]
pub(crate) struct Change {
    /// Hand over an input: NAME=FOLDER
    #[arg(long)]
    input: Vec<String>,
    /// A variant of the pipeline; several separated by commas
    #[arg(long)]
    variant: Option<String>,
    /// Another value for a param: NODE.PARAM=VALUE
    #[arg(long)]
    set: Vec<String>,
}

impl Change {
    /// Whether the pipeline is changed.
    fn changes(&self) -> bool {
        self.variant.is_some() || !self.set.is_empty()
    }
}

#[derive(Subcommand)]
enum Verb {
    /// Photos of one turn to girths, with a report
    Measure(door::Measure),
    /// Run a pipeline
    Run(run::Run),
    /// What would run, and why
    Plan(Wanted),
    /// Which line of what a node depends on changed: old, new, back to the root cause
    Why(answers::Why),
    /// Every point of a sweep, what they share made once: a table, plots
    Sweep(sweep_asked::SweepArgs),
    /// Variants, runs or folders of results side by side: params, girths, surfaces, time
    Compare(compare::CompareArgs),
    /// Which nodes a param reaches, and what it would cost to change it
    Impact(impact::ImpactArgs),
    /// The pipeline as a drawing: DOT or Mermaid
    Graph(answers::Drawing),
    /// One artifact out of the cache as a file
    Show(show::Show),
    /// Every stage with its ports, params, units, ranges and defaults
    Stages {
        /// One stage, or all of a room
        name: Option<String>,
        /// The JSON schema of a pipeline file instead, for editors
        #[arg(long)]
        json_schema: bool,
    },
    /// All mistakes of a pipeline at once
    Check {
        /// The pipeline file
        pipeline: PathBuf,
    },
    /// The store: ls, du, runs, pin, unpin, pins, gc, forget, verify
    Cache(cache::Cache),
    /// A printable marker mat for the disk: PDF or SVG at true scale
    Mat(mat::MatArgs),
    /// A result against ground truth
    Score(scoring::Scoring),
}

/// Set when an answer could not be written.
static LOST: AtomicBool = AtomicBool::new(false);

/// Notes whether what was printed got anywhere.
fn printed(result: std::io::Result<()>) {
    let lost = |e: std::io::Error| e.kind() != std::io::ErrorKind::BrokenPipe;
    if result.is_err_and(lost) {
        LOST.store(true, Ordering::Relaxed);
    }
}

/// Set when the user asks to stop.
static CANCEL: AtomicBool = AtomicBool::new(false);

/// Why a verb came to nothing: what to print (nothing if its answer has said it), and the exit code.
pub(crate) struct Fault {
    code: u8,
    text: String,
    /// What `--json` tells beside the text.
    more: Map<String, Value>,
}

impl Fault {
    /// The input or the pipeline is wrong.
    fn input(text: impl ToString) -> Fault {
        Fault {
            code: 2,
            text: text.to_string(),
            more: Map::new(),
        }
    }

    /// The pipeline is wrong: every mistake with its place.
    fn mistakes(mistakes: Mistakes) -> Fault {
        let more = match mistakes.json() {
            Value::Object(more) => more,
            _ => Map::new(),
        };
        Fault {
            more,
            ..Fault::input(mistakes)
        }
    }

    /// The user asked to stop.
    fn stopped() -> Fault {
        Fault {
            code: 130,
            ..Fault::input("stopped; run the same command to go on")
        }
    }

    /// A stage failed.
    fn stage(text: impl ToString) -> Fault {
        Fault {
            code: 1,
            ..Fault::input(text)
        }
    }
}

/// Does what the arguments say. Exit codes: 0 done, 1 a stage failed, 2 input or pipeline wrong,
/// 130 cancelled.
pub fn main() -> ExitCode {
    let mut cli = Cli::parse();
    let _ = ctrlc::set_handler(|| {
        if CANCEL.swap(true, Ordering::Relaxed) {
            private::burn();
            std::process::exit(130);
        }
        errln!("stopping; what is done is kept, run again to go on (once more stops at once)");
    });
    let private = match &cli.verb {
        Verb::Measure(verb) => verb.private,
        Verb::Run(verb) => verb.private,
        _ => false,
    };
    let begun = match private {
        true => private::cache().map(|cache| cli.house.cache = cache),
        false => Ok(()),
    };
    let house = &cli.house;
    let done = begun.and_then(|()| done(&cli.verb, house));
    printed(std::io::Write::flush(&mut std::io::stdout()));
    if let Verb::Measure(_) | Verb::Run(_) | Verb::Sweep(_) | Verb::Compare(_) = &cli.verb {
        budget::after_run(house);
    }
    private::burn();
    ended(done, house)
}

fn done(verb: &Verb, house: &House) -> Result<(), Fault> {
    match verb {
        Verb::Measure(verb) => door::measure(verb, house),
        Verb::Run(verb) => run::run(verb, house),
        Verb::Plan(wanted) => answers::plan(wanted, house),
        Verb::Why(verb) => answers::why(verb, house),
        Verb::Sweep(verb) => sweep::sweep(verb, house),
        Verb::Compare(verb) => compare::compare_sides(verb, house),
        Verb::Impact(verb) => impact::impact(verb, house),
        Verb::Graph(verb) => answers::graph(verb, house),
        Verb::Show(verb) => show::show(verb, house),
        Verb::Stages { name, json_schema } => match json_schema {
            true => answers::schema(),
            false => answers::stages(name.as_deref(), house),
        },
        Verb::Check { pipeline } => answers::check(pipeline, house),
        Verb::Cache(verb) => cache::cache(verb, house),
        Verb::Mat(verb) => mat::mat(verb, house),
        Verb::Score(verb) => scoring::scoring(verb, house),
    }
}

/// Says what is wrong last of all, and with which code the program ends.
fn ended(done: Result<(), Fault>, house: &House) -> ExitCode {
    match done {
        Ok(()) if LOST.load(Ordering::Relaxed) => {
            errln!("the answer could not be written to standard output: is the disk full?");
            ExitCode::FAILURE
        }
        Ok(()) => ExitCode::SUCCESS,
        Err(fault) => {
            if fault.text.is_empty() {
                // The answer itself has said it.
            } else if house.json {
                let mut answer = fault.more;
                answer.insert("error".into(), fault.text.into());
                answer.insert("code".into(), fault.code.into());
                outln!("{}", Value::Object(answer));
            } else {
                errln!("{}", fault.text);
            }
            ExitCode::from(fault.code)
        }
    }
}
