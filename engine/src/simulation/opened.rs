//! A machine's store and its link to the shared one, as a process opens them.

use super::disk::Simulated;
use super::process::Process;
use super::server::{Asked, Seal};
use super::story::Use;
use super::world::World;
use crate::store::Store;
use crate::store::remote::{Link, Patience};
use std::sync::Arc;
use std::time::Duration;

impl World {
    /// The shared store as a process sees it.
    pub(super) fn link(
        &self,
        process: &Arc<Process>,
    ) -> std::result::Result<Option<Arc<Link>>, String> {
        let machine = &self.machines[process.machine];
        let (own, all) = (process.machine, self.machines.len());
        let seal = match machine.uses.get() {
            Use::Alone => return Ok(None),
            Use::Strict => Some(Seal::of(own, all).boxed()),
            Use::Believing => Some(Seal::of(own, all).and_strangers().boxed()),
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
        let say = Box::new(|_: &str| ());
        let link = Link::new(
            &machine.root,
            Box::new(asked),
            read_only,
            seal,
            patience,
            say,
        );
        link.map(|link| Some(Arc::new(link)))
            .map_err(|why| why.to_string())
    }

    /// The shared store as a stranger sees it, with a store at `root`.
    pub(super) fn strangers_link(
        &self,
        root: &std::path::Path,
        process: &Arc<Process>,
        seal: Option<Seal>,
    ) -> Option<Arc<Link>> {
        let asked = Asked {
            server: self.server.clone(),
            process: process.clone(),
        };
        let (patience, say) = (Patience::default(), Box::new(|_: &str| ()));
        let seal = seal.map(Seal::boxed);
        let link = Link::new(root, Box::new(asked), false, seal, patience, say);
        link.ok().map(Arc::new)
    }

    /// The store of a process's machine.
    pub(super) fn store(&self, process: &Arc<Process>) -> std::result::Result<Store, String> {
        let link = self.link(process)?;
        self.opened(process, link)
    }

    /// As [`World::store`], over a link that is there.
    pub(super) fn opened(
        &self,
        process: &Arc<Process>,
        link: Option<Arc<Link>>,
    ) -> std::result::Result<Store, String> {
        let machine = &self.machines[process.machine];
        let disk = Simulated {
            process: process.clone(),
            steps: machine.steps.clone(),
        };
        Store::simulated(&machine.root, Box::new(disk), link).map_err(|why| why.to_string())
    }
}
