//! What happens in a story without anybody of ours doing it.

use super::disk::{lose_power, written};
use super::forge;
use super::oracle;
use super::programs::program;
use super::server::spoilt;
use super::story::{Use, What};
use super::world::{World, day};
use crate::permission;
use crate::store::{Step, below};
use std::path::Path;
use std::sync::atomic::Ordering;
use std::time::Duration;
use system::clock::simulated;

/// One of these things; what came of it.
pub(super) fn happens(world: &World, m: usize, what: &What) -> String {
    let machine = &world.machines[m];
    let known = || machine.known.borrow_mut();
    match what {
        What::Full(full) => {
            machine.full.set(*full);
            known().was_full |= *full;
            known().harmed |= *full;
        }
        What::Cut(cut) => {
            machine.cut.set(*cut);
            world.server.harmed.store(true, Ordering::Relaxed);
        }
        What::Time { s } => _ = simulated::pass(Duration::from_secs(*s)),
        What::Clock { s } => machine.ahead_s.set(machine.ahead_s.get() + s),
        What::PowerLoss(_) if machine.active.get() > 1 => return "not now".into(),
        What::PowerLoss(seed) => {
            let safe = oracle::safe(machine);
            lose_power(&machine.root, &machine.steps, *seed);
            oracle::outlived(world, machine, &safe);
            known().lost();
        }
        What::Spoil { file, how } => return spoil(world, m, *file, *how),
        What::SpoilThere { object, how } => spoil_there(world, *object, *how),
        What::FalseAnswers { count, how } => {
            world.server.false_answers.store(*count, Ordering::Relaxed);
            world.server.how.store(*how, Ordering::Relaxed);
            world.server.harmed.store(true, Ordering::Relaxed);
        }
        What::Sign => {
            if !matches!(machine.uses.get(), Use::Alone) {
                machine.uses.set(Use::Strict);
            }
        }
        What::NewKey { days } => {
            let today = simulated::time().map_or(0, |time| day(time.wall_ns));
            world.new_key(m, Some(today + days));
        }
        What::Edit { capture } => machine.edit(*capture),
        What::Forge {
            capture,
            n,
            node,
            signed,
        } => {
            let done = forge::forge(world, m, (*capture, *n, *node), *signed);
            return format!("{}", done.is_some());
        }
        other => return permission(world, m, other),
    }
    "so".into()
}

/// What the user allows, and what other users would like to.
fn permission(world: &World, m: usize, what: &What) -> String {
    let machine = &world.machines[m];
    let (number, allow) = match what {
        What::Allow { program } => (*program, true),
        What::Revoke { program } | What::Plant { program } => (*program, false),
        _ => (0, false),
    };
    let graph = program(number);
    let nodes = crate::walk::all(&graph, &graph.goal);
    if allow {
        let allowed = permission::allow(&graph, &nodes);
        if allowed.is_ok() {
            let mut known = machine.known.borrow_mut();
            known.granted.insert(number);
            *known.grants.entry(number).or_default() += 1;
        }
        return format!("{}", allowed.is_ok());
    }
    let (_, asked) = permission::programs(&graph, &nodes)
        .next()
        .expect("a program");
    let name = asked.permission().to_hex();
    let folder = permission::permissions(asked).expect("a folder");
    match what {
        What::Revoke { .. } => {
            let _ = std::fs::remove_file(folder.join(name.as_str()));
            machine.known.borrow_mut().granted.remove(&number);
        }
        What::Plant { .. } => {
            let folder = machine.root.join("allowed");
            let _ = std::fs::create_dir_all(&folder);
            let _ = std::fs::write(folder.join(name.as_str()), "yes");
        }
        _ => loosen(world, m, &folder),
    }
    "so".into()
}

/// Lets anybody write where permissions are: they count no longer.
fn loosen(world: &World, m: usize, folder: &Path) {
    #[cfg(unix)]
    if folder.is_dir() {
        let mode = std::os::unix::fs::PermissionsExt::from_mode(0o777);
        std::fs::set_permissions(folder, mode).expect("modes");
        world.machines[m].known.borrow_mut().granted.clear();
    }
}

/// A file of a machine's store goes, is cut short or gets another bit.
fn spoil(world: &World, m: usize, file: u64, how: u64) -> String {
    let machine = &world.machines[m];
    let named = |path: &std::path::PathBuf| {
        let name = path.file_name().and_then(|name| name.to_str());
        let written = ["tmp", "exec"].map(|folder| path.starts_with(machine.root.join(folder)));
        let written = machine.active.get() > 1 && written.contains(&true);
        let lock = path.starts_with(machine.root.join("lease"));
        !matches!(name, Some("format" | "in-use")) && !lock && !written
    };
    let all: Vec<_> = below(&machine.root).into_iter().filter(named).collect();
    // Names of runs and of what is being written differ each time: chosen by their place.
    let Some(path) = all.get(file as usize % all.len().max(1)) else {
        return "nothing there".into();
    };
    let bytes = std::fs::read(path).unwrap_or_default();
    let mut steps = machine.steps.lock().expect("one thread");
    let _ = std::fs::remove_file(path);
    steps.push(Step::Remove(path.clone()));
    if let Some(bytes) = spoilt(&bytes, how) {
        std::fs::write(path, &bytes).expect("a file");
        steps.extend(written(path, &bytes));
    }
    machine.known.borrow_mut().lost();
    "so".into()
}

fn spoil_there(world: &World, object: u64, how: u64) {
    let mut objects = world.server.objects.lock().expect("one thread");
    let names: Vec<String> = objects.keys().filter(|n| *n != "format").cloned().collect();
    if names.is_empty() {
        return;
    }
    world.server.harmed.store(true, Ordering::Relaxed);
    let name = &names[object as usize % names.len()];
    let (bytes, at) = objects[name].clone();
    match spoilt(&bytes, how) {
        Some(bytes) => _ = objects.insert(name.clone(), (bytes, at)),
        None => _ = objects.remove(name),
    }
}
