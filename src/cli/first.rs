//! A first answer while the whole is on its way: as soon as the coarse surface is there, what `--fast` tells
//! is told on the screen and written as `report.html`, which the whole report replaces.

use super::measure_args::Measure;
use super::prepared::Prepared;
use super::provenance::{completed, get};
use super::screen::screen;
use crate::delivery::Delivery;
use crate::graph::Graph;
use engine::cli::{GlobalArgs, above, whose};
use engine::walk::{Done, Status, Watch};
use engine::{Options, run};
use shape::{Document, Girths};
use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::thread::JoinHandle;

/// The node whose result a first answer is taken from.
const COARSE: &str = "coarse";

/// What is said before the girths.
const SAID: &str = "first answer from the coarse surface; the full one follows";

/// Hears when the coarse surface is there, and makes a first answer of it beside the run.
pub(super) struct First {
    answer: Arc<Answer>,
    thread: Mutex<Option<JoinHandle<()>>>,
}

/// What it takes to make a first answer.
struct Answer {
    graph: Graph,
    folders: Vec<(String, PathBuf)>,
    options: Options,
    capture: PathBuf,
    out: PathBuf,
    shown: String,
    inches: bool,
    quiet: bool,
    stop: AtomicBool,
}

impl First {
    /// Of a capture, by the pipeline that stops at the coarse surface.
    pub(super) fn new(
        mut graph: Graph,
        ready: &Prepared,
        measure: &Measure,
        global: &GlobalArgs,
    ) -> Self {
        // Colours are painted on the surface: an atlas would take longer than all the rest.
        if let Some(report) = graph.node("report") {
            let node = &mut graph.nodes[report];
            let port = node.ports.iter().position(|port| port.name == "textured");
            port.into_iter().for_each(|port| node.from[port] = None);
        }
        let options = Options {
            cache: global.cache.clone(),
            threads: global.threads.map(NonZeroUsize::get),
            keep_going: false,
        };
        let answer = Answer {
            graph,
            folders: ready.folders.clone(),
            options,
            capture: ready.capture.clone(),
            out: ready.out.clone(),
            shown: ready.shown.clone(),
            inches: measure.inches(),
            quiet: global.quiet || global.json,
            stop: AtomicBool::new(false),
        };
        First {
            answer: Arc::new(answer),
            thread: Mutex::default(),
        }
    }

    /// Waits for a first answer that is under way; one that is of no use any more is stopped.
    pub(super) fn end(&self, useful: bool) {
        self.answer.stop.store(!useful, Ordering::Relaxed);
        let thread = self.thread.lock().expect("bug: poisoned").take();
        // A thread that panicked has said so, and the whole answer does not need it.
        thread.map(JoinHandle::join);
    }
}

impl Watch for First {
    fn done(&self, node: &str, done: &Done) {
        // What was found was told when it was made.
        if node != COARSE || done.status != Status::Executed {
            return;
        }
        let answer = Arc::clone(&self.answer);
        let thread = std::thread::spawn(move || answer.make());
        *self.thread.lock().expect("bug: poisoned") = Some(thread);
    }
}

/// Hears nothing.
struct Nobody;

impl Watch for Nobody {}

impl Answer {
    /// Makes, tells and writes it. A surface that tells no girth yet tells none: the whole way says why.
    fn make(&self) {
        for goal in ["girths", "report"] {
            let wanted: Vec<usize> = self.graph.node(goal).into_iter().collect();
            let (graph, folders) = (&self.graph, &self.folders);
            let Ok(outcome) = run(graph, folders, &wanted, &self.options, &Nobody, &self.stop)
            else {
                return;
            };
            if let Some(girths) = get::<Girths>(graph, &outcome, "girths")
                && goal == "girths"
                && !self.quiet
            {
                let told = screen(&self.shown, 0, None, &girths, self.inches);
                above(|| engine::errln!("\n{SAID}:\n{told}"));
            }
            if let Some(report) = get::<Document>(graph, &outcome, "report") {
                let page = vec![(String::new(), completed(&report.bytes, &outcome, graph))];
                let own = whose(&[("photos".to_owned(), self.capture.clone())]);
                let delivered = Delivery::open(&self.out, &own).and_then(|mut delivery| {
                    delivery.begin()?;
                    delivery.put("report.html", &page)
                });
                // What cannot be written now is said when the whole is to be.
                let written = delivered.is_ok() && !self.quiet;
                written.then(|| above(|| engine::errln!("first report: {}", self.page())));
            }
        }
    }

    fn page(&self) -> String {
        self.out.join("report.html").display().to_string()
    }
}
