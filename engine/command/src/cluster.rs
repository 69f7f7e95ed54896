//! `submit`, `status` and `cancel`: a plan on Slurm, fire and forget.

use super::dask;
use super::fault::Fault;
use super::itself;
use super::known::{Known, known, past};
use super::program::GlobalArgs;
use super::text::count;
use clap::Args;
use cluster::{Layer, Limits, Packing, Sent, Slurm, Strands, Wish};
use engine::lasttime::History;
use engine::past::Of;
use engine::store::Store;
use engine::strands::Plan;
use serde_json::json;
use std::collections::BTreeMap;
use std::path::PathBuf;

/// Who carries the work.
#[derive(Clone, Debug, PartialEq)]
enum Engine {
    Slurm,
    /// With the scheduler's address.
    Dask(String),
}

fn engine(text: &str) -> Result<Engine, String> {
    match text.split_once('=') {
        None if text == "slurm" => Ok(Engine::Slurm),
        Some(("dask", address)) if !address.is_empty() => Ok(Engine::Dask(address.to_owned())),
        _ => Err("give slurm, or dask=ADDRESS, such as dask=tcp://127.0.0.1:8786".into()),
    }
}

/// Arguments of `submit`.
#[derive(Args)]
pub(crate) struct Submit {
    /// The plan that `--strands` named, or its first digits
    plan: String,
    /// Who carries the work: slurm, or dask=ADDRESS
    #[arg(long, value_parser = engine)]
    engine: Engine,
    /// The partition
    #[arg(long)]
    partition: Option<String>,
    /// Cores of an element
    #[arg(long, default_value_t = 1)]
    cpus: usize,
    /// Memory of an element: 4G
    #[arg(long)]
    mem: Option<String>,
    /// How long an element may take: 2:00:00
    #[arg(long)]
    time: Option<String>,
    /// An element should work at least so long; short strands are packed (seconds)
    #[arg(long, default_value_t = 60.0)]
    least_s: f64,
    /// A word more for sbatch, such as --sbatch=--account=lab
    #[arg(long)]
    sbatch: Vec<String>,
    /// Where elements write their output; nowhere by default
    #[arg(long)]
    logs: Option<PathBuf>,
}

/// Arguments of `status` and `cancel`.
#[derive(Args)]
pub(crate) struct Asked {
    /// The plan that was submitted, or its first digits
    plan: String,
    /// Who carries the work: slurm, or dask=ADDRESS
    #[arg(long, default_value = "slurm", value_parser = engine)]
    engine: Engine,
}

/// `submit`: sends what is neither done nor sent. A second `submit` sends nothing twice.
pub(crate) fn submit(args: &Submit, global: &GlobalArgs) -> Result<(), Fault> {
    let Known {
        name,
        plan,
        strands,
    } = known(&args.plan, global)?;
    let limits = match &args.engine {
        Engine::Slurm => Limits::of_site().map_err(Fault::input)?,
        Engine::Dask(_) => dask::UNLIMITED,
    };
    let layers = cut(&plan, &strands, args, limits, global)?;
    if let Engine::Dask(address) = &args.engine {
        return dask::submit(address, (&name, &plan), &layers, args.cpus, global);
    }
    let slurm = Slurm {
        program: global.program().name,
        name: &name,
        plan: &plan,
    };
    let wish = wish(args, global)?;
    let jobs = slurm.sent().map_err(Fault::input)?;
    let alive = jobs.iter().filter(|job| job.is_alive());
    let alive: BTreeMap<usize, String> = alive.map(|job| (job.layer, job.id.clone())).collect();
    let past = past(&slurm, &jobs, &layers);
    let mut sent = Vec::new();
    let mut below: Option<(&Layer, String, bool)> = None;
    for layer in &layers {
        let at = plan.strands[layer.strands.start].layer;
        let (id, fresh) = match alive.get(&at) {
            Some(id) => (id.clone(), false),
            None => {
                let fresh = below.as_ref().is_none_or(|b| b.2);
                let under = below.as_ref().map(|(layer, id, _)| (*layer, id.as_str()));
                let after = slurm.after(layer, under, fresh);
                let wish = Wish {
                    mem: cluster::more_memory(&past, at, wish.mem.as_deref()),
                    ..wish.clone()
                };
                let id = slurm.send(layer, after.as_deref(), &wish);
                (id.map_err(Fault::input)?, true)
            }
        };
        if !global.json && !global.quiet {
            let (elements, strands) = (layer.elements.len(), layer.strands.len());
            let how = if fresh { "sent" } else { "is there already" };
            let (elements, strands) = (count(elements, "element"), count(strands, "strand"));
            crate::outln!("layer {at}: job {id} {how}: {elements} for {strands}");
        }
        sent.push(json!({
            "layer": at, "job": id, "sent": fresh, "elements": layer.elements.len(),
            "pack": layer.pack, "seconds": layer.seconds,
        }));
        below = Some((layer, id, fresh));
    }
    match global.json {
        true => crate::outln!("{}", json!({ "plan": name, "layers": sent })),
        false if layers.is_empty() => crate::outln!("all strands are done; nothing was sent"),
        false => {
            let program = global.program().name;
            crate::outln!(
                "{program} cluster status {} shows how far it is",
                &name[..12]
            );
        }
    }
    Ok(())
}

/// The layers that have something to do, packed by how long nodes took the last time.
fn cut(
    plan: &Plan,
    strands: &Strands,
    args: &Submit,
    limits: Limits,
    global: &GlobalArgs,
) -> Result<Vec<Layer>, Fault> {
    let history = History::of(&global.cache, Of::default());
    let mut took: BTreeMap<&str, Option<f64>> = BTreeMap::new();
    for node in plan.strands.iter().flat_map(|s| &s.nodes) {
        let last = || history.last(node).map(|line| line.seconds);
        took.entry(node).or_insert_with(last);
    }
    let seconds = |strand: usize| {
        let nodes = plan.strands[strand].nodes.iter();
        nodes.map(|node| took[node.as_str()]).sum::<Option<f64>>()
    };
    let packing = Packing {
        most_elements: limits.most_elements,
        most_jobs: limits.most_jobs,
        least_seconds: args.least_s,
    };
    Ok(cluster::layers(plan, &strands.done, packing, &seconds))
}

fn wish(args: &Submit, global: &GlobalArgs) -> Result<Wish, Fault> {
    let whole = |path: &PathBuf| std::path::absolute(path).map_err(Fault::input);
    let logs = match &args.logs {
        // Slurm writes there itself, and reports nothing where it cannot.
        Some(folder) => {
            std::fs::create_dir_all(folder)
                .map_err(|e| Fault::input(format!("--logs {}: {e}", folder.display())))?;
            Some(whole(folder)?)
        }
        None => None,
    };
    Ok(Wish {
        partition: args.partition.clone(),
        cpus: args.cpus,
        mem: args.mem.clone(),
        time: args.time.clone(),
        more: args.sbatch.clone(),
        logs,
        program: itself::program(global)?,
        cache: whole(&global.cache)?,
        flags: super::shared::words(global)?,
    })
}

/// `status`: what is done by the store; Slurm is asked once to explain what is missing.
pub(crate) fn status(asked: &Asked, global: &GlobalArgs) -> Result<(), Fault> {
    let Known {
        name,
        plan,
        strands,
    } = known(&asked.plan, global)?;
    if let Engine::Dask(address) = &asked.engine {
        return dask::status(address, &name, strands, &asked.plan, global);
    }
    let left = strands.done.iter().any(|done| !done);
    let slurm = Slurm {
        program: global.program().name,
        name: &name,
        plan: &plan,
    };
    let sent = match left {
        true => slurm.sent().map_err(Fault::input)?,
        false => vec![],
    };
    let sent = match left && sent.is_empty() {
        true => slurm.remembered(),
        false => sent,
    };
    // What ended while Slurm was asked is done by now.
    let strands = match left && !sent.iter().any(Sent::is_alive) {
        true => known(&name, global)?.strands,
        false => strands,
    };
    let left = strands.done.iter().any(|done| !done);
    let mut layers = Vec::new();
    for at in 0..plan.layers() {
        let all = plan.layer(at);
        let (of, done) = (all.len(), strands.done_in(all));
        let mut states: BTreeMap<String, usize> = BTreeMap::new();
        for sent in sent
            .iter()
            .filter(|s| s.layer == at && s.state != "COMPLETED")
        {
            let why = match sent.reason.as_str() {
                "" | "None" => sent.state.clone(),
                reason => format!("{} ({reason})", sent.state),
            };
            *states.entry(why).or_default() += 1;
        }
        if !global.json {
            let reported: Vec<String> = states.iter().map(|(s, n)| format!("{n} {s}")).collect();
            let reported = match reported.is_empty() || done == of {
                true => String::new(),
                false => format!("; elements: {}", reported.join(", ")),
            };
            crate::outln!(
                "layer {at}: {done} of {} done{reported}",
                count(of, "strand")
            );
        }
        layers.push(json!({ "layer": at, "strands": of, "done": done, "elements": states }));
    }
    let alive = sent.iter().filter(|s| s.is_alive()).count();
    if global.json {
        crate::outln!(
            "{}",
            json!({ "plan": name, "done": !left, "alive": alive, "layers": layers })
        );
    }
    match (left, alive) {
        (false, _) | (true, 1..) => Ok(()),
        (true, 0) => Err(Fault::stage(match global.json {
            true => String::new(),
            false => format!(
                "strands are missing, and nothing works on them: submit {} again (what ran out of memory gets half as much again; what ran out of time: with more --time)",
                &name[..12]
            ),
        })),
    }
}

/// `cancel`: ends what is alive; what is done stays.
pub(crate) fn cancel(asked: &Asked, global: &GlobalArgs) -> Result<(), Fault> {
    let store = Store::open(&global.cache).map_err(Fault::input)?;
    let (name, plan) = Plan::read(&store, &asked.plan).map_err(Fault::plan)?;
    if let Engine::Dask(address) = &asked.engine {
        return dask::cancel(address, &name, global);
    }
    let slurm = Slurm {
        program: global.program().name,
        name: &name,
        plan: &plan,
    };
    let jobs = slurm.cancel().map_err(Fault::input)?;
    match global.json {
        true => crate::outln!("{}", json!({ "plan": name, "cancelled": jobs })),
        false => crate::outln!("{} cancelled; what is done stays", count(jobs, "job")),
    }
    Ok(())
}
