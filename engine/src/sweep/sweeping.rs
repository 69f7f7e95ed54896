//! What the points of a sweep have in common.

use super::points::Point;
use crate::graph::Graph;
use crate::outcome::Outcome;
use crate::session::Options;
use crate::walk::Watch;
use stage::Metric;
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;

/// Errors of results against ground truth.
pub type Errors<'a> = dyn Fn(&Graph, &Outcome) -> Result<Vec<Metric>, String> + 'a;

/// What all points have in common.
pub struct Sweeping<'a> {
    /// The pipeline at a point.
    pub open: &'a dyn Fn(&Point) -> Result<Graph, String>,
    /// The nodes that are wanted; none is the pipeline's goal.
    pub nodes: &'a [String],
    /// The user's folders.
    pub folders: &'a [(String, PathBuf)],
    /// How to run.
    pub options: &'a Options,
    /// `node.metric`; none is all that the wanted nodes have.
    pub tell: &'a [String],
    /// Errors of a point's results against ground truth, as `error.…`.
    pub errors: Option<&'a Errors<'a>>,
    /// Who hears what happens inside a point.
    pub watch: &'a dyn Watch,
    /// Set when the user asks to stop.
    pub cancel: &'a AtomicBool,
}
