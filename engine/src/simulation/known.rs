//! What a story knows of a machine.

use stage::Hash;
use std::collections::{BTreeMap, BTreeSet};

/// What is known of a machine beside what it knows itself.
#[derive(Default)]
pub(super) struct Known {
    /// Programs that its user allowed.
    pub(super) granted: BTreeSet<usize>,
    /// How often the user allowed a program.
    pub(super) grants: BTreeMap<usize, u32>,
    /// How often something happened to its files.
    pub(super) losses: u32,
    /// What is being made.
    pub(super) making: BTreeSet<String>,
    /// The contents of each run that came to its end.
    pub(super) runs: BTreeMap<String, Vec<Hash>>,
    /// Whether its disk was ever full.
    pub(super) was_full: bool,
    /// Whether anything went wrong with its disk.
    pub(super) harmed: bool,
    /// Keys and contents of what it made itself, worth a sync.
    pub(super) durable: BTreeSet<(String, String)>,
    /// What the captures were when runs on them came to their end, by their place: contents, hexadecimal.
    pub(super) noted: BTreeMap<usize, BTreeSet<String>>,
    /// Captures whose photos are elsewhere, too, in a folder that it made results of: those are not of its own folder.
    pub(super) elsewhere: BTreeSet<usize>,
    /// Captures that it forgot, and has not been asked for since.
    pub(super) forgotten: BTreeSet<usize>,
}

impl Known {
    /// Nobody knows what is left of the store.
    pub(super) fn lost(&mut self) {
        self.runs.clear();
        self.durable.clear();
        self.noted.clear();
        self.harmed = true;
        self.losses += 1;
    }

    /// A capture is forgotten.
    pub(super) fn gone(&mut self, capture: usize) {
        self.noted.remove(&capture);
        self.forgotten.insert(capture);
    }

    /// A capture is used.
    pub(super) fn touched(&mut self, capture: usize) {
        self.forgotten.remove(&capture);
    }
}
