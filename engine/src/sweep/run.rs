//! Runs the points of a sweep: the nodes of many points as one agenda, rows in the points' order.

use super::busy::Busy;
use super::points::Point;
use super::row::Row;
use super::rows::{Common, Entry, Rows};
use super::sweeping::Sweeping;
use super::whole::Whole;
use crate::done::{Both, Done};
use crate::journal::Journal;
use crate::run_one::{Pool, Surroundings};
use crate::session::{self, EngineError};
use crate::store::Store;
use crate::walk::{Failures, Job, walk_reported};
use std::iter::Peekable;
use std::sync::atomic::Ordering;
use std::sync::mpsc::{Sender, channel};
use std::thread::Builder;
use std::time::Instant;

/// So many nodes of points, shared or not, are in memory at a time.
const MOST_NODES: usize = 8192;

/// Runs the points' nodes side by side; `done` gets each row in the points' order, as soon as all
/// before it are there. A point that fails does not stop the rest, and what failed is not tried
/// again for the points that share it.
///
/// # Errors
///
/// Store or inputs cannot be used. A point that fails is in its row.
pub fn run(
    sweeping: &Sweeping<'_>,
    points: impl Iterator<Item = Point>,
    mut done: impl FnMut(&Row),
) -> Result<Vec<Row>, EngineError> {
    // Programs that are kept are kept for all points.
    let _keeping = programs::Keeping::new(&sweeping.options.cache);
    let failures = Failures::default();
    let mut rows = Vec::new();
    let mut points = points.peekable();
    while points.peek().is_some() && !sweeping.cancel.load(Ordering::Relaxed) {
        let start = Instant::now();
        let store = Store::open(&sweeping.options.cache)?;
        let _using = store.using();
        let batch = gathered(sweeping, &store, &mut points)?;
        // So many at least: enough to know which records would not be kept.
        let (after, _) = points.size_hint();
        rows.extend(batch.run(sweeping, &store, &failures, (start, after), &mut done)?);
    }
    Ok(rows)
}

/// Points that run together.
struct Batch {
    points: Vec<Entry>,
    whole: Whole,
}

/// The next points, as many as are in memory at a time.
fn gathered(
    sweeping: &Sweeping<'_>,
    store: &Store,
    points: &mut Peekable<impl Iterator<Item = Point>>,
) -> Result<Batch, EngineError> {
    let stop = || sweeping.cancel.load(Ordering::Relaxed);
    let (mut gathered, mut nodes) = (Vec::new(), 0);
    let mut whole = Whole::default();
    while nodes < MOST_NODES && !stop() {
        let Some(point) = points.next() else { break };
        let member = match (sweeping.open)(&point) {
            Err(why) => Err(why),
            Ok(graph) => {
                let named = sweeping.nodes.iter().filter_map(|name| graph.node(name));
                let mut wanted: Vec<usize> = named.collect();
                if sweeping.nodes.is_empty() {
                    wanted = graph.goal.clone();
                }
                session::settled(&graph, &crate::walk::all(&graph, &wanted), store, &stop)?;
                Ok(whole.add(graph, wanted, sweeping.folders, store)?)
            }
        };
        nodes += member.as_ref().map_or(1, |m| m.places.len().max(1));
        gathered.push((point, member));
    }
    let points = gathered;
    Ok(Batch { points, whole })
}

impl Batch {
    /// Runs all that began at a moment and that so many points come after; the rows in order.
    fn run(
        self,
        sweeping: &Sweeping<'_>,
        store: &Store,
        failures: &Failures,
        (start, after): (Instant, usize),
        report: &mut impl FnMut(&Row),
    ) -> Result<Vec<Row>, EngineError> {
        let id = store.next_run()?;
        let busy = Busy::default();
        let journal = Journal::new(store.root().join(format!("runs/{id}.jsonl")));
        let all = Both(&busy, sweeping.watch);
        let threads = session::threads(sweeping.options);
        let (graph, files, contents) = self.whole.graph();
        let around = Surroundings {
            store,
            watch: &Both(&journal, &all),
            cancel: sweeping.cancel,
            pool: &Pool::new(threads),
            failures,
        };
        let common = Common {
            sweeping,
            store,
            busy: &busy,
            files: &files,
            contents: &contents,
            after,
        };
        let Some(graph) = graph else {
            return Rows::new(common, self.points, 0, start, id).rest(vec![], report);
        };
        let job = Job {
            graph: &graph,
            files: &files,
            contents: &contents,
            wanted: &graph.goal,
            threads,
            keep_going: true,
        };
        let mut rows = Rows::new(common, self.points, graph.nodes.len(), start, id);
        let (sender, heard) = channel();
        let (job, around) = (&job, &around);
        let walk = |sender: Sender<(usize, Done)>| {
            let reported = |node: usize, done: &Done| _ = sender.send((node, done.clone()));
            walk_reported(job, around, &reported)
        };
        std::thread::scope(|scope| {
            let sends = sender.clone();
            let nodes = match Builder::new().spawn_scoped(scope, move || walk(sends)) {
                Ok(beside) => {
                    drop(sender);
                    rows.hear(&heard, report)?;
                    beside.join().expect("bug: a worker panicked")
                }
                // Where the system gives no more threads, rows are heard of once all is done.
                Err(_) => {
                    let nodes = walk(sender);
                    rows.hear(&heard, report)?;
                    nodes
                }
            };
            store.save_index();
            rows.rest(nodes, report)
        })
    }
}
