//! The store that machines share: objects in memory, and answers that are lost or not true.

use super::process::Process;
use super::seam;
use buckets::{Created, Got, Object, Objects, Trouble};
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex};
use std::time::{Duration, SystemTime};

/// What is in the shared store.
pub(super) struct Server {
    pub(super) objects: Mutex<BTreeMap<String, (Vec<u8>, Duration)>>,
    pub(super) honest: AtomicBool,
    /// So many answers more are not true.
    pub(super) false_answers: AtomicU64,
    pub(super) how: AtomicU64,
    /// So many were not.
    pub(super) lied: AtomicU64,
    /// Whether anything ever went wrong with it.
    pub(super) harmed: AtomicBool,
}

impl Server {
    pub(super) fn new(honest: bool) -> Server {
        Server {
            objects: Mutex::default(),
            honest: honest.into(),
            false_answers: 0.into(),
            how: 0.into(),
            lied: 0.into(),
            harmed: false.into(),
        }
    }

    fn false_answer(&self) -> Option<u64> {
        let left = self.false_answers.load(Ordering::Relaxed);
        self.false_answers
            .store(left.saturating_sub(1), Ordering::Relaxed);
        self.lied.fetch_add(u64::from(left > 0), Ordering::Relaxed);
        (left > 0).then(|| self.how.load(Ordering::Relaxed))
    }
}

/// What is not true in place of some bytes; `None` for the answer that there is nothing.
pub(super) fn spoilt(bytes: &[u8], how: u64) -> Option<Vec<u8>> {
    let mut bytes = bytes.to_vec();
    let at = (how >> 8) as usize % bytes.len().max(1);
    match how % 4 {
        0 => return None,
        1 => bytes.truncate(at),
        _ if bytes.is_empty() => {}
        _ => bytes[at] ^= 1 << (how >> 3 & 7),
    }
    Some(bytes)
}

/// The shared store as a process asks it.
pub(super) struct Asked {
    pub(super) server: Arc<Server>,
    pub(super) process: Arc<Process>,
}

impl Asked {
    /// Does something there, unless the network is cut; the answer may be lost.
    fn ask<T>(&self, ask: impl FnOnce(&Server, Duration) -> T) -> Result<T, Trouble> {
        let down = || Trouble::Down("no answer".into());
        let number = self.process.steps.load(Ordering::Relaxed);
        seam::step(&self.process, false).map_err(|_| down())?;
        let passed = seam::passed(&self.process).ok_or_else(down)?;
        let answer = ask(&self.server, passed);
        match self.process.lost == Some(number) {
            true => Err(down()),
            false => Ok(answer),
        }
    }
}

impl Objects for Asked {
    fn name(&self) -> &str {
        "sim://shared"
    }

    fn get(&self, name: &str, take: &mut dyn FnMut(&[u8]) -> bool) -> Result<Got, Trouble> {
        let found = self.ask(|server, _| {
            let objects = server.objects.lock().expect("one thread");
            let true_bytes = objects.get(name).map(|(bytes, _)| bytes.clone());
            match (server.false_answer(), true_bytes) {
                (Some(how), Some(bytes)) if how % 5 == 4 => {
                    // Another object's.
                    let mut rest = objects.values().cycle().skip(how as usize % 64);
                    rest.next()
                        .map_or(Some(bytes), |(other, _)| Some(other.clone()))
                }
                (Some(how), Some(bytes)) => spoilt(&bytes, how),
                (_, bytes) => bytes,
            }
        })?;
        let Some(bytes) = found else {
            return Ok(Got::Absent);
        };
        // In two parts, as it may come.
        let half = bytes.len() / 2;
        match take(&bytes[..half]) && take(&bytes[half..]) {
            true => Ok(Got::Whole),
            false => Ok(Got::Stopped),
        }
    }

    fn put(&self, name: &str, bytes: &[u8]) -> Result<(), Trouble> {
        self.ask(|server, passed| {
            let mut objects = server.objects.lock().expect("one thread");
            objects.insert(name.to_owned(), (bytes.to_vec(), passed));
        })
    }

    fn create(&self, name: &str, bytes: &[u8]) -> Result<Created, Trouble> {
        self.ask(|server, passed| {
            let mut objects = server.objects.lock().expect("one thread");
            if server.honest.load(Ordering::Relaxed) && objects.contains_key(name) {
                return Created::There;
            }
            objects.insert(name.to_owned(), (bytes.to_vec(), passed));
            Created::New
        })
    }

    fn size(&self, name: &str) -> Result<Option<u64>, Trouble> {
        self.ask(|server, _| {
            let objects = server.objects.lock().expect("one thread");
            let size = objects.get(name).map(|(bytes, _)| bytes.len() as u64);
            match server.false_answer() {
                Some(how) if how % 2 == 0 => None,
                _ => size,
            }
        })
    }

    fn list(&self, folder: &str, take: &mut dyn FnMut(Vec<Object>) -> bool) -> Result<(), Trouble> {
        let below = |name: &str| match folder {
            "" => true,
            _ => name
                .strip_prefix(folder)
                .is_some_and(|n| n.starts_with('/')),
        };
        let page = self.ask(|server, _| {
            let objects = server.objects.lock().expect("one thread");
            let fits = objects.iter().filter(|(name, _)| below(name));
            let object = |(name, (bytes, at)): (&String, &(Vec<u8>, Duration))| Object {
                name: name.clone(),
                bytes: bytes.len() as u64,
                modified: SystemTime::UNIX_EPOCH + Duration::from_secs(2_000_000_000) + *at,
            };
            let mut all: Vec<Object> = fits.map(object).collect();
            if let Some(how) = server.false_answer() {
                all.truncate(how as usize % (all.len() + 1));
            }
            all
        })?;
        take(page);
        Ok(())
    }

    fn remove(&self, name: &str) -> Result<(), Trouble> {
        self.ask(|server, _| {
            let mut objects = server.objects.lock().expect("one thread");
            objects.remove(name);
        })
    }
}
