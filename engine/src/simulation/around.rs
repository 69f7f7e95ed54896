//! What a story does around its processes: time passes with their steps, more of them act, they are killed, keys are used.

use super::process::{Killed, Process};
use super::seam::Around;
use super::world::{World, day};
use std::io::{Error, ErrorKind, Result};
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Duration;
use system::clock::simulated;

/// What a stage or a program does takes as long as so many steps of a disk: most who are killed are killed at work.
const WORK_STEPS: u32 = 10;

impl World {
    /// Whether the last day of a key is over, by the clock of who acts just now.
    fn is_over(&self, key: &[u8; 32]) -> bool {
        let today = simulated::time().map_or(0, |time| day(time.wall_ns));
        let machines = self.machines.iter();
        let keys = machines.flat_map(|machine| machine.keys.borrow().clone());
        let mut keys = keys.chain([self.strange.clone()]);
        let until = keys.find(|one| one.bytes == *key).and_then(|one| one.until);
        until.is_some_and(|until| today > until)
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
        let process = World::acting();
        let Some(process) = process else { return true };
        let machine = &self.machines[process.machine];
        let what = format!("{stage} {}", blake3::hash(text).to_hex());
        // Who cannot make the file of a lease works without one.
        let unsure = World::is_unsure();
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

    fn signs(&self, key: &[u8; 32]) {
        if self.strange.bytes != *key && self.is_over(key) {
            self.broken("somebody signs with a key whose last day is over");
        }
    }

    fn believes(&self, key: &[u8; 32]) {
        if self.is_over(key) {
            self.broken("a key is believed whose last day is over");
        }
        let Some(process) = World::acting().filter(|_| self.strange.bytes == *key) else {
            return;
        };
        match process.believing.load(Ordering::Relaxed) {
            true => self.machines[process.machine].believed_all.set(true),
            false => self.broken("a stranger is believed who is trusted no longer"),
        }
    }

    fn passed(&self, process: &Process) -> Option<Duration> {
        (!self.machines[process.machine].cut.get()).then(|| World::passed(self))
    }
}
