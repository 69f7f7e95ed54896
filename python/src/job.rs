//! A job on a thread of its own: Python hears of it, and can stop it.

use crate::fault::{bug, raised};
use command::{Fault, Host};
use engine::walk::{Done, Watch};
use pyo3::prelude::*;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

/// What happens: the event, the node, a label, how much of how many, seconds.
pub(crate) type Event = (&'static str, String, String, usize, usize, f64);

/// How often signals are looked at.
const LOOK: Duration = Duration::from_millis(50);
/// Progress within a node is reported no oftener than this.
const LEAST_APART: Duration = Duration::from_millis(50);

/// Hands on what a walk reports.
pub(crate) struct Listener {
    to: Sender<Event>,
    last: Mutex<Option<Instant>>,
}

impl Listener {
    /// Tells something. Nobody listens any more where the job's end is not awaited.
    pub(crate) fn report(&self, event: Event) {
        let _ = self.to.send(event);
    }
}

impl Watch for Listener {
    fn started(&self, node: &str) {
        self.report(("started", node.into(), String::new(), 0, 0, 0.0));
    }

    fn waits(&self, node: &str) {
        let what = "made by another process".to_owned();
        self.report(("waits", node.into(), what, 0, 0, 0.0));
    }

    fn progress(&self, node: &str, label: &str, done: usize, of: usize) {
        let Ok(mut last) = self.last.lock() else {
            return;
        };
        if done == of || last.is_none_or(|last| last.elapsed() > LEAST_APART) {
            *last = Some(Instant::now());
            self.report(("progress", node.into(), label.into(), done, of, 0.0));
        }
    }

    fn done(&self, node: &str, done: &Done) {
        let word = done.status.word();
        self.report((word, node.into(), String::new(), 1, 1, done.seconds));
    }
}

/// Runs a job to its end. `hear` gets each event; an exception out of it, or a signal whose handler raises
/// (Ctrl-C), stops the job as the command is stopped, and is raised when it has stopped.
pub(crate) fn run<T: Send + 'static>(
    py: Python<'_>,
    hear: Option<Py<PyAny>>,
    work: impl FnOnce(Host, Arc<Listener>) -> Result<T, Fault> + Send + 'static,
) -> PyResult<T> {
    let stop = Arc::new(AtomicBool::new(false));
    let (to, events) = channel();
    let last = Mutex::default();
    let listener = Arc::new(Listener { to, last });
    let host = Host {
        beside: None,
        telling: None,
        watch: Some(listener.clone()),
        stop: Some(stop.clone()),
    };
    let thread = std::thread::Builder::new().name("tailor".into());
    let thread = thread.spawn(move || work(host, listener));
    let thread = thread.map_err(|why| raised(py, Fault::stage(why)))?;
    // A receiver belongs to one thread: this one, which lends it to the wait.
    let events = Mutex::new(events);
    let next = || {
        let events = events.lock().unwrap_or_else(|p| p.into_inner());
        events.recv_timeout(LOOK)
    };
    let mut raises: Option<PyErr> = None;
    loop {
        let event = py.detach(next);
        let heard = match (event, &hear, &raises) {
            (Err(RecvTimeoutError::Disconnected), ..) => break,
            (Ok(event), Some(hear), None) => hear.call1(py, event).map(|_| ()),
            _ => Ok(()),
        };
        if let Err(why) = heard.and_then(|()| py.check_signals()) {
            if raises.is_some() {
                // Asked once more: programs of the pipeline end at once.
                programs::end_all();
            }
            stop.store(true, Ordering::Relaxed);
            raises.get_or_insert(why);
        }
    }
    let ended = py.detach(|| thread.join());
    match (raises, ended) {
        (Some(why), _) => Err(why),
        (None, Ok(done)) => done.map_err(|fault| raised(py, fault)),
        (None, Err(panic)) => Err(raised(py, bug(&*panic))),
    }
}
