//! Forgetting in a shared store: every record there is read, whoever wrote it, so that what other machines made of a
//! capture goes, too; and every plan.

use super::super::links::{Link as Made, Links};
use super::super::record::Unread;
use super::super::trace::Trace;
use super::framed;
use super::link::Link;
use super::plans;
use super::reads::{askers, object};
use crate::own;
use crate::store::{Store, StoreError};
use buckets::{Got, Trouble, at_most, whole};
use stage::Hash;
use std::collections::BTreeSet;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread::Builder;

impl Store {
    /// Removes from the shared store, if there is one, what came of a folder, and what goes here; the names of what
    /// cannot be read there and may be of it.
    ///
    /// # Errors
    ///
    /// It does not answer, refuses, or nothing is to be written there.
    pub(in crate::store) fn forget_elsewhere(
        &self,
        trace: &Trace,
        here: &Links,
        stay: &BTreeSet<usize>,
    ) -> Result<Vec<String>, StoreError> {
        let Some(link) = &self.link else {
            return Ok(vec![]);
        };
        let shared = |why: String| StoreError::Shared {
            name: link.name().to_owned(),
            why: format!("nothing was removed here: {why}"),
        };
        if link.is_read_only() {
            return Err(shared(
                "leave --store-read-only out to remove there, too".into(),
            ));
        }
        let unread = link.forget(trace, here, stay);
        unread.map_err(|why| shared(why.to_string()))
    }
}

impl Link {
    fn forget(
        &self,
        trace: &Trace,
        here: &Links,
        stay: &BTreeSet<usize>,
    ) -> Result<Vec<String>, Trouble> {
        let there = self.links()?;
        let going = (0..here.all.len()).filter(|i| !stay.contains(i));
        let going: BTreeSet<usize> = going.collect();
        let keys = going.iter().map(|i| here.all[*i].key);
        let keys = keys.chain(here.broken.iter().copied());
        let mut keys: BTreeSet<[u8; 32]> = keys.map(|key| *key.as_bytes()).collect();
        // Whose inputs there are is not known there: all but those of the folder are somebody's.
        let mut contents = &here.contents(&going) - &here.contents(stay);
        let hex = |content: &[u8; 32]| Hash::from_bytes(*content).to_hex().to_string();
        let mine: BTreeSet<String> = contents.iter().map(hex).collect();
        let sources = &(&there.inputs() - &trace.seeds) - &mine;
        let stay = there.alive(&sources, &keys);
        for (_, link) in there
            .all
            .iter()
            .enumerate()
            .filter(|(i, _)| !stay.contains(i))
        {
            contents.insert(*link.content.as_bytes());
            keys.insert(*link.key.as_bytes());
        }
        let stay = there.contents(&stay);
        for content in contents.difference(&stay) {
            let name = object("cas", Hash::from_bytes(*content));
            self.ask(&|| self.objects.remove(&name))?;
        }
        for key in &keys {
            let name = object("ac", Hash::from_bytes(*key));
            self.ask(&|| self.objects.remove(&name))?;
            self.known().lose(key);
        }
        let unread = there.unread.iter().chain(&there.broken);
        let unread = unread.filter(|key| !keys.contains(key.as_bytes()));
        let mut unread: Vec<String> = unread
            .map(|key| format!("{}/{}", self.name(), object("ac", *key)))
            .collect();
        unread.extend(self.forget_plans(trace)?);
        Ok(unread)
    }

    /// All records there. Broken ones name nothing, and may be of anything: they are named, and go with `sweep-store`, or
    /// when they are made again.
    fn links(&self) -> Result<Links, Trouble> {
        let keys = self.ask(&|| {
            let mut keys = Vec::new();
            self.objects.list("ac", &mut |page| {
                let names = page.iter().filter_map(|o| o.name.rsplit('/').next());
                keys.extend(names.filter_map(|name| Hash::from_hex(name).ok()));
                true
            })?;
            Ok(keys)
        })?;
        let (next, links, failed) = (AtomicUsize::new(0), Mutex::default(), Mutex::new(None));
        let work = || {
            while let Some(key) = keys.get(next.fetch_add(1, Ordering::Relaxed)) {
                let name = object("ac", *key);
                let read = self.ask(&|| at_most(&*self.objects, &name, framed::MOST));
                let mut links: std::sync::MutexGuard<'_, Links> =
                    links.lock().expect("bug: poisoned");
                match read {
                    Ok((Got::Whole, bytes)) => match framed::parse(&bytes, *key) {
                        Ok(framed) => links.all.push(Made::of(*key, &framed.record)),
                        Err(Unread::OtherVersion) => links.unread.push(*key),
                        Err(_) => links.broken.push(*key),
                    },
                    Ok((Got::Absent, _)) => {}
                    Ok((Got::Stopped, _)) => links.broken.push(*key),
                    Err(why) => _ = failed.lock().expect("bug: poisoned").get_or_insert(why),
                }
            }
        };
        std::thread::scope(|scope| {
            for _ in 1..askers(keys.len()) {
                // Where the system gives no more threads, those that there are ask it all.
                let _ = Builder::new().spawn_scoped(scope, work);
            }
            work();
        });
        match failed.into_inner().expect("bug: poisoned") {
            Some(why) => Err(why),
            None => Ok(links.into_inner().expect("bug: poisoned")),
        }
    }

    /// Removes the plans that name the folder or its files; the names of those that cannot be read.
    fn forget_plans(&self, trace: &Trace) -> Result<Vec<String>, Trouble> {
        let mut unread = Vec::new();
        for name in self.ask(&|| plans::listed(self, |_| true))? {
            let file = plans::object(&name);
            let found = self.ask(&|| whole(&*self.objects, &file, plans::MOST))?;
            let found = found.filter(|_| own::is_hash(&name));
            match found.and_then(|bytes| trace.is_in_plan(&name, &bytes)) {
                Some(false) => {}
                Some(true) => {
                    self.ask(&|| self.objects.remove(&file))?;
                    self.ask(&|| self.objects.remove(&plans::seal(&name)))?;
                }
                None => unread.push(format!("{}/{file}", self.name())),
            }
        }
        Ok(unread)
    }
}
