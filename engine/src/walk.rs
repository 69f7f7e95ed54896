//! Graph → Outcome: makes what is not there yet, side by side, and drops what nobody reads any more.

use crate::agenda::Agenda;
use crate::run_one::{self, Step, Surroundings};

pub use crate::done::{Both, Done, Failures, Job, Status, Watch, all, needed, sources};
use std::sync::{Condvar, Mutex};
use std::thread::Builder;
use std::time::Duration;

/// How long until it is asked again whether another process has made a result.
const RETRY: Duration = Duration::from_millis(15);

/// Gets each node by its place, as it is done.
pub(crate) type Reported<'a> = dyn Fn(usize, &Done) + Sync + 'a;

/// Walks: one entry a node, `None` for those that were not wanted.
pub fn walk(job: &Job<'_>, around: &Surroundings<'_>) -> Vec<Option<Done>> {
    walk_reported(job, around, &|_, _| {})
}

/// As [`walk`], with each node reported; one that is made again since its result went away is reported twice.
pub(crate) fn walk_reported(
    job: &Job<'_>,
    around: &Surroundings<'_>,
    reported: &Reported<'_>,
) -> Vec<Option<Done>> {
    let mut agenda = Agenda::new(job);
    around.store.look_around(job.graph.nodes.len());
    settle(job, around, reported, &mut agenda);
    if !agenda.idle() {
        let (shared, bell) = (Mutex::new(agenda), Condvar::new());
        let work = || work(job, (around, reported), &shared, &bell);
        match job.threads {
            0 => work(),
            threads => std::thread::scope(|scope| {
                for _ in 1..threads {
                    // Where the system gives no more threads, those that there are do it all.
                    let _ = Builder::new().spawn_scoped(scope, work);
                }
                work();
            }),
        }
        agenda = shared.into_inner().expect("bug: a worker panicked");
    }
    let status = if around.cancelled() {
        Status::Cancelled
    } else {
        Status::Skipped
    };
    for i in (0..job.graph.nodes.len()).filter(|i| agenda.needed[*i]) {
        agenda.done[i].get_or_insert_with(|| Done::nothing(status.clone()));
    }
    agenda.done
}

/// Finds all that can be found without making anything, in the pipeline's order. What is left
/// ready must be made.
fn settle(
    job: &Job<'_>,
    around: &Surroundings<'_>,
    reported: &Reported<'_>,
    agenda: &mut Agenda<'_>,
) {
    let mut missing = Vec::new();
    loop {
        let ready = ready(job, around, agenda);
        if ready.is_empty() {
            break;
        }
        for node in ready {
            let found = match around.cancelled() {
                true => None,
                false => agenda.contents(node).and_then(|inputs| {
                    run_one::find(job, node, &inputs, agenda.there(node), around.store)
                }),
            };
            match found {
                Some(done) => {
                    around.watch.done(&job.graph.nodes[node].name, &done);
                    reported(node, &done);
                    agenda.finish(node, done, None);
                }
                None => missing.push(node),
            }
        }
    }
    missing.into_iter().for_each(|node| agenda.put_off(node));
    agenda.retry();
}

/// What is looked for next: the first node that is ready. With a shared store it is all of them, so that
/// their records come side by side.
fn ready(job: &Job<'_>, around: &Surroundings<'_>, agenda: &mut Agenda<'_>) -> Vec<usize> {
    if !around.store.is_shared() {
        return agenda.next().into_iter().collect();
    }
    let ready: Vec<usize> = std::iter::from_fn(|| agenda.next()).collect();
    let key = |node: &usize| {
        let inputs = agenda.contents(*node)?;
        Some(crate::key::key(&job.graph.nodes[*node], &inputs))
    };
    let keys: Vec<stage::Hash> = ready.iter().filter_map(key).collect();
    around.store.bring_all(&keys);
    ready
}

/// A worker that panics keeps nobody waiting for what it was making.
struct Awake<'a, 'b>(&'a Mutex<Agenda<'b>>, &'a Condvar);

impl Drop for Awake<'_, '_> {
    fn drop(&mut self) {
        if std::thread::panicking() {
            if let Ok(mut agenda) = self.0.lock() {
                agenda.stop = true;
            }
            self.1.notify_all();
        }
    }
}

/// One worker: takes a ready node, runs it, makes ready what waited for it.
fn work(
    job: &Job<'_>,
    (around, reported): (&Surroundings<'_>, &Reported<'_>),
    shared: &Mutex<Agenda<'_>>,
    bell: &Condvar,
) {
    let lock = || shared.lock().expect("bug: a worker panicked");
    let name = |node: usize| job.graph.nodes[node].name.as_str();
    let report = |node: usize, done: &Done| {
        around.watch.done(name(node), done);
        reported(node, done);
    };
    let _awake = Awake(shared, bell);
    let mut agenda = lock();
    loop {
        agenda.stop |= around.cancelled();
        if agenda.stop || agenda.idle() {
            bell.notify_all();
            return;
        }
        let Some(node) = agenda.next() else {
            agenda = if agenda.has_put_off() {
                let waited = bell.wait_timeout(agenda, RETRY);
                let (mut agenda, waited) = waited.expect("bug: a worker panicked");
                if waited.timed_out() {
                    agenda.retry();
                }
                agenda
            } else {
                bell.wait(agenda).expect("bug: a worker panicked")
            };
            continue;
        };
        agenda.running += 1;
        let inputs = agenda.contents(node).expect("bug: ready, but it waits");
        let (at_hand, there) = (agenda.at_hand(node), agenda.there(node));
        drop(agenda);
        let step = run_one::run_one(job, node, &inputs, at_hand, there, around);
        if let Step::Done(done, _) = &step {
            report(node, done);
        }
        agenda = lock();
        agenda.running -= 1;
        let skipped = match step {
            Step::Done(done, artifact) => {
                agenda.stop |= matches!(done.status, Status::Failed(_)) && !job.keep_going;
                agenda.finish(node, *done, artifact)
            }
            Step::Busy => {
                around.watch.waits(name(node));
                agenda.put_off(node);
                vec![]
            }
            Step::Gone(gone) if agenda.gone(node, &gone) => vec![],
            Step::Gone(gone) => {
                let from = name(gone[0]);
                let why = format!(
                    "the result of `{from}` goes out of the cache as soon as it is made; \
                     give it space, or another place with --cache"
                );
                let done = Done::nothing(Status::Failed(why.into()));
                report(node, &done);
                agenda.stop |= !job.keep_going;
                agenda.finish(node, done, None)
            }
        };
        for node in skipped {
            let done = agenda.done[node]
                .as_ref()
                .expect("bug: skipped, but not done");
            report(node, done);
        }
        bell.notify_all();
    }
}
