//! Which records a shared store has, by one listing, where asking for each of them would take longer.

use super::inventory::Inventory;
use super::link::Link;
use crate::store::Store;
use buckets::Trouble;
use stage::Hash;
use std::collections::HashSet;
use std::sync::Arc;
use std::time::Duration;
use system::clock;

/// So many records that are not there are asked for one by one; then a listing is worth it.
const ASKED: usize = 8;

/// A store of more records is not listed to its end: a request lists a thousand, and every worker asks. \[records\]
const MOST_LISTED: usize = 10_000;

/// A record that was not there is not asked for again so soon.
const ABSENT_FOR: Duration = Duration::from_secs(2);

/// A listing is believed for so long.
const HOLDS_FOR: Duration = Duration::from_secs(30);

impl Link {
    /// Whether it is worth to ask for the record of a key.
    pub(super) fn may_have(&self, key: &[u8; 32]) -> bool {
        let mut inventory = self.inventory.lock().expect("bug: poisoned");
        if inventory
            .absent
            .get(key)
            .is_some_and(|at| clock::since(*at) < ABSENT_FOR)
        {
            return false;
        }
        // Other machines go on making results.
        if inventory
            .tried
            .is_some_and(|at| clock::since(at) > HOLDS_FOR)
        {
            *inventory = Inventory::default();
        }
        if inventory.missed >= ASKED && inventory.tried.is_none() {
            inventory.tried = Some(clock::instant());
            inventory.listed = self.ask(&|| self.listed(MOST_LISTED)).ok().flatten();
        }
        inventory
            .listed
            .as_ref()
            .is_none_or(|all| all.contains(key))
    }

    /// All keys of records; `None` if there are more than `most`.
    fn listed(&self, most: usize) -> Result<Option<Arc<HashSet<[u8; 32]>>>, Trouble> {
        let mut keys = HashSet::new();
        self.objects.list("ac", &mut |page| {
            let names = page.iter().filter_map(|o| o.name.rsplit('/').next());
            let hashes = names.filter_map(|name| Hash::from_hex(name).ok());
            keys.extend(hashes.map(|hash| *hash.as_bytes()));
            keys.len() <= most
        })?;
        Ok((keys.len() <= most).then(|| Arc::new(keys)))
    }

    /// It was asked for, and is not there.
    pub(super) fn is_absent(&self, key: [u8; 32]) {
        let mut inventory = self.inventory.lock().expect("bug: poisoned");
        inventory.missed += 1;
        inventory.absent.insert(key, clock::instant());
    }
}

impl Store {
    /// The keys of all records of the shared store, asked for now; `None` if there is no such store, it does
    /// not answer, has more than `most`, or a listing does not show what of it is believed.
    pub fn listed(&self, most: usize) -> Option<Arc<HashSet<[u8; 32]>>> {
        let link = self.link.as_ref().filter(|link| !link.is_strict())?;
        let listed = link.ask(&|| link.listed(most)).ok().flatten()?;
        let mut inventory = link.inventory.lock().expect("bug: poisoned");
        inventory.tried = Some(clock::instant());
        inventory.listed = Some(listed.clone());
        Some(listed)
    }
}
