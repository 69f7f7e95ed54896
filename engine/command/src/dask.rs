//! `submit`, `status` and `cancel` with `--engine dask=ADDRESS`.

use super::fault::Fault;
use super::itself;
use super::known::known;
use super::program::GlobalArgs;
use super::text::count;
use cluster::{Dask, Layer, Limits, Strands};
use engine::strands::Plan;
use serde_json::json;

/// Dask holds as many tasks as its scheduler has memory for: some kilobytes each.
pub(super) const UNLIMITED: Limits = Limits {
    most_elements: 100_000,
    most_jobs: 1_000_000,
};

/// Sends what is left of a plan.
pub(super) fn submit(
    address: &str,
    (name, plan): (&str, &Plan),
    layers: &[Layer],
    cpus: usize,
    global: &GlobalArgs,
) -> Result<(), Fault> {
    let tasks = cluster::tasks(global.program().name, name, plan, layers);
    let cache = std::path::absolute(&global.cache).map_err(Fault::input)?;
    let program = itself::program(global)?;
    let cpus = cpus.max(1).to_string();
    let text = |path: &std::path::Path| path.to_string_lossy().into_owned();
    let mut command = vec![
        text(&program),
        "cluster".into(),
        "work".into(),
        "--plan".into(),
        name.into(),
    ];
    let rest = [
        "--strand",
        "{strands}",
        "--threads",
        &cpus,
        "--quiet",
        "--cache",
    ];
    command.extend(rest.map(str::to_owned));
    command.push(text(&cache));
    command.extend(super::shared::words(global)?);
    let sent = match tasks.is_empty() {
        true => 0,
        false => dask(address, name, global)
            .submit(&tasks, &command)
            .map_err(Fault::input)?,
    };
    match global.json {
        true => crate::outln!(
            "{}",
            json!({ "plan": name, "tasks": tasks.len(), "sent": sent })
        ),
        false if tasks.is_empty() => crate::outln!("all strands are done; nothing was sent"),
        false => crate::outln!(
            "{sent} tasks sent, {} were there already; `{} status {} --engine dask={address}` shows how far it is",
            tasks.len() as u64 - sent,
            global.program().name,
            &name[..12]
        ),
    }
    Ok(())
}

/// How many strands are done of how many, and what Dask reports of its tasks where some are missing.
pub(super) fn status(
    address: &str,
    name: &str,
    strands: Strands,
    asked: &str,
    global: &GlobalArgs,
) -> Result<(), Fault> {
    let of = strands.done.len();
    let states = match strands.done_in(0..of) == of {
        true => vec![],
        false => dask(address, name, global).states().map_err(Fault::input)?,
    };
    let ended = ["memory", "erred", "released", "forgotten"];
    let alive: u64 = states
        .iter()
        .filter(|(s, _)| !ended.contains(&s.as_str()))
        .map(|(_, n)| n)
        .sum();
    // What ended while Dask was asked is done by now.
    let strands = match alive {
        0 => known(asked, global)?.strands,
        _ => strands,
    };
    let done = strands.done_in(0..of);
    match global.json {
        true => {
            let states: serde_json::Map<_, _> =
                states.iter().map(|(s, n)| (s.clone(), json!(n))).collect();
            crate::outln!(
                "{}",
                json!({ "plan": name, "done": done == of, "strands": of, "strands_done": done,
                    "alive": alive, "tasks": states })
            );
        }
        false => {
            let reported: Vec<String> = states
                .iter()
                .map(|(state, n)| format!("{n} {state}"))
                .collect();
            let reported = if reported.is_empty() {
                String::new()
            } else {
                format!("; tasks: {}", reported.join(", "))
            };
            crate::outln!("{done} of {} done{reported}", count(of, "strand"));
        }
    }
    match done == of || alive > 0 {
        true => Ok(()),
        false if global.json => Err(Fault::stage("")),
        false => Err(Fault::stage(format!(
            "strands are missing, and nothing works on them: submit {} again",
            &name[..12]
        ))),
    }
}

/// Lets go of what is not done.
pub(super) fn cancel(address: &str, name: &str, global: &GlobalArgs) -> Result<(), Fault> {
    let count = dask(address, name, global).cancel().map_err(Fault::input)?;
    match global.json {
        true => crate::outln!("{}", json!({ "plan": name, "cancelled": count })),
        false => crate::outln!(
            "{count} tasks were cancelled; what is done stays, what runs on a worker goes on to its end"
        ),
    }
    Ok(())
}

fn dask<'a>(address: &'a str, plan: &'a str, global: &GlobalArgs) -> Dask<'a> {
    let program = global.program().name;
    let name = format!("{program}-dask");
    let adapter = itself::beside(&name).unwrap_or_else(|| name.into());
    Dask {
        adapter,
        address,
        program,
        plan,
    }
}
