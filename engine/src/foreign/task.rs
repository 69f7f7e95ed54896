//! What is run of a program, and within which limits.

use std::path::Path;
use std::time::Duration;

/// What to run, and within which limits.
pub(super) struct Task<'a> {
    /// What it is called in messages.
    pub(super) name: &'a str,
    /// The command.
    pub(super) words: &'a [String],
    /// The folder that it may write into; it works in `work` below it.
    pub(super) root: &'a Path,
    /// Variables of the environment that it gets.
    pub(super) env: &'a [String],
    /// Files and folders that it reads beside what it is given.
    pub(super) reads: &'a [String],
    /// Whether it may reach the network.
    pub(super) network: bool,
    /// How long it may take.
    pub(super) timeout: Duration,
    /// What it may hold with its children. \[MB\]
    pub(super) memory_mb: Option<u64>,
    /// What it may write. \[bytes, files\]
    pub(super) most: (u64, usize),
}
