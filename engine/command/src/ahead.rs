//! `plan`: what a run would do, without running. It takes the words of the program's own verbs, too: `plan measure DIR`.

use super::arguments::Words;
use super::aspects::Aspects;
use super::fault::Fault;
use super::open::node;
use super::planned::{Answer, of_verb, of_words, planned};
use super::program::{GlobalArgs, JobOf, Program};
use super::programs::listed;
use super::strands;
use super::why::short;
use clap::{ArgMatches, Args, Command};
use engine::plan::{Planned, State};
use serde_json::json;

/// Arguments of `plan`.
#[derive(Args)]
pub(crate) struct PlanArgs {
    #[command(flatten)]
    words: Words,
    /// Cut it into strands for a cluster instead; the plan goes into the cache, and its name is printed
    #[arg(long)]
    strands: bool,
    /// With --strands: one run for every folder in FOLDER, as the input NAME: NAME=FOLDER
    #[arg(long, requires = "strands")]
    each: Vec<String>,
    #[command(flatten)]
    aspects: Aspects,
}

/// With the program's own verbs behind both.
pub(super) fn of_verbs(mut command: Command, program: &Program) -> Command {
    for asks in ["plan", "why", "graph"] {
        let ahead = |job: &(&str, JobOf)| program.verbs.iter().find(|v| v.name == job.0);
        for verb in program.jobs.iter().filter_map(ahead) {
            let own = (verb.arguments)(Command::new(verb.name));
            let own = own.about(format!(
                "Of what `{}` with these words would run",
                verb.name
            ));
            command = command.mut_subcommand(asks, |asks| {
                asks.subcommand(own).disable_help_subcommand(true)
            });
        }
    }
    command
}

/// `plan`.
pub(crate) fn plan(
    args: &PlanArgs,
    verb: Option<(&str, &ArgMatches)>,
    global: &GlobalArgs,
) -> Result<(), Fault> {
    if let Some(answered) = args.aspects.answer(&args.words, verb, global) {
        return answered;
    }
    let answer = match verb {
        Some(_) if args.strands => {
            let why = "--strands cuts a pipeline: give its file or its name";
            return Err(Fault::input(why));
        }
        Some(verb) => {
            let mut job = of_verb(verb, global, &args.words)?;
            let nodes = job.nodes.iter().map(|name| node(&job.graph, name));
            let nodes = nodes.collect::<Result<Vec<usize>, Fault>>()?;
            if !nodes.is_empty() {
                job.goal = nodes;
            }
            Answer::of_job(job, global)?
        }
        None => {
            let wanted = of_words(&args.words, global)?;
            if args.strands {
                return strands::plan(&wanted, &args.each, global);
            }
            planned(&wanted, global)?
        }
    };
    reported(&answer, global);
    listed(&answer.graph, global)
}

/// Every node with what would become of it, and how long all may take.
fn reported(answer: &Answer, global: &GlobalArgs) {
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
