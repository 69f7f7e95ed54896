//! A capture between what is given of it and its results: what will run, and where results go.

use super::delivered::write;
use crate::delivery::Delivery;
use crate::engine::Outcome;
use crate::graph::Graph;
use command::{Fault, GlobalArgs, finish, whose};
use stage::Message;
use std::path::PathBuf;

/// A capture that is ready to be measured: nothing has run.
pub(crate) struct Prepared {
    /// What runs.
    pub(crate) graph: Graph,
    /// What it reads.
    pub(crate) folders: Vec<(String, PathBuf)>,
    /// The nodes whose results are written, or give files their names.
    pub(crate) wanted: Vec<usize>,
    /// What the user should know of the folder.
    pub(crate) warnings: Vec<Message>,
    /// What was handed over.
    pub(super) capture: PathBuf,
    /// Where results will be.
    pub(super) out: PathBuf,
    /// What the capture is called.
    pub(super) shown: String,
}

impl Prepared {
    /// Whose the results are, as their folder has it.
    pub(super) fn whose(&self) -> String {
        whose(&[("photos".to_owned(), self.capture.clone())])
    }

    /// Writes the results; with `clean`, what an earlier run wrote and this one does not is removed.
    ///
    /// # Errors
    ///
    /// The folder cannot be written.
    pub(crate) fn deliver(
        &self,
        outcome: &Outcome,
        clean: bool,
        global: &GlobalArgs,
    ) -> Result<(), Fault> {
        let mut delivery = Delivery::open(&self.out, &self.whose()).map_err(Fault::stage)?;
        delivery.begin().map_err(Fault::stage)?;
        write(&self.graph, outcome, &self.shown, &mut delivery)?;
        finish(delivery, &self.graph, outcome, clean, global)
    }
}
