//! A first answer while the whole is on its way: as soon as the coarse surface is there, what `--fast` finds
//! is printed and written as `report.html`, which the whole report replaces.

use super::measure_args::Measure;
use super::prepared::Prepared;
use super::provenance::{completed_as, get};
use super::screen::{broken, in_short};
use crate::delivery::Delivery;
use crate::graph::Graph;
use crate::words::language::Words;
use command::{GlobalArgs, Ran, above, whose};
use engine::walk::{Done, Status, Watch};
use engine::{Options, Outcome, run_unrecorded};
use shape::{Document, Girths};
use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::thread::JoinHandle;

/// The node whose result a first answer is taken from.
const COARSE: &str = "coarse";

/// Hears when the coarse surface is there, and makes a first answer of it beside the run.
pub(super) struct First {
    answer: Arc<Answer>,
    thread: Mutex<Option<JoinHandle<()>>>,
}

/// What it takes to make a first answer.
struct Answer {
    graph: Graph,
    /// With a page on which the whole did not come.
    unfinished: Graph,
    /// Whether a page was written.
    written: AtomicBool,
    folders: Vec<(String, PathBuf)>,
    options: Options,
    capture: PathBuf,
    out: PathBuf,
    shown: String,
    words: Words,
    quiet: bool,
    stop: AtomicBool,
}

impl First {
    /// Of a capture, by the pipeline that stops at the coarse surface: one on whose page the whole follows, and
    /// one on whose page it did not.
    pub(super) fn new(
        mut graphs: [Graph; 2],
        ready: &Prepared,
        measure: &Measure,
        global: &GlobalArgs,
    ) -> Self {
        // Colours are painted on the surface: an atlas would take longer than all the rest.
        for graph in &mut graphs {
            if let Some(report) = graph.node("report") {
                let node = &mut graph.nodes[report];
                let port = node.ports.iter().position(|port| port.name == "textured");
                port.into_iter().for_each(|port| node.from[port] = None);
            }
        }
        let [graph, unfinished] = graphs;
        let options = Options {
            cache: global.cache.clone(),
            threads: global.threads.map(NonZeroUsize::get),
            keep_going: false,
        };
        let answer = Answer {
            graph,
            unfinished,
            written: AtomicBool::new(false),
            folders: ready.folders.clone(),
            options,
            capture: ready.capture.clone(),
            out: ready.out.clone(),
            shown: ready.shown.clone(),
            words: measure.words(),
            quiet: global.quiet || global.json,
            stop: AtomicBool::new(false),
        };
        First {
            answer: Arc::new(answer),
            thread: Mutex::default(),
        }
    }

    /// Waits for a first answer that is under way. Where the whole did not come, one that is under way is stopped,
    /// and a page that was written names it.
    pub(super) fn end(&self, whole: bool) {
        let answer = &self.answer;
        answer.stop.store(!whole, Ordering::Relaxed);
        let thread = self.thread.lock().expect("bug: poisoned").take();
        // A thread that panicked has reported it, and the whole answer does not need it.
        thread.map(JoinHandle::join);
        if !whole && answer.written.load(Ordering::Relaxed) {
            answer.stop.store(false, Ordering::Relaxed);
            let graph = &answer.unfinished;
            let made = answer.run(graph, "report");
            made.and_then(|outcome| answer.write(graph, &outcome));
        }
    }
}

impl Watch for First {
    fn done(&self, node: &str, done: &Done) {
        // What was found was printed when it was made.
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
    /// Makes, prints and writes it. A surface without a girth yet has none: the whole way reports why.
    fn make(&self) {
        let graph = &self.graph;
        let Some(outcome) = self.run(graph, "girths") else {
            return;
        };
        if let Some(girths) = get::<Girths>(graph, &outcome, "girths").filter(|_| !self.quiet) {
            let put = [("girths", in_short(self.words, &girths).into())];
            let reported = broken(&self.words.with("screen-first", &put), 2);
            above(|| command::errln!("{}", reported.trim_end()));
        }
        let page = self.run(graph, "report");
        let written = page.and_then(|outcome| self.write(graph, &outcome));
        self.written.store(written.is_some(), Ordering::Relaxed);
        if written.is_some() && !self.quiet {
            let page = self.out.join("report.html").display().to_string();
            let put = [("path", page.into())];
            let reported = self.words.with("screen-first-report", &put);
            above(|| command::errln!("{reported}"));
        }
    }

    /// Makes the result of a node, if it can be made. It is a part of the run that goes on: none of its own.
    fn run(&self, graph: &Graph, goal: &str) -> Option<Outcome> {
        let wanted: Vec<usize> = graph.node(goal).into_iter().collect();
        let (folders, options) = (&self.folders, &self.options);
        run_unrecorded(graph, folders, &wanted, options, &Nobody, &self.stop).ok()
    }

    /// Writes the page. What cannot be written now is reported when the whole is to be.
    fn write(&self, graph: &Graph, outcome: &Outcome) -> Option<()> {
        let report = get::<Document>(graph, outcome, "report")?;
        let ran = Ran::of(graph, outcome, &self.folders);
        let page = vec![(
            String::new(),
            completed_as(&report.bytes, &ran, Some(&self.shown)),
        )];
        let own = whose(&[("photos".to_owned(), self.capture.clone())]);
        let mut delivery = Delivery::open(&self.out, &own).ok()?;
        delivery.begin().ok()?;
        delivery.put("report.html", &page).ok()
    }
}
