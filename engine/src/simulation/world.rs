//! The world of a story: machines, the store that they share, time, and who acts while somebody else does.

use super::acts;
use super::disk::Steps;
use super::mishaps;
use super::oracle::{self, Known};
use super::process::{Killed, Process, hush};
use super::server::Server;
use super::story::{Act, CAPTURES, Setup, Story};
use crate::clock::simulated::{self, Time};
use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;
use std::io::{Error, ErrorKind, Result};
use std::panic::AssertUnwindSafe;
use std::path::PathBuf;
use std::rc::Rc;
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Duration;

/// A machine.
pub(super) struct Machine {
    pub(super) setup: Setup,
    pub(super) root: PathBuf,
    pub(super) state: PathBuf,
    pub(super) captures: Vec<PathBuf>,
    pub(super) steps: Steps,
    pub(super) ahead_s: Cell<i64>,
    pub(super) full: Cell<bool>,
    pub(super) cut: Cell<bool>,
    /// Processes that are alive on it.
    pub(super) active: Cell<usize>,
    /// How many of them run stages just now, and how many sweep.
    pub(super) working: Cell<usize>,
    pub(super) sweeping: Cell<usize>,
    pub(super) known: RefCell<Known>,
}

/// The world of a story.
pub(super) struct World {
    pub(super) machines: Vec<Machine>,
    pub(super) server: Arc<Server>,
    /// Whether somebody put results of their own into the shared store.
    pub(super) forged: Cell<bool>,
    /// Objects of the shared store that a machine forgot, and nobody made since.
    pub(super) forgotten_there: RefCell<BTreeMap<String, usize>>,
    late: bool,
    log: RefCell<Vec<String>>,
    broken: RefCell<Option<String>>,
    pub(super) place: tempfile::TempDir,
}

thread_local! {
    static WORLD: RefCell<Option<Rc<World>>> = const { RefCell::new(None) };
    static PROCESSES: RefCell<Vec<Arc<Process>>> = const { RefCell::new(Vec::new()) };
}

fn world() -> Option<Rc<World>> {
    WORLD.with_borrow(Clone::clone)
}

/// Tells a story: what happened, and what did not hold.
pub(super) fn told(story: &Story) -> (Vec<String>, Option<String>) {
    hush();
    let world = Rc::new(World::new(story));
    WORLD.set(Some(world.clone()));
    for act in &story.acts {
        world.perform(act, 0);
        if world.broken.borrow().is_some() {
            break;
        }
    }
    if world.broken.borrow().is_none() {
        oracle::end(&world);
    }
    WORLD.set(None);
    simulated::set(None);
    let broken = world.broken.take();
    (world.log.take(), broken)
}

impl World {
    fn new(story: &Story) -> World {
        let memory = std::path::Path::new("/dev/shm");
        let place = match memory.is_dir() {
            true => tempfile::tempdir_in(memory),
            false => tempfile::tempdir(),
        };
        let place = place.expect("a folder");
        let machine = |(i, setup): (usize, &Setup)| {
            let at = place.path().join(format!("machine-{i}"));
            let captures = (0..CAPTURES).map(|c| at.join(format!("needle-name-{c}-")));
            let machine = Machine {
                setup: setup.clone(),
                root: at.join("cache"),
                state: at.join("state"),
                captures: captures.collect(),
                steps: Steps::default(),
                ahead_s: Cell::new(setup.ahead_s),
                full: Cell::new(false),
                cut: Cell::new(false),
                active: Cell::new(0),
                working: Cell::new(0),
                sweeping: Cell::new(0),
                known: RefCell::default(),
            };
            std::fs::create_dir_all(&machine.root).expect("a folder");
            for (c, capture) in machine.captures.iter().enumerate() {
                mishaps::photos(capture, c);
            }
            machine
        };
        let machines = story.machines.iter().enumerate().map(machine).collect();
        let world = World {
            machines,
            server: Arc::new(Server::new(story.honest)),
            forged: Cell::new(false),
            forgotten_there: RefCell::default(),
            late: story.late,
            log: RefCell::default(),
            broken: RefCell::default(),
            place,
        };
        world.enter(0, Duration::ZERO);
        world
    }

    /// From now on it is that machine's clock that counts.
    fn enter(&self, machine: usize, passed: Duration) {
        // Far from when the files of this test are made: before, or after.
        let begin_s: i128 = if self.late {
            4_000_000_000
        } else {
            1_000_000_000
        };
        let machine = &self.machines[machine];
        let drift = passed.as_nanos() as i128 * i128::from(machine.setup.drift) / 1_000_000;
        let ahead_s = i128::from(machine.ahead_s.get());
        let wall_ns = (begin_s + ahead_s) * 1_000_000_000 + passed.as_nanos() as i128 + drift;
        simulated::set(Some(Time { wall_ns, passed }));
    }

    /// How much time has passed.
    pub(super) fn passed(&self) -> Duration {
        simulated::time().map_or(Duration::ZERO, |time| time.passed)
    }

    /// Somebody does something, while others are in the middle of what they do.
    fn perform(&self, act: &Act, depth: usize) {
        let machine = &self.machines[act.machine];
        self.enter(act.machine, self.passed());
        let process = Process::new(act, depth);
        machine.known.borrow_mut().harmed |= act.fail.is_some();
        let before = [&machine.active, &machine.working, &machine.sweeping].map(Cell::get);
        machine.active.set(before[0] + 1);
        PROCESSES.with_borrow_mut(|all| all.push(process.clone()));
        let done = std::panic::catch_unwind(AssertUnwindSafe(|| acts::act(self, act, &process)));
        PROCESSES.with_borrow_mut(|all| all.pop());
        machine.active.set(before[0]);
        machine.working.set(before[1]);
        machine.sweeping.set(before[2]);
        let came = match done {
            Ok(came) => came,
            Err(ended) if ended.is::<Killed>() => "killed".to_owned(),
            Err(ended) => {
                let text = ended.downcast_ref::<String>().cloned();
                let text = text.or_else(|| ended.downcast_ref::<&str>().map(|t| (*t).to_owned()));
                self.broken(&format!("a panic: {}", text.unwrap_or_default()));
                "panicked".to_owned()
            }
        };
        let steps = process.steps.load(Ordering::Relaxed);
        let (indent, what) = ("  ".repeat(depth), &act.what);
        self.note(format!(
            "{indent}{} {what:?}: {came}, {steps} steps",
            act.machine
        ));
    }

    fn note(&self, line: String) {
        // The folder of a story has another name each time.
        let place = self.place.path().display().to_string();
        self.log.borrow_mut().push(line.replace(&place, ""));
    }

    /// Something does not hold.
    pub(super) fn broken(&self, what: &str) {
        self.note(format!("BROKEN: {what}"));
        let place = self.place.path().display().to_string();
        self.broken
            .borrow_mut()
            .get_or_insert(what.replace(&place, ""));
    }
}

/// One step of a process: time passes, others act, it is killed, or the step fails.
pub(super) fn step(process: &Arc<Process>, grows: bool) -> Result<()> {
    if std::thread::panicking() {
        return Err(Error::other("ended"));
    }
    if process.dead.load(Ordering::Relaxed) {
        std::panic::panic_any(Killed);
    }
    let number = process.steps.fetch_add(1, Ordering::Relaxed);
    simulated::pass(Duration::from_millis(1));
    let world = world().expect("a story is told");
    meanwhile(&world, process, number);
    if process.kill == Some(number) {
        process.dead.store(true, Ordering::Relaxed);
        std::panic::panic_any(Killed);
    }
    let full = grows && world.machines[process.machine].full.get();
    match full || process.fail == Some(number) {
        true => Err(Error::from(ErrorKind::StorageFull)),
        false => Ok(()),
    }
}

/// What others do before a step.
fn meanwhile(world: &World, process: &Arc<Process>, number: u32) {
    loop {
        let next = {
            let mut beside = process.beside.lock().expect("one thread");
            match beside.last() {
                Some((at, _)) if *at <= number => beside.pop(),
                _ => None,
            }
        };
        let Some((_, act)) = next else { return };
        world.perform(&act, process.depth + 1);
        world.enter(process.machine, world.passed());
    }
}

thread_local! {
    static QUIET: Cell<bool> = const { Cell::new(false) };
}

/// As long as it is there, stages run outside of the story.
pub(super) struct Quiet(bool);

pub(super) fn quiet() -> Quiet {
    Quiet(QUIET.replace(true))
}

impl Drop for Quiet {
    fn drop(&mut self) {
        QUIET.set(self.0);
    }
}

/// A stage works: time passes, and others may act.
pub(super) fn works(stage: &str, takes_s: u32, text: &[u8]) {
    if QUIET.get() {
        return;
    }
    let Some(world) = world() else { return };
    let process = PROCESSES.with_borrow(|all| all.last().cloned());
    let Some(process) = process else { return };
    let machine = &world.machines[process.machine];
    let what = format!("{stage} {}", blake3::hash(text).to_hex());
    // Who cannot make the file of a lease works without one.
    let unsure = PROCESSES.with_borrow(|all| all.iter().any(|p| p.fail.is_some()));
    let twice = !machine.known.borrow_mut().making.insert(what.clone());
    if twice && !unsure && !machine.known.borrow().was_full {
        world.broken(&format!("{stage} is made twice at a time"));
    }
    machine.working.set(machine.working.get() + 1);
    simulated::pass(Duration::from_secs(takes_s.into()));
    let number = process.steps.fetch_add(1, Ordering::Relaxed);
    meanwhile(&world, &process, number);
    machine.working.set(machine.working.get() - 1);
    machine.known.borrow_mut().making.remove(&what);
    if process.kill == Some(number) {
        process.dead.store(true, Ordering::Relaxed);
    }
}

/// How much time has passed, if a process's network is not cut.
pub(super) fn passed(process: &Process) -> Option<Duration> {
    let world = world()?;
    (!world.machines[process.machine].cut.get()).then(|| world.passed())
}
