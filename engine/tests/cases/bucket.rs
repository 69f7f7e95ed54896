//! A place of objects in memory with faults as chosen: answers that are errors or lost, a server that
//! is gone, other bytes, a create that writes over, no rights.

use buckets::{Created, Got, Object, Objects, Trouble};
use proof::Dice;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex};
use std::time::{Duration, SystemTime};

/// How it fails.
#[derive(Default)]
pub(crate) struct Faults {
    /// The share of requests that are answered by an error.
    pub(crate) errors: f64,
    /// The share of requests that are done, and whose answer is lost or cut.
    pub(crate) lost: f64,
    /// The share of creates that are answered as under way already (409), and are not.
    pub(crate) conflicts: f64,
    pub(crate) gone: bool,
    /// A create writes over what is there.
    pub(crate) overwrites: bool,
    /// What every write is answered.
    pub(crate) refuses: Option<&'static str>,
    /// How long each request takes.
    pub(crate) takes: Duration,
}

struct State {
    objects: BTreeMap<String, (Vec<u8>, SystemTime)>,
    faults: Faults,
    dice: Dice,
    requests: usize,
    ahead: Duration,
}

/// The place: clones are the same.
#[derive(Clone)]
pub(crate) struct Bucket(Arc<Mutex<State>>);

impl Bucket {
    pub(crate) fn new() -> Bucket {
        Bucket(Arc::new(Mutex::new(State {
            objects: BTreeMap::new(),
            faults: Faults::default(),
            dice: Dice(7),
            requests: 0,
            ahead: Duration::ZERO,
        })))
    }
    pub(crate) fn fail(&self, faults: Faults) {
        self.0.lock().unwrap().faults = faults;
    }
    /// How many requests came since this was asked the last time.
    pub(crate) fn requests(&self) -> usize {
        std::mem::take(&mut self.0.lock().unwrap().requests)
    }
    /// Its clock goes on.
    pub(crate) fn later(&self, by: Duration) {
        self.0.lock().unwrap().ahead += by;
    }
    pub(crate) fn names(&self, folder: &str) -> Vec<String> {
        let state = self.0.lock().unwrap();
        let names = state.objects.keys().filter(|n| n.starts_with(folder));
        names.cloned().collect()
    }
    pub(crate) fn bytes(&self, name: &str) -> Vec<u8> {
        self.0.lock().unwrap().objects[name].0.clone()
    }
    /// Changes an object behind everybody's back.
    pub(crate) fn change(&self, name: &str, change: impl Fn(&mut Vec<u8>)) {
        change(&mut self.0.lock().unwrap().objects.get_mut(name).unwrap().0);
    }
    pub(crate) fn write(&self, name: &str, bytes: &[u8]) {
        let now = (bytes.to_vec(), now());
        self.0.lock().unwrap().objects.insert(name.into(), now);
    }

    /// One request: it may fail before it is done, or after.
    fn request<T>(&self, writes: bool, act: impl FnOnce(&mut State) -> T) -> Result<T, Trouble> {
        let takes = self.0.lock().unwrap().faults.takes;
        std::thread::sleep(takes);
        let mut state = self.0.lock().unwrap();
        state.requests += 1;
        if state.faults.gone {
            return Err(Trouble::Down("connection refused".into()));
        }
        if let Some(why) = state.faults.refuses.filter(|_| writes) {
            return Err(Trouble::Refused(why.into()));
        }
        if state.dice.unit() < state.faults.errors {
            return Err(Trouble::Down("500".into()));
        }
        let done = act(&mut state);
        match state.dice.unit() < state.faults.lost {
            true => Err(Trouble::Down("the answer was cut".into())),
            false => Ok(done),
        }
    }
}

fn now() -> SystemTime {
    SystemTime::UNIX_EPOCH + Duration::from_nanos(system::clock::now_ns() as u64)
}

impl State {
    fn put(&mut self, name: &str, bytes: &[u8]) {
        let now = now() + self.ahead;
        self.objects.insert(name.into(), (bytes.to_vec(), now));
    }
}

impl Objects for Bucket {
    fn name(&self) -> &str {
        "memory://bucket"
    }
    fn get(&self, name: &str, take: &mut dyn FnMut(&[u8]) -> bool) -> Result<Got, Trouble> {
        let found = self.request(false, |state| state.objects.get(name).cloned());
        match found {
            Ok(None) => Ok(Got::Absent),
            Ok(Some((bytes, _))) => match bytes.chunks(10_000).all(take) {
                true => Ok(Got::Whole),
                false => Ok(Got::Stopped),
            },
            Err(trouble) => {
                // Some of it came.
                take(b"half of");
                Err(trouble)
            }
        }
    }
    fn put(&self, name: &str, bytes: &[u8]) -> Result<(), Trouble> {
        self.request(true, |state| state.put(name, bytes))
    }
    fn create(&self, name: &str, bytes: &[u8]) -> Result<Created, Trouble> {
        self.request(true, |state| {
            if state.dice.unit() < state.faults.conflicts {
                return Created::There;
            }
            if state.objects.contains_key(name) && !state.faults.overwrites {
                return Created::There;
            }
            state.put(name, bytes);
            Created::New
        })
    }
    fn size(&self, name: &str) -> Result<Option<u64>, Trouble> {
        self.request(false, |state| {
            state.objects.get(name).map(|(bytes, _)| bytes.len() as u64)
        })
    }
    fn list(&self, folder: &str, take: &mut dyn FnMut(Vec<Object>) -> bool) -> Result<(), Trouble> {
        let object = |(name, (bytes, modified)): (&String, &(Vec<u8>, SystemTime))| Object {
            name: name.clone(),
            bytes: bytes.len() as u64,
            modified: *modified,
        };
        let below = |name: &str| folder.is_empty() || name.starts_with(&format!("{folder}/"));
        let objects: Vec<Object> = self.request(false, |state| {
            let objects = state.objects.iter().filter(|(name, _)| below(name));
            objects.map(object).collect()
        })?;
        for (at, page) in objects.chunks(1000).enumerate() {
            if at > 0 {
                self.request(false, |_| ())?;
            }
            if !take(page.to_vec()) {
                break;
            }
        }
        Ok(())
    }
    fn remove(&self, name: &str) -> Result<(), Trouble> {
        self.request(true, |state| _ = state.objects.remove(name))
    }
}
