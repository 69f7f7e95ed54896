//! `plan` and `why`: what a run would do, and why, without running. Both take their words alike, and those of the
//! program's own verbs: `plan measure DIR`.

use super::arguments::{Wanted, Words};
use super::fault::Fault;
use super::open::{folders, node, open, prefetch};
use super::program::{GlobalArgs, Job, JobOf, Program};
use super::programs::listed;
use super::strands;
use crate::graph::Graph;
use crate::past::NodeLine;
use crate::plan::{self, Planned, State};
use crate::store::Store;
use crate::{session, why};
use clap::{ArgMatches, Args, Command};
use serde_json::{Value, json};
use stage::Files;
use std::path::{Path, PathBuf};

/// Arguments of `plan`.
#[derive(Args)]
pub(crate) struct PlanArgs {
    #[command(flatten)]
    words: Words,
    /// Cut it into strands for a cluster instead; the plan lies in the cache, its name is told
    #[arg(long)]
    strands: bool,
    /// With --strands: one run for every folder in FOLDER, as the input NAME: NAME=FOLDER
    #[arg(long, requires = "strands")]
    each: Vec<String>,
}

/// Arguments of `why`.
#[derive(Args)]
pub(crate) struct Why {
    #[command(flatten)]
    words: Words,
    /// Against the run of this run.json, of this machine or another, instead of the last run of the same here
    #[arg(long, value_name = "RUN.JSON")]
    against: Option<PathBuf>,
}

/// With the program's own verbs behind both.
pub(super) fn of_verbs(mut command: Command, program: &Program) -> Command {
    for asks in ["plan", "why", "graph"] {
        let ahead = |job: &(&str, JobOf)| program.verbs.iter().find(|v| v.name == job.0);
        for verb in program.jobs.iter().filter_map(ahead) {
            let own = (verb.arguments)(Command::new(verb.name));
            let own = own.about(format!(
                "Of what `{}` would run, said by its words",
                verb.name
            ));
            command = command.mut_subcommand(asks, |asks| {
                asks.subcommand(own).disable_help_subcommand(true)
            });
        }
    }
    command
}

/// What would run, and of which files.
pub(super) struct Answer {
    pub(super) graph: Graph,
    pub(super) plan: Vec<Option<Planned>>,
    files: Vec<Files>,
    store: Store,
    /// The nodes that are asked after.
    nodes: Vec<String>,
}

/// What a run of these would do.
pub(super) fn planned(wanted: &Wanted, global: &GlobalArgs) -> Result<Answer, Fault> {
    let prefetch = prefetch(wanted, global);
    let (graph, goal) = open(wanted, global)?;
    let store = Store::open_after(&global.cache, prefetch).map_err(Fault::input)?;
    let folders = folders(&wanted.change)?;
    let nodes = wanted.nodes.clone();
    let job = Job {
        graph,
        folders,
        goal,
        nodes,
    };
    looked_at(job, store)
}

pub(super) fn looked_at(job: Job, store: Store) -> Result<Answer, Fault> {
    let Job {
        graph,
        folders,
        goal,
        nodes,
    } = job;
    let files = session::inputs(&graph, &folders, &store).map_err(Fault::input)?;
    let plan = plan::plan(&graph, &files, &goal, &store);
    Ok(Answer {
        graph,
        plan,
        files,
        store,
        nodes,
    })
}

/// The verb comes first.
fn behind(verb: &str) -> Fault {
    let why = format!("say `{verb}` first, and behind it what you would say to `{verb}` itself");
    Fault::input(why)
}

/// What is asked after, if it is a pipeline and nodes of it.
pub(super) fn of_words(words: &Words, global: &GlobalArgs) -> Result<Wanted, Fault> {
    match words.verb(global) {
        Some(verb) => Err(behind(verb)),
        None => Ok(words.wanted(global)),
    }
}

/// What a verb of the program's own would run: `plan measure DIR`.
pub(super) fn of_verb(
    (verb, said): (&str, &ArgMatches),
    global: &GlobalArgs,
    words: &Words,
) -> Result<Job, Fault> {
    if !words.is_empty() {
        return Err(behind(verb));
    }
    let mut jobs = global.program().jobs.iter();
    let job = jobs.find(|(name, _)| *name == verb);
    (job.expect("bug: a verb without a job").1)(said, global)
}

/// `plan`.
pub(crate) fn plan(
    args: &PlanArgs,
    verb: Option<(&str, &ArgMatches)>,
    global: &GlobalArgs,
) -> Result<(), Fault> {
    let answer = match verb {
        Some(_) if args.strands => {
            let why = "--strands cuts a pipeline: say its file or its name";
            return Err(Fault::input(why));
        }
        Some(verb) => {
            let mut job = of_verb(verb, global, &args.words)?;
            let nodes = job.nodes.iter().map(|name| node(&job.graph, name));
            let nodes = nodes.collect::<Result<Vec<usize>, Fault>>()?;
            if !nodes.is_empty() {
                job.goal = nodes;
            }
            let store = Store::open(&global.cache).map_err(Fault::input)?;
            looked_at(job, store)?
        }
        None => {
            let wanted = of_words(&args.words, global)?;
            if args.strands {
                return strands::plan(&wanted, &args.each, global);
            }
            planned(&wanted, global)?
        }
    };
    told(&answer, global);
    listed(&answer.graph, global)
}

/// Every node with what would become of it, and how long all may take.
fn told(answer: &Answer, global: &GlobalArgs) {
    let Answer { graph, plan, .. } = answer;
    let (mut lines, mut seconds, mut unknown) = (Vec::new(), [0.0; 2], 0);
    for (node, planned) in graph.nodes.iter().zip(plan) {
        let Some(p) = planned else { continue };
        let word = match &p.state {
            State::Cached => "cached",
            State::Stale(_) => "will run",
            State::May => "may run",
        };
        unknown += usize::from(p.state != State::Cached && p.seconds.is_none());
        match p.state {
            State::Cached => {}
            State::Stale(_) => seconds[0] += p.seconds.unwrap_or(0.0),
            State::May => seconds[1] += p.seconds.unwrap_or(0.0),
        }
        let why = match &p.state {
            State::Stale(lines) => lines.clone(),
            _ => vec![],
        };
        if global.json {
            lines.push(
                json!({ "node": node.name, "state": word, "seconds": p.seconds, "why": why }),
            );
        } else {
            let took = p.seconds.map_or("?".into(), |s| format!("{s:.1} s"));
            let why: Vec<String> = why
                .iter()
                .map(|(w, o, n)| format!("{w}: {} -> {}", short(o), short(n)))
                .collect();
            crate::outln!("{word:<9} {:<14} {took:>8}  {}", node.name, why.join("; "));
        }
    }
    if global.json {
        crate::outln!(
            "{}",
            json!({
                "nodes": lines, "will_seconds": seconds[0], "may_seconds": seconds[1],
                "without_history": unknown,
            })
        );
    } else {
        let never = match unknown {
            0 => String::new(),
            1 => "; 1 node has never run here, so nothing is known of its time".to_owned(),
            n => format!("; {n} nodes have never run here, so nothing is known of their time"),
        };
        let cached = |p: &Planned| p.state == State::Cached;
        match plan.iter().flatten().all(cached) {
            true => crate::outln!("all cached"),
            false => crate::outln!(
                "expected: {:.1} s, and up to {:.1} s more if results change{never}",
                seconds[0],
                seconds[1],
            ),
        }
    }
}

/// A hash shortened, anything else as it is.
fn short(text: &str) -> &str {
    let hash = text.len() == 64 && text.bytes().all(|b| b.is_ascii_hexdigit());
    if hash { &text[..12] } else { text }
}

/// The nodes of a `run.json`.
fn nodes_of(file: &Path) -> Result<Vec<NodeLine>, Fault> {
    let wrong = |why: String| Fault::input(format!("{}: {why}", file.display()));
    let bytes = std::fs::read(file).map_err(|e| wrong(e.to_string()))?;
    let run: Value = serde_json::from_slice(&bytes).map_err(|e| wrong(e.to_string()))?;
    let nodes = run.get("nodes").cloned().unwrap_or_default();
    let what = "no record of a run; `measure` and `run --out` write one as run.json";
    serde_json::from_value(nodes).map_err(|e| wrong(format!("{what} ({e})")))
}

/// `why`: the node and all that is to blame, back to every root cause.
pub(crate) fn why(
    why: &Why,
    verb: Option<(&str, &ArgMatches)>,
    global: &GlobalArgs,
) -> Result<(), Fault> {
    let answer = match verb {
        Some(verb) => {
            let job = of_verb(verb, global, &why.words)?;
            let store = Store::open(&global.cache).map_err(Fault::input)?;
            looked_at(job, store)?
        }
        None => {
            let wanted = of_words(&why.words, global)?;
            // What a run of the whole would do with it.
            let whole = Wanted {
                nodes: vec![],
                ..wanted.clone()
            };
            Answer {
                nodes: wanted.nodes,
                ..planned(&whole, global)?
            }
        }
    };
    let Answer { graph, plan, .. } = &answer;
    let [name] = answer.nodes.as_slice() else {
        let names: Vec<&str> = graph.nodes.iter().map(|n| n.name.as_str()).collect();
        let names = names.join(", ");
        return Err(Fault::input(format!("say one node of: {names}")));
    };
    let at = node(graph, name)?;
    let causes = match &why.against {
        Some(file) => why::against(graph, plan, &nodes_of(file)?, at),
        None => why::causes(graph, plan, &answer.files, answer.store.root(), at),
    };
    let mut chain: Vec<Value> = Vec::new();
    for cause in &causes {
        let (name, state) = (&graph.nodes[cause.node].name, cause.state);
        let changes = &cause.changes;
        if !global.json {
            let so = match changes.is_empty() && state == "cached" {
                true => ", as in the last run",
                false => "",
            };
            crate::outln!("{name}: {state}{so}");
            changes
                .iter()
                .for_each(|(w, o, n)| crate::outln!("  {w}: {} -> {}", short(o), short(n)));
        }
        chain.push(json!({ "node": name, "state": state, "changes": changes }));
    }
    if global.json {
        crate::outln!("{}", json!({ "chain": chain }));
    }
    Ok(())
}
