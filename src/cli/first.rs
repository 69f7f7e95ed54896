//! A first answer while the whole is on its way: waist and hip from the hull of reduced photos, before anything else is
//! made of them. They are shown on the screen and written as `report.html`, which the whole report replaces.

use super::columns::{broken, wide_err};
use super::measure_args::Measure;
use super::prepared::Prepared;
use super::provenance::{completed_as, get};
use super::screen::in_short;
use crate::delivery::Delivery;
use crate::graph::Graph;
use crate::words::language::Words;
use command::{GlobalArgs, Host, Ran, above, whose};
use engine::walk::{self, Done, Status, Watch};
use engine::{Options, Outcome, run_unrecorded};
use shape::{Document, Girths};
use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex};
use std::thread::{Builder, JoinHandle};

/// The node that reads the photos.
const PHOTOS: &str = "photos";

/// The node whose result a first answer of a walk is taken from: it reads no photos of its own.
const COARSE: &str = "coarse";

/// Hears when the photos are there, and makes a first answer of them before the run goes on.
pub(super) struct First {
    answer: Arc<Answer>,
    thread: Mutex<Option<JoinHandle<()>>>,
    /// The nodes that the hull is made of: if one is made anew, so is the hull.
    of_hull: Vec<String>,
    /// Whether the photos are reduced, so that nothing of the whole is made on the way.
    apart: bool,
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
    /// Who stops the whole.
    host: Host,
    /// Set when the whole came to nothing.
    stop: AtomicBool,
}

impl First {
    /// Of a capture, by the pipeline of a first answer: one on whose page the whole follows, and one on whose page
    /// it did not.
    pub(super) fn new(
        graphs: [Graph; 2],
        ready: &Prepared,
        measure: &Measure,
        global: &GlobalArgs,
    ) -> Self {
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
            host: global.host.clone(),
            stop: AtomicBool::new(false),
        };
        let hull: Vec<usize> = ready.graph.node("hull").into_iter().collect();
        let of_hull = walk::all(&ready.graph, &hull).into_iter();
        First {
            answer: Arc::new(answer),
            thread: Mutex::default(),
            of_hull: of_hull.map(|i| ready.graph.nodes[i].name.clone()).collect(),
            apart: !measure.walk,
        }
    }

    /// Begins, once; hears when waist and hip are there, or will not be.
    fn begin(&self) -> Option<Receiver<()>> {
        let mut thread = self.thread.lock().expect("bug: poisoned");
        if thread.is_some() {
            return None;
        }
        let (there, hears) = channel();
        let answer = Arc::clone(&self.answer);
        // Where the system gives no more threads, the whole answer is the first.
        let begun = Builder::new().spawn(move || answer.make(&there));
        *thread = begun.ok();
        thread.is_some().then_some(hears)
    }

    /// Whether one is under way or there.
    pub(super) fn begun(&self) -> bool {
        self.thread.lock().expect("bug: poisoned").is_some()
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
            let made = answer.run(graph, "report", &answer.stop);
            made.and_then(|outcome| answer.write(graph, &outcome));
        }
    }
}

impl Watch for First {
    fn started(&self, node: &str) {
        // The photos were found, but the hull is made anew.
        if self.apart && node != PHOTOS && self.of_hull.iter().any(|n| n == node) {
            self.begin();
        }
    }

    fn done(&self, node: &str, done: &Done) {
        // What was found was printed when it was made.
        let from = if self.apart { PHOTOS } else { COARSE };
        if node != from || done.status != Status::Executed {
            return;
        }
        let there = self.begin();
        // Both would take twice as long beside each other. One that comes to nothing is not waited for.
        there.filter(|_| self.apart).map(|there| there.recv().ok());
    }
}

impl Answer {
    /// Makes, shows and writes it; who waits hears when it is shown. A surface without a girth shows none: the whole way
    /// gives the reason.
    fn make(&self, there: &Sender<()>) {
        let graph = &self.graph;
        let Some(outcome) = self.run(graph, "girths", self.host.cancel()) else {
            return;
        };
        if let Some(girths) = get::<Girths>(graph, &outcome, "girths") {
            let put = [("girths", in_short(self.words, &girths).into())];
            let reported = broken(&self.words.with("screen-first", &put), 2, wide_err());
            above(|| command::errln!("{}", reported.trim_end()));
        }
        // Nobody waits where all is to stop.
        let _ = there.send(());
        let page = self.run(graph, "report", &self.stop);
        let written = page.and_then(|outcome| self.write(graph, &outcome));
        self.written.store(written.is_some(), Ordering::Relaxed);
        if written.is_some() {
            let page = self.out.join("report.html").display().to_string();
            let put = [("path", page.into())];
            let reported = self.words.with("screen-first-report", &put);
            above(|| command::errln!("{reported}"));
        }
    }

    /// Makes the result of a node, if it can be made. It is a part of the run that goes on: none of its own.
    fn run(&self, graph: &Graph, goal: &str, stop: &AtomicBool) -> Option<Outcome> {
        let wanted: Vec<usize> = graph.node(goal).into_iter().collect();
        let (folders, options) = (&self.folders, &self.options);
        run_unrecorded(graph, folders, &wanted, options, &(), stop).ok()
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
