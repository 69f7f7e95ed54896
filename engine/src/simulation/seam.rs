//! Where the simulated disk, the shared store and the stages reach the story that they are part of.

use super::process::Process;
use std::cell::{Cell, RefCell};
use std::io::{Error, Result};
use std::rc::Rc;
use std::sync::Arc;
use std::time::Duration;

/// A story that goes on.
pub(super) trait Around {
    /// One step of a process: time passes, other processes act, it is killed, or the step fails.
    fn step(&self, process: &Arc<Process>, grows: bool) -> Result<()>;
    /// A stage works: time passes, and other processes may act; whether its process is alive.
    fn works(&self, stage: &str, takes_s: u32, text: &[u8]) -> bool;
    /// A key signs something.
    fn signs(&self, key: &[u8; 32]);
    /// Something is believed for what a key signed.
    fn believes(&self, key: &[u8; 32]);
    /// How much time has passed, if a process's network is not cut.
    fn passed(&self, process: &Process) -> Option<Duration>;
}

thread_local! {
    static AROUND: RefCell<Option<Rc<dyn Around>>> = const { RefCell::new(None) };
    static QUIET: Cell<bool> = const { Cell::new(false) };
}

/// From now on this story goes on, or none.
pub(super) fn set(around: Option<Rc<dyn Around>>) {
    AROUND.set(around);
}

fn around() -> Option<Rc<dyn Around>> {
    AROUND.with_borrow(Clone::clone)
}

/// [`Around::step`] of the story that goes on.
pub(super) fn step(process: &Arc<Process>, grows: bool) -> Result<()> {
    if std::thread::panicking() {
        return Err(Error::other("ended"));
    }
    around().expect("a story goes on").step(process, grows)
}

/// [`Around::works`] of the story that goes on, if one does.
pub(super) fn works(stage: &str, takes_s: u32, text: &[u8]) -> bool {
    let around = around().filter(|_| !QUIET.get());
    around.is_none_or(|around| around.works(stage, takes_s, text))
}

/// [`Around::signs`] of the story that goes on.
pub(super) fn signed(key: &[u8; 32]) {
    if let Some(around) = around() {
        around.signs(key);
    }
}

/// [`Around::believes`] of the story that goes on.
pub(super) fn believed(key: &[u8; 32]) {
    if let Some(around) = around() {
        around.believes(key);
    }
}

/// [`Around::passed`] of the story that goes on.
pub(super) fn passed(process: &Process) -> Option<Duration> {
    around()?.passed(process)
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
