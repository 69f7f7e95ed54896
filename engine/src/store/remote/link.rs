//! A store's link to a shared one: how the place is doing, what waits to be uploaded, what is known.
//!
//! A place that does not answer is left alone for a while, longer each time, and reported once: whoever runs
//! goes on without it.

use super::beside::is_beside;
use super::handshake::{self, Honest, Identity};
use super::inventory::Inventory;
use super::known::Known;
use buckets::{Objects, Patience, Seal, Trouble};
use std::collections::{BTreeSet, VecDeque};
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;
use std::sync::{Condvar, Mutex, MutexGuard};
use std::time::{Duration, Instant};
use system::clock;

/// Reports a line to the user.
pub type Report = Box<dyn Fn(&str) + Send + Sync>;

/// A store's link to a shared one.
pub struct Link {
    pub(super) objects: Box<dyn Objects>,
    root: PathBuf,
    /// Names the place in the store's own files: the hash of what the user calls it.
    pub(super) tag: String,
    /// Nothing is written there.
    pub(super) read_only: bool,
    /// Who signs what is written, and who is believed.
    pub(super) seal: Option<Box<dyn Seal>>,
    /// Whether it was reported that somebody is not believed.
    pub(super) strangers: AtomicBool,
    /// Whether it was reported that something here is not signed.
    pub(super) unsigned: AtomicBool,
    report: Report,
    met: Mutex<Met>,
    pub(super) known: Mutex<Known>,
    pub(super) inventory: Mutex<Inventory>,
    pub(super) queue: Mutex<Queue>,
    pub(super) bell: Condvar,
    weather: Mutex<Weather>,
    patience: Patience,
}

/// How far the two have come to know each other.
#[derive(Default)]
struct Met {
    identity: Option<Identity>,
    honest: Option<Honest>,
}

/// What waits, in this process: what it does not hold is in the store's folder `waiting`.
#[derive(Default)]
pub(super) struct Queue {
    pub(super) keys: VecDeque<[u8; 32]>,
    /// Those in `keys`, and those that are being uploaded.
    pub(super) queued: BTreeSet<[u8; 32]>,
    /// There may be more in the folder than here.
    pub(super) more: bool,
    pub(super) running: usize,
    pub(super) sent: usize,
    pub(super) since: Option<Instant>,
    /// Why nothing is uploaded any more.
    pub(super) stopped: Option<String>,
    pub(super) closing: bool,
    pub(super) paused: usize,
    /// Contents whose blob in the shared store was found wrong: written over.
    pub(super) bad: BTreeSet<[u8; 32]>,
    /// Contents that were not there, though a record names them.
    pub(super) absent: BTreeSet<[u8; 32]>,
}

/// Keys in memory; more wait in the folder alone.
pub(super) const MOST_QUEUED: usize = 4096;

/// Whether the place answers.
#[derive(Default)]
struct Weather {
    /// Not asked before that.
    until: Option<Instant>,
    wait: Duration,
    why: String,
    reply: bool,
    /// How long it delayed who waits for it, since it last answered.
    stalled: Duration,
}

const FIRST_WAIT: Duration = Duration::from_millis(250);
const LONGEST_WAIT: Duration = Duration::from_secs(8);

/// Tries of one request, where what is asked does no harm when it is done twice.
const TRIES: usize = 4;

/// What the store's own files call a place.
fn tag(name: &str) -> String {
    blake3::hash(name.as_bytes()).to_hex()[..16].to_owned()
}

impl Link {
    /// Of the store at `root` to a place.
    ///
    /// # Errors
    ///
    /// The place refuses: no bucket, no rights, no store of ours. One that does not answer is reported, and
    /// asked again later.
    pub fn new(
        root: &Path,
        objects: Box<dyn Objects>,
        read_only: bool,
        seal: Option<Box<dyn Seal>>,
        patience: Patience,
        report: Report,
    ) -> Result<Link, Trouble> {
        let link = Link {
            tag: tag(objects.name()),
            root: root.into(),
            objects,
            read_only,
            seal,
            strangers: AtomicBool::new(false),
            unsigned: AtomicBool::new(false),
            report,
            met: Mutex::default(),
            known: Mutex::default(),
            inventory: Mutex::default(),
            queue: Mutex::default(),
            bell: Condvar::new(),
            weather: Mutex::default(),
            patience,
        };
        match link.waited(&|| link.meet()) {
            Err(Trouble::Refused(why)) => Err(Trouble::Refused(why)),
            // Reported already.
            Err(Trouble::Down(_)) | Ok(()) => Ok(link),
        }
    }

    /// What the user calls the place.
    pub fn name(&self) -> &str {
        self.objects.name()
    }

    /// There may be more on disk that waits.
    #[cfg(test)]
    pub(crate) fn look_for_more(&self) {
        self.queue().more = true;
    }

    /// Whether nothing is written there.
    pub fn is_read_only(&self) -> bool {
        self.read_only
    }

    pub(super) fn report(&self, line: &str) {
        (self.report)(&format!("store {}: {line}", self.objects.name()));
    }

    pub(super) fn queue(&self) -> MutexGuard<'_, Queue> {
        self.queue.lock().expect("bug: poisoned")
    }

    pub(super) fn known(&self) -> MutexGuard<'_, Known> {
        self.known.lock().expect("bug: poisoned")
    }

    /// Whether the place has a layout that this program reads, once.
    fn meet(&self) -> Result<(), Trouble> {
        let mut met = self.met.lock().expect("bug: poisoned");
        if met.identity.is_none() {
            let identity =
                self.steadily(&|| handshake::identity(&*self.objects, self.read_only))?;
            // What one signer has put there another has not.
            let tag = match self.seal.as_ref().and_then(|seal| seal.signer()) {
                None => self.tag.clone(),
                Some(who) => tag(&format!("{}\n{who}", self.name())),
            };
            *self.known() = Known::load(&self.root, &tag, identity.0);
            met.identity = Some(identity);
        }
        Ok(())
    }

    /// Whether the place creates only what is not there, as it promises; checked once, before anything is written.
    pub(super) fn honest(&self) -> Result<Honest, Trouble> {
        self.meet()?;
        let mut met = self.met.lock().expect("bug: poisoned");
        if met.honest.is_none() {
            let honest = self.steadily(&|| handshake::probe(&*self.objects))?;
            if honest == Honest::Overwrites {
                self.report(
                    "it writes over what is there when it is asked to create: who comes second gets \
                     the same answer as who comes first, and what is not deterministic is not noticed",
                );
            }
            met.honest = Some(honest);
        }
        Ok(met.honest.expect("bug: just probed"))
    }

    /// Asks something that may be asked again, after the two have met.
    pub(super) fn ask<T>(&self, ask: &dyn Fn() -> Result<T, Trouble>) -> Result<T, Trouble> {
        self.waited(&|| {
            self.meet()?;
            self.steadily(ask)
        })
    }

    /// Asks, and notes how long that delayed who waits for it, if nothing came of it.
    fn waited<T>(&self, ask: &dyn Fn() -> Result<T, Trouble>) -> Result<T, Trouble> {
        if let Some(why) = self.rests() {
            return Err(Trouble::Down(why));
        }
        let begun = clock::instant();
        let answer = ask();
        if matches!(answer, Err(Trouble::Down(_))) && !is_beside() {
            self.weather.lock().expect("bug: poisoned").stalled += clock::since(begun);
        }
        answer
    }

    /// How long the place delayed who waited for it, since it last answered.
    pub(super) fn stalled(&self) -> Duration {
        self.weather.lock().expect("bug: poisoned").stalled
    }

    /// How long who waits for it goes on.
    pub(super) fn patience(&self) -> Patience {
        self.patience
    }

    /// Asks some times; notes whether the place answers.
    fn steadily<T>(&self, ask: &dyn Fn() -> Result<T, Trouble>) -> Result<T, Trouble> {
        if let Some(why) = self.rests() {
            return Err(Trouble::Down(why));
        }
        let (mut last, begun) = (String::new(), clock::instant());
        for tried in 0..TRIES {
            match ask() {
                Err(Trouble::Down(why)) => last = why,
                answer => {
                    self.answered();
                    return answer;
                }
            }
            if clock::since(begun) >= self.patience.of_a_question() || self.queue().closing {
                break;
            }
            if tried + 1 < TRIES {
                clock::pause(Duration::from_millis(20 << tried));
            }
        }
        self.fell_silent(&last);
        Err(Trouble::Down(last))
    }

    /// Why the place is not asked just now.
    fn rests(&self) -> Option<String> {
        let weather = self.weather.lock().expect("bug: poisoned");
        let rests = weather.until.is_some_and(|until| clock::instant() < until);
        let rests = rests || (!is_beside() && self.patience.is_over(weather.stalled));
        rests.then(|| weather.why.clone())
    }

    /// Why the place did not answer, if it has not answered since.
    pub(super) fn silent(&self) -> Option<String> {
        let weather = self.weather.lock().expect("bug: poisoned");
        weather.reply.then(|| weather.why.clone())
    }

    /// When the place may be asked again, if it rests.
    pub(super) fn rests_until(&self) -> Option<Instant> {
        let weather = self.weather.lock().expect("bug: poisoned");
        weather.until.filter(|until| clock::instant() < *until)
    }

    fn fell_silent(&self, why: &str) {
        let mut weather = self.weather.lock().expect("bug: poisoned");
        weather.wait = (weather.wait * 2).clamp(FIRST_WAIT, LONGEST_WAIT);
        weather.until = Some(clock::instant() + weather.wait);
        weather.why = why.into();
        if !std::mem::replace(&mut weather.reply, true) {
            drop(weather);
            self.report(&format!(
                "it does not answer ({why}): going on without it; what is made waits in the cache and is uploaded later"
            ));
        }
    }

    fn answered(&self) {
        let mut weather = self.weather.lock().expect("bug: poisoned");
        weather.wait = Duration::ZERO;
        weather.until = None;
        weather.stalled = Duration::ZERO;
        if std::mem::replace(&mut weather.reply, false) {
            drop(weather);
            self.report("it answers again");
        }
    }
}
