//! What is run of a program, and within which limits.

use std::path::Path;
use std::time::Duration;

/// What to run, and within which limits.
pub(crate) struct Task<'a> {
    /// What it is called in messages.
    pub(crate) name: &'a str,
    /// The command.
    pub(crate) words: &'a [String],
    /// The folder that it may write into; it works in `work` below it.
    pub(crate) root: &'a Path,
    /// Variables of the environment that it gets.
    pub(crate) env: &'a [String],
    /// Files and folders that it reads beside what it is given.
    pub(crate) reads: &'a [String],
    /// Whether it may reach the network.
    pub(crate) network: bool,
    /// How long it may take.
    pub(crate) timeout: Duration,
    /// What it may hold with its children. \[MB\]
    pub(crate) memory_mb: Option<u64>,
    /// What it may write. \[bytes, files\]
    pub(crate) most: (u64, usize),
}
