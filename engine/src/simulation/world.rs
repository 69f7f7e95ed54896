//! The world of a story: machines, the store that they share, time, and who acts while somebody else does.

use super::captures::photos;
use super::disk::Steps;
use super::gone::Gone;
use super::known::Known;
use super::process::{Killed, Process};
use super::seam::Around;
use super::server::Server;
use super::story::{Act, CAPTURES, Setup, Story, Use};
use crate::clock::simulated::{self, Time};
use std::cell::{Cell, RefCell};
use std::io::{Error, ErrorKind, Result};
use std::panic::AssertUnwindSafe;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Duration;

/// What a stage or a program does takes as long as so many steps of a disk: most who are killed are killed at work.
const WORK_STEPS: u32 = 10;

/// A machine.
pub(super) struct Machine {
    pub(super) setup: Setup,
    pub(super) uses: Cell<Use>,
    /// How often it began to upload.
    pub(super) uploads: Cell<u32>,
    /// Whether it ever believed those whom nobody is to believe.
    pub(super) believed_all: Cell<bool>,
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

/// A plan that a machine made.
#[derive(Clone)]
pub(super) struct Planned {
    pub(super) name: String,
    pub(super) machine: usize,
    pub(super) capture: usize,
    pub(super) n: usize,
}

/// What does an act of a process, and says what came of it.
type Does = fn(&World, &Act, &Arc<Process>) -> String;

/// The world of a story.
pub(super) struct World {
    pub(super) machines: Vec<Machine>,
    pub(super) server: Arc<Server>,
    /// How often somebody put results of their own into the shared store.
    pub(super) forged: Cell<u32>,
    /// What was wanted last: of a capture, with a number.
    pub(super) wanted: Cell<(usize, usize)>,
    /// The plan whose strands are made.
    pub(super) plan: RefCell<Option<Planned>>,
    /// What of the shared store machines forgot, and nobody made since.
    pub(super) forgotten_there: RefCell<Vec<Gone>>,
    /// What does an act, and says what came of it.
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
                uses: Cell::new(setup.uses),
                uploads: Cell::new(0),
                believed_all: Cell::new(!matches!(setup.uses, Use::Alone | Use::Strict)),
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
                photos(capture, c);
            }
            machine
        };
        let machines = story.machines.iter().enumerate().map(machine).collect();
        let world = World {
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
        // Far from when the files of this test are made: before, or after.
        let begin_s: i128 = if self.late {
            4_000_000_000
        } else {
            1_000_000_000
        };
        let machine = &self.machines[machine];
        crate::permission::permissions_here(Some(machine.state.clone()));
        let drift = passed.as_nanos() as i128 * i128::from(machine.setup.drift) / 1_000_000;
        let ahead_s = i128::from(machine.ahead_s.get());
        let wall_ns = (begin_s + ahead_s) * 1_000_000_000 + passed.as_nanos() as i128 + drift;
        simulated::set(Some(Time { wall_ns, passed }));
    }

    /// How often others than a machine began to put something into the shared store.
    pub(super) fn put_by_others(&self, m: usize) -> u32 {
        let others = self
            .machines
            .iter()
            .enumerate()
            .filter(|(other, _)| *other != m);
        others.map(|(_, other)| other.uploads.get()).sum::<u32>() + self.forged.get()
    }

    /// How much time has passed.
    pub(super) fn passed(&self) -> Duration {
        simulated::time().map_or(Duration::ZERO, |time| time.passed)
    }

    /// Somebody does something, while others are in the middle of what they do.
    pub(super) fn perform(&self, act: &Act, depth: usize) {
        let machine = &self.machines[act.machine];
        self.enter(act.machine, self.passed());
        let process = Process::new(act, depth);
        machine.known.borrow_mut().harmed |= act.fail.is_some();
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
        let folder = self.machines[machine].captures[capture].clone();
        vec![("turn".to_owned(), folder)]
    }

    /// What others do before a step.
    fn meanwhile(&self, process: &Arc<Process>, number: u32) {
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

impl Around for World {
    fn step(&self, process: &Arc<Process>, grows: bool) -> Result<()> {
        if process.dead.load(Ordering::Relaxed) {
            std::panic::panic_any(Killed);
        }
        let number = process.steps.fetch_add(1, Ordering::Relaxed);
        simulated::pass(Duration::from_millis(1));
        self.meanwhile(process, number);
        if process.kill == Some(number) {
            process.dead.store(true, Ordering::Relaxed);
            std::panic::panic_any(Killed);
        }
        let full = grows && self.machines[process.machine].full.get();
        match full || process.fail == Some(number) {
            true => Err(Error::from(ErrorKind::StorageFull)),
            false => Ok(()),
        }
    }

    fn works(&self, stage: &str, takes_s: u32, text: &[u8]) -> bool {
        let process = PROCESSES.with_borrow(|all| all.last().cloned());
        let Some(process) = process else { return true };
        let machine = &self.machines[process.machine];
        let what = format!("{stage} {}", blake3::hash(text).to_hex());
        // Who cannot make the file of a lease works without one.
        let unsure = PROCESSES.with_borrow(|all| all.iter().any(|p| p.fail.is_some()));
        let twice = !machine.known.borrow_mut().making.insert(what.clone());
        if twice && !unsure && !machine.known.borrow().was_full {
            self.broken(&format!("{stage} is made twice at a time"));
        }
        machine.working.set(machine.working.get() + 1);
        simulated::pass(Duration::from_secs(takes_s.into()));
        let begins = process.steps.fetch_add(WORK_STEPS, Ordering::Relaxed);
        let steps = begins..begins + WORK_STEPS;
        self.meanwhile(&process, steps.end - 1);
        machine.working.set(machine.working.get() - 1);
        machine.known.borrow_mut().making.remove(&what);
        if process.kill.is_some_and(|kill| steps.contains(&kill)) {
            process.dead.store(true, Ordering::Relaxed);
        }
        !process.dead.load(Ordering::Relaxed)
    }

    fn passed(&self, process: &Process) -> Option<Duration> {
        (!self.machines[process.machine].cut.get()).then(|| World::passed(self))
    }
}
