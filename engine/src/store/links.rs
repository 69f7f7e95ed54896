//! Which results came of which: the records of a store as a graph.

use super::error::StoreError;
use super::folder::Store;
use super::record::{Record, Unread};
use crate::own;
use stage::Hash;
use std::collections::{BTreeMap, BTreeSet};

/// What a result was made of, and where it is.
pub(super) struct Link {
    pub(super) key: Hash,
    pub(super) content: Hash,
    from: Vec<String>,
}

/// All records, as far as they can be read.
#[derive(Default)]
pub(super) struct Links {
    pub(super) all: Vec<Link>,
    /// Keys of records that cannot be read, and stay: of another version of the program, or the disk refuses.
    pub(super) unread: Vec<Hash>,
    /// Keys of records that were broken, and are put aside by now.
    pub(super) broken: Vec<Hash>,
}

impl Link {
    /// Of a record.
    pub(super) fn of(key: Hash, record: &Record) -> Link {
        let from = record.provenance.iter();
        let from = from.filter(|(what, value)| what.starts_with("from ") && own::is_hash(value));
        Link {
            key,
            content: record.content,
            from: from.map(|(_, value)| value.clone()).collect(),
        }
    }
}

impl Links {
    /// The results that came of some contents, directly or not, by their place in the list: what was made of something
    /// after that.
    pub(super) fn derived(&self, seeds: &BTreeSet<String>) -> Vec<usize> {
        let mut readers: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
        for (i, link) in self.all.iter().enumerate() {
            for from in &link.from {
                readers.entry(from).or_default().push(i);
            }
        }
        let mut open: std::collections::VecDeque<String> = seeds.iter().cloned().collect();
        let (mut found, mut order) = (BTreeSet::new(), Vec::new());
        while let Some(content) = open.pop_front() {
            for i in readers.get(content.as_str()).into_iter().flatten() {
                if found.insert(*i) {
                    order.push(*i);
                    open.push_back(self.all[*i].content.to_hex().to_string());
                }
            }
        }
        order
    }

    /// Which results are certainly nobody's who is to be forgotten: all that they were made of is among `sources`, or
    /// was made by such a result; none of them has one of these keys. What a broken record made is no such thing.
    pub(super) fn alive(
        &self,
        sources: &BTreeSet<String>,
        but: &BTreeSet<[u8; 32]>,
    ) -> BTreeSet<usize> {
        let mut readers: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
        let mut lacks: Vec<usize> = Vec::with_capacity(self.all.len());
        for (i, link) in self.all.iter().enumerate() {
            let from: BTreeSet<&String> = link.from.iter().collect();
            from.iter()
                .for_each(|from| readers.entry(from).or_default().push(i));
            lacks.push(from.len());
        }
        let mut known: BTreeSet<String> = BTreeSet::new();
        let mut open: Vec<String> = sources.iter().cloned().collect();
        let mut alive = BTreeSet::new();
        let mut make = |i: usize, open: &mut Vec<String>| {
            if !but.contains(self.all[i].key.as_bytes()) && alive.insert(i) {
                open.push(self.all[i].content.to_hex().to_string());
            }
        };
        let free = lacks.iter().enumerate().filter(|(_, lacks)| **lacks == 0);
        free.for_each(|(i, _)| make(i, &mut open));
        while let Some(content) = open.pop() {
            if !known.insert(content.clone()) {
                continue;
            }
            for i in readers.get(content.as_str()).into_iter().flatten() {
                lacks[*i] -= 1;
                if lacks[*i] == 0 {
                    make(*i, &mut open);
                }
            }
        }
        alive
    }

    /// Contents that results were made of, and that no record made: those of inputs.
    pub(super) fn inputs(&self) -> BTreeSet<String> {
        let made = self
            .all
            .iter()
            .map(|link| link.content.to_hex().to_string());
        let made: BTreeSet<String> = made.collect();
        let from = self.all.iter().flat_map(|link| &link.from);
        from.filter(|content| !made.contains(*content))
            .cloned()
            .collect()
    }

    /// The contents of some results.
    pub(super) fn contents(&self, some: &BTreeSet<usize>) -> BTreeSet<[u8; 32]> {
        let some = some.iter().map(|i| &self.all[*i]);
        some.map(|link| *link.content.as_bytes()).collect()
    }
}

impl Store {
    /// Every record, with what it was made of.
    ///
    /// # Errors
    ///
    /// They cannot be listed.
    pub(super) fn links(&self) -> Result<Links, StoreError> {
        let mut links = Links::default();
        for key in self.shelf("ac")? {
            match self.read_record(key) {
                Ok(record) => links.all.push(Link::of(key, &record)),
                Err(Unread::Corrupt) => links.broken.push(key),
                Err(Unread::OtherVersion | Unread::Absent | Unread::Disk(_)) => {
                    links.unread.push(key)
                }
            }
        }
        Ok(links)
    }
}
