//! A process of a story: what happens to it, and how far it is.

use super::story::Act;
use crate::done::Watch;
use crate::session::Options;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::sync::{Arc, Mutex, Once};

/// What a process that is killed ends with.
pub(super) struct Killed;

/// A process: what happens to it, and how far it is.
pub(super) struct Process {
    pub(super) machine: usize,
    pub(super) depth: usize,
    /// Whether it runs stages.
    pub(super) runs: bool,
    pub(super) kill: Option<u32>,
    pub(super) fail: Option<u32>,
    pub(super) lost: Option<u32>,
    pub(super) beside: Mutex<Vec<(u32, Act)>>,
    pub(super) steps: AtomicU32,
    pub(super) dead: AtomicBool,
    /// Whether it believes a stranger.
    pub(super) believing: AtomicBool,
}

impl Process {
    pub(super) fn new(act: &Act, depth: usize) -> Arc<Process> {
        let mut beside = act.beside.clone();
        beside.reverse();
        Arc::new(Process {
            machine: act.machine,
            depth,
            runs: act.what.runs(),
            kill: act.kill,
            fail: act.fail,
            lost: act.lost,
            beside: Mutex::new(beside),
            steps: AtomicU32::new(0),
            dead: AtomicBool::new(false),
            believing: AtomicBool::new(false),
        })
    }

    /// One to whom nothing happens.
    pub(super) fn sound(machine: usize) -> Arc<Process> {
        Arc::new(Process {
            machine,
            depth: 9,
            runs: false,
            kill: None,
            fail: None,
            lost: None,
            beside: Mutex::default(),
            steps: AtomicU32::new(0),
            dead: AtomicBool::new(false),
            believing: AtomicBool::new(false),
        })
    }

    /// Whether its next step is its last, or fails.
    pub(super) fn ends_next(&self) -> bool {
        let next = Some(self.steps.load(Ordering::Relaxed));
        [self.kill, self.fail].contains(&next)
    }
}

/// A killed process prints nothing.
pub(super) fn hush() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        let usual = std::panic::take_hook();
        std::panic::set_hook(Box::new(move |info| {
            if !info.payload().is::<Killed>() {
                usual(info);
            }
        }));
    });
}

/// Gives up as soon as another process makes what is wanted.
#[derive(Default)]
pub(super) struct Hasty(pub(super) AtomicBool);

impl Watch for Hasty {
    fn waits(&self, _node: &str) {
        self.0.store(true, Ordering::Relaxed);
    }
}

/// How a process runs pipelines.
pub(super) fn options(root: &std::path::Path) -> Options {
    Options {
        cache: root.to_owned(),
        threads: None,
        keep_going: false,
    }
}
