//! A machine's store and its link to the shared one, as a process opens them.

use super::keys::{self, Word};
use super::process::Process;
use super::server::Asked;
use super::story::Use;
use super::world::World;
use crate::store::remote::{Link, drain, working_beside};
use crate::store::{Simulated, Store};
use buckets::{KeysOf, Patience, Seal};
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Duration;

impl World {
    /// Who signs on a process's machine, and whom it believes.
    fn seal(&self, process: &Process) -> Result<KeysOf<Word>, String> {
        let machine = &self.machines[process.machine];
        let believed = machine.setup.uses == Use::Believing;
        let believing = machine.uses.get() == Use::Believing;
        process.believing.store(believing, Ordering::Relaxed);
        let (list, of) = (machine.trust(), Some((self.keys.get(), believing)));
        if machine.listed.replace(of) != of {
            let machines = self.machines.iter();
            let keys = machines.flat_map(|machine| machine.keys.borrow().clone());
            let strange = believed.then_some(&self.strange).cloned();
            let keys: Vec<_> = keys.chain(strange.clone()).collect();
            let revoked: Vec<_> = strange.into_iter().filter(|_| !believing).collect();
            keys::list(&list, &keys, &revoked);
        }
        let own = machine.keys.borrow().last().cloned();
        keys::seal(&own.expect("a key"), &list)
    }

    /// The shared store as a process sees it.
    pub(super) fn link(&self, process: &Arc<Process>) -> Result<Option<Arc<Link>>, String> {
        let machine = &self.machines[process.machine];
        let seal: Option<Box<dyn Seal>> = match machine.uses.get() {
            Use::Alone => return Ok(None),
            Use::Strict | Use::Believing => Some(Box::new(self.seal(process)?)),
            Use::Open | Use::ReadOnly => None,
        };
        let read_only = matches!(machine.uses.get(), Use::ReadOnly | Use::Believing);
        let made = self
            .server
            .objects
            .lock()
            .expect("one thread")
            .contains_key("format");
        if read_only && !made {
            return Ok(None);
        }
        let asked = Asked {
            server: self.server.clone(),
            process: process.clone(),
        };
        let patience = Patience::of(Duration::from_secs(8));
        let report = Box::new(|_: &str| ());
        let link = Link::new(
            &machine.root,
            Box::new(asked),
            read_only,
            seal,
            patience,
            report,
        );
        link.map(|link| Some(Arc::new(link)))
            .map_err(|why| why.to_string())
    }

    /// The shared store as a stranger sees it, with a store at `root`.
    pub(super) fn strangers_link(
        &self,
        root: &std::path::Path,
        process: &Arc<Process>,
        signs: bool,
    ) -> Option<Arc<Link>> {
        let asked = Asked {
            server: self.server.clone(),
            process: process.clone(),
        };
        let (patience, report) = (Patience::default(), Box::new(|_: &str| ()));
        let seal = || -> Box<dyn Seal> { Box::new(keys::strange(&self.strange)) };
        let seal = signs.then(seal);
        let link = Link::new(root, Box::new(asked), false, seal, patience, report);
        link.ok().map(Arc::new)
    }

    /// The store of a process's machine and its link, if anything is written there.
    pub(super) fn to_upload(
        &self,
        process: &Arc<Process>,
    ) -> Result<Option<(Store, Arc<Link>)>, String> {
        let Some(link) = self.link(process)?.filter(|link| !link.is_read_only()) else {
            return Ok(None);
        };
        let store = self.opened(process, Some(link.clone()))?;
        Ok(Some((store, link)))
    }

    /// Uploads what waits.
    pub(super) fn upload(&self, machine: usize, (store, link): (Store, Arc<Link>)) {
        let uploads = &self.machines[machine].uploads;
        uploads.set(uploads.get() + 1);
        link.look_for_more();
        working_beside(|| drain(&store, &link));
    }

    /// The store of a process's machine.
    pub(super) fn store(&self, process: &Arc<Process>) -> Result<Store, String> {
        let link = self.link(process)?;
        self.opened(process, link)
    }

    /// As [`World::store`], over a link that is there.
    pub(super) fn opened(
        &self,
        process: &Arc<Process>,
        link: Option<Arc<Link>>,
    ) -> Result<Store, String> {
        let machine = &self.machines[process.machine];
        let disk = Simulated {
            user: process.clone(),
            steps: machine.steps.clone(),
        };
        Store::simulated(&machine.root, Box::new(disk), link).map_err(|why| why.to_string())
    }
}
