//! Who uploads: some threads beside the work, for as long as a process uses a shared store.

use super::beside::{beside, threads};
use super::joined;
use super::link::{Link, MOST_QUEUED, Report};
use super::upload::{Came, upload};
use super::waiting;
use crate::store::{Store, StoreError};
use buckets::Patience;
use buckets::Seal;
use buckets::{Objects, Trouble};
use stage::Hash;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::thread::JoinHandle;
use std::time::{Duration, Instant};
use system::clock;

/// Uploads under way at a time; each holds a result in memory.
const THREADS: usize = 4;

/// A process's use of a shared store: what it makes is uploaded beside the work. What is not uploaded
/// when it ends stays noted on disk.
pub struct Sharing {
    root: PathBuf,
    link: Arc<Link>,
    threads: Vec<JoinHandle<()>>,
}

/// How a shared store is used.
#[derive(Default)]
pub struct Manner {
    /// Nothing is written there.
    pub read_only: bool,
    /// Who signs what is written, and who is believed; without it nothing is signed, and everybody is believed.
    pub seal: Option<Box<dyn Seal>>,
    /// How long the place may hold up who waits for it.
    pub patience: Patience,
}

/// What was not uploaded.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Left {
    /// So many results were.
    pub sent: usize,
    /// So many wait.
    pub waiting: usize,
    /// Whether the disk does not show how many.
    pub unlisted: bool,
    /// Why, if something is known of it.
    pub why: Option<String>,
}

/// Why there is no sharing.
#[derive(Debug, thiserror::Error)]
pub enum NoSharing {
    /// The store here.
    #[error(transparent)]
    Here(#[from] StoreError),
    /// The place.
    #[error("the store {0}: {1}")]
    There(String, Trouble),
}

impl Sharing {
    /// Links the store at `root` to a place: whoever opens it in this process reads what is there, and what
    /// they make goes there unless its manner is `read_only`.
    ///
    /// # Errors
    ///
    /// The store here cannot be opened, or the place refuses. One that does not answer is reported, and asked
    /// again later.
    pub fn begin(
        root: &Path,
        objects: Box<dyn Objects>,
        manner: Manner,
        report: Report,
    ) -> Result<Sharing, NoSharing> {
        let Manner {
            read_only,
            seal,
            patience,
        } = manner;
        let name = objects.name().to_owned();
        Store::open(root)?;
        let link = Link::new(root, objects, read_only, seal, patience, report)
            .map_err(|trouble| NoSharing::There(name, trouble))?;
        let link = Arc::new(link);
        joined::join(root, &link);
        link.queue().more = !read_only;
        let many = if read_only { 0 } else { THREADS };
        let (store, its_link) = (Arc::new(Store::open(root)?), link.clone());
        let threads = threads(many, move || work(&store, &its_link));
        let threads = threads.unwrap_or_else(|why| {
            link.queue().stopped = Some(format!("no thread can be started: {why}"));
            Vec::new()
        });
        Ok(Sharing {
            root: root.into(),
            link,
            threads,
        })
    }

    pub(super) fn link(&self) -> &Link {
        &self.link
    }

    /// What the user calls the place.
    pub fn name(&self) -> &str {
        self.link.name()
    }

    /// Waits until all is uploaded, for as long as something is within `patience`, delays of the place before counted
    /// in; then lets go.
    pub fn finish(mut self, patience: Duration) -> Left {
        let begun = Instant::now();
        let patience = match self.link.stalled() {
            none if none.is_zero() => patience,
            stalled => patience.saturating_sub(stalled + self.link.patience().of_an_answer()),
        };
        let mut queue = self.link.queue();
        let busy = |queue: &super::link::Queue| {
            queue.stopped.is_none() && (queue.more || queue.running > 0 || !queue.queued.is_empty())
        };
        while !self.threads.is_empty() && busy(&queue) {
            let since = queue.since.map_or(begun, |since| since.max(begun));
            if since.elapsed() >= patience {
                break;
            }
            let step = Duration::from_millis(50);
            queue = self
                .link
                .bell
                .wait_timeout(queue, step)
                .expect("bug: poisoned")
                .0;
        }
        let (sent, stopped) = (queue.sent, queue.stopped.clone());
        drop(queue);
        self.end();
        let store = Store::open(&self.root);
        let waiting = store.and_then(|store| {
            let keys = waiting::of(&store, &self.link)?.into_iter();
            Ok(keys.filter(|key| waiting::is_made(&store, *key)).count())
        });
        let silent = || self.link.silent();
        Left {
            sent,
            unlisted: waiting.is_err(),
            waiting: waiting.unwrap_or(0),
            why: stopped.or_else(silent),
        }
    }

    fn end(&mut self) {
        self.link.queue().closing = true;
        self.link.bell.notify_all();
        // A thread that waits for an answer is let go: what it uploads stays noted until it is there.
        let (begun, answer) = (Instant::now(), self.link.patience().of_an_answer());
        for thread in self.threads.drain(..) {
            while !thread.is_finished() && begun.elapsed() < answer {
                std::thread::sleep(Duration::from_millis(2));
            }
            if thread.is_finished() {
                let _ = thread.join();
            }
        }
        joined::part(&self.root);
    }
}

impl Drop for Sharing {
    fn drop(&mut self) {
        self.end();
    }
}

/// One thread: takes what waits, uploads it.
fn work(store: &Store, link: &Link) {
    beside();
    while let Some(key) = next(store, link, true) {
        one(store, link, key);
    }
}

/// Uploads one result. Nobody sweeps meanwhile: what is forgotten is not put there again.
fn one(store: &Store, link: &Link, key: Hash) {
    let using = store.using();
    let came = upload(store, link, key);
    drop(using);
    noted(store, link, key, came);
}

/// As a thread beside the work, until there is nothing more to be done at once.
#[cfg(test)]
pub(crate) fn drain(store: &Store, link: &Link) {
    while let Some(key) = next(store, link, false) {
        one(store, link, key);
    }
}

/// What is to be uploaded next; `None` when the process is done with it, or nothing is and it is not waited for.
fn next(store: &Store, link: &Link, wait: bool) -> Option<Hash> {
    let mut queue = link.queue();
    loop {
        if queue.closing {
            return None;
        }
        let rests = link.rests_until().filter(|_| queue.stopped.is_none());
        let rests = rests.map(|until| until.saturating_duration_since(clock::instant()));
        if rests.is_none() && queue.stopped.is_none() && queue.paused == 0 {
            if let Some(key) = queue.keys.pop_front() {
                queue.running += 1;
                return Some(Hash::from_bytes(key));
            }
            if queue.more && queue.running == 0 {
                let queued = queue.queued.clone();
                // Listed without the lock: whoever publishes does not wait for it.
                queue.more = false;
                // Whoever waits for the end waits for this, too.
                queue.running += 1;
                drop(queue);
                let listed = waiting::of(store, link);
                let waiting = listed.as_deref().unwrap_or_default().iter();
                let made = waiting.filter(|key| waiting::is_made(store, **key));
                let mut fresh = made
                    .map(|key| *key.as_bytes())
                    .filter(|key| !queued.contains(key));
                let some: Vec<[u8; 32]> = fresh.by_ref().take(MOST_QUEUED).collect();
                let more = fresh.next().is_some();
                queue = link.queue();
                if let Err(why) = &listed {
                    queue.stopped.get_or_insert(why.to_string());
                }
                for key in some {
                    if queue.queued.insert(key) {
                        queue.keys.push_back(key);
                    }
                }
                queue.more |= more;
                queue.running -= 1;
                link.bell.notify_all();
                continue;
            }
        }
        if !wait {
            return None;
        }
        let step = rests
            .unwrap_or(Duration::from_millis(200))
            .max(Duration::from_millis(5));
        queue = link
            .bell
            .wait_timeout(queue, step)
            .expect("bug: poisoned")
            .0;
    }
}

/// Notes what came of an upload.
fn noted(store: &Store, link: &Link, key: Hash, came: Result<Came, Trouble>) {
    // What is there waits no longer, before somebody who lists what waits takes it for one more.
    if came.as_ref().is_ok_and(|came| *came != Came::Nothing) {
        link.known().add(*key.as_bytes());
        waiting::remove(store, link, key);
    }
    let mut queue = link.queue();
    queue.running -= 1;
    match came {
        Ok(came) => {
            queue.queued.remove(key.as_bytes());
            queue.since = Some(clock::instant());
            queue.sent += usize::from(came == Came::Sent);
            drop(queue);
            if let Came::Differs(theirs) = &came {
                link.report(&format!(
                    "not deterministic: the result {} was made elsewhere as {theirs}, here as something else; the first counts there",
                    &key.to_hex()[..12]
                ));
            }
            // Noted by somebody who writes the record only now: left to them.
            if came == Came::Nothing && store.record(key).is_some() {
                waiting::remove(store, link, key);
            }
        }
        // Not known of yet to the user, it is reported by the link; tried again when it answers.
        Err(Trouble::Down(_)) => queue.keys.push_back(*key.as_bytes()),
        Err(Trouble::Refused(why)) => {
            queue.queued.remove(key.as_bytes());
            let first = queue.stopped.is_none();
            queue.stopped.get_or_insert(why.clone());
            drop(queue);
            if first {
                link.report(&format!("nothing more is uploaded: {why}"));
            }
        }
    }
    link.bell.notify_all();
}
