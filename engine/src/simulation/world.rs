//! The world of a story: machines, the store that they share, time, and who acts while somebody else does.

use super::gone::Gone;
use super::keys::Key;
use super::machine::Machine;
use super::process::{Killed, Process};
use super::server::Server;
use super::story::{Act, Setup, Story, Use, What};
use crate::store::in_memory;
use std::cell::{Cell, RefCell};
use std::panic::AssertUnwindSafe;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Duration;
use system::clock::simulated::{self, Time};

/// Of a day. \[ns\]
const DAY_NS: i128 = 86_400_000_000_000;

/// A plan that a machine made.
#[derive(Clone)]
pub(super) struct Planned {
    pub(super) name: String,
    pub(super) machine: usize,
    pub(super) capture: usize,
    pub(super) n: usize,
}

/// The first second of a story: far from when the files of this test are made: before, or after.
fn begin_s(late: bool) -> i128 {
    match late {
        true => 4_000_000_000,
        false => 1_000_000_000,
    }
}

/// The day of a time.
pub(super) fn day(wall_ns: i128) -> i64 {
    wall_ns.div_euclid(DAY_NS) as i64
}

/// Whether a stranger comes in it.
fn is_of_strangers(act: &Act) -> bool {
    let beside = act.beside.iter().any(|(_, act)| is_of_strangers(act));
    beside || matches!(act.what, What::Forge { .. })
}

/// Does an act of a process, and returns what came of it.
type Does = fn(&World, &Act, &Arc<Process>) -> String;

/// The world of a story.
pub(super) struct World {
    pub(super) machines: Vec<Machine>,
    /// So many are of the story, and one more may come at its end.
    pub(super) own: usize,
    pub(super) server: Arc<Server>,
    /// How often somebody put results of their own into the shared store.
    pub(super) forged: Cell<u32>,
    /// Whose turn it is to be looked at as a whole in the end.
    pub(super) turn: usize,
    /// A stranger's key.
    pub(super) strange: Key,
    /// How many keys machines have.
    pub(super) keys: Cell<usize>,
    /// What was wanted last: of a capture, with a number.
    pub(super) wanted: Cell<(usize, usize)>,
    /// The plan whose strands are made.
    pub(super) plan: RefCell<Option<Planned>>,
    /// What of the shared store machines forgot, and nobody made since.
    pub(super) forgotten_there: RefCell<Vec<Gone>>,
    /// Does an act, and returns what came of it.
    act: Does,
    late: bool,
    log: RefCell<Vec<String>>,
    broken: RefCell<Option<String>>,
    pub(super) place: tempfile::TempDir,
}

thread_local! {
    static PROCESSES: RefCell<Vec<Arc<Process>>> = const { RefCell::new(Vec::new()) };
}

impl World {
    /// As a story begins.
    pub(super) fn new(story: &Story, act: Does) -> World {
        let place = in_memory();
        let first = day(begin_s(story.late) * 1_000_000_000);
        let until = |days: Option<i64>| days.map(|days| first + days);
        let machine = |(i, setup): (usize, &Setup)| {
            let key = Key::of(&format!("machine {i}"), 0, until(setup.key_days));
            Machine::new(&place.path().join(format!("machine-{i}")), setup, key)
        };
        // At the end a newcomer takes what the machines signed.
        let newcomer = Setup {
            uses: Use::Strict,
            ahead_s: 0,
            drift: 0,
            key_days: None,
        };
        let strangers = story.acts.iter().any(is_of_strangers);
        let setups = story.machines.iter();
        let setups = setups.chain(strangers.then_some(&newcomer));
        let machines: Vec<Machine> = setups.enumerate().map(machine).collect();
        let world = World {
            own: story.machines.len(),
            keys: Cell::new(machines.len()),
            turn: story.turn,
            strange: Key::of("stranger", 0, until(story.strange_days)),
            machines,
            server: Arc::new(Server::new(story.honest)),
            forged: Cell::new(0),
            wanted: Cell::new((0, 0)),
            plan: RefCell::default(),
            forgotten_there: RefCell::default(),
            act,
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
        let machine = &self.machines[machine];
        crate::permission::permissions_here(Some(machine.state.clone()));
        let drift = passed.as_nanos() as i128 * i128::from(machine.setup.drift) / 1_000_000;
        let ahead_s = i128::from(machine.ahead_s.get());
        let wall_ns =
            (begin_s(self.late) + ahead_s) * 1_000_000_000 + passed.as_nanos() as i128 + drift;
        simulated::set(Some(Time { wall_ns, passed }));
    }

    /// A machine gets a new key, whose last day is that.
    pub(super) fn new_key(&self, m: usize, until: Option<i64>) {
        let mut keys = self.machines[m].keys.borrow_mut();
        let key = Key::of(&format!("machine {m}"), keys.len(), until);
        keys.push(key);
        self.keys.set(self.keys.get() + 1);
    }

    /// How often machines other than this one began to put something into the shared store.
    pub(super) fn put_elsewhere(&self, m: usize) -> u32 {
        let rest = self
            .machines
            .iter()
            .enumerate()
            .filter(|(other, _)| *other != m);
        rest.map(|(_, other)| other.uploads.get()).sum::<u32>() + self.forged.get()
    }

    /// How much time has passed.
    pub(super) fn passed(&self) -> Duration {
        simulated::time().map_or(Duration::ZERO, |time| time.passed)
    }

    /// What a process does outside of what happens.
    pub(super) fn as_process<T>(&self, process: &Arc<Process>, does: impl FnOnce() -> T) -> T {
        self.enter(process.machine, self.passed());
        PROCESSES.with_borrow_mut(|all| all.push(process.clone()));
        let done = does();
        PROCESSES.with_borrow_mut(|all| all.pop());
        done
    }

    /// Somebody does something, while other processes are in the middle of what they do.
    pub(super) fn perform(&self, act: &Act, depth: usize) {
        let machine = &self.machines[act.machine];
        self.enter(act.machine, self.passed());
        let process = Process::new(act, depth);
        machine.known.borrow_mut().harmed |= act.fail.is_some();
        machine.acted.set(true);
        let before = [&machine.active, &machine.working, &machine.sweeping].map(Cell::get);
        machine.active.set(before[0] + 1);
        PROCESSES.with_borrow_mut(|all| all.push(process.clone()));
        let done = std::panic::catch_unwind(AssertUnwindSafe(|| (self.act)(self, act, &process)));
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

    /// Whether something did not hold.
    pub(super) fn is_broken(&self) -> bool {
        self.broken.borrow().is_some()
    }

    /// What happened, and what did not hold.
    pub(super) fn ended(&self) -> (Vec<String>, Option<String>) {
        (self.log.take(), self.broken.take())
    }

    /// The input of a pipeline on a capture.
    pub(super) fn folders(&self, machine: usize, capture: usize) -> Vec<(String, PathBuf)> {
        let folder = self.machines[machine].capture(capture).to_owned();
        vec![("turn".to_owned(), folder)]
    }

    /// The process that acts just now.
    pub(super) fn acting() -> Option<Arc<Process>> {
        PROCESSES.with_borrow(|all| all.last().cloned())
    }

    /// Whether stages are run by a process that acts just now.
    pub(super) fn is_running() -> bool {
        PROCESSES.with_borrow(|all| all.iter().any(|p| p.runs))
    }

    /// Whether a step fails of a process that acts just now.
    pub(super) fn is_unsure() -> bool {
        PROCESSES.with_borrow(|all| all.iter().any(|p| p.fail.is_some()))
    }

    /// What other processes do before a step.
    pub(super) fn meanwhile(&self, process: &Arc<Process>, number: u32) {
        loop {
            let next = {
                let mut beside = process.beside.lock().expect("one thread");
                match beside.last() {
                    Some((at, _)) if *at <= number => beside.pop(),
                    _ => None,
                }
            };
            let Some((_, act)) = next else { return };
            self.perform(&act, process.depth + 1);
            self.enter(process.machine, self.passed());
        }
    }
}
