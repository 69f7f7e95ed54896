//! Systems without Landlock: nobody is confined.

use std::path::PathBuf;

/// What a process is given.
#[derive(Debug, Default)]
pub(crate) struct Given {
    /// Files and folders to read, and to start programs of.
    pub(crate) read: Vec<PathBuf>,
    /// Files and folders to write, too.
    pub(crate) write: Vec<PathBuf>,
    /// The network.
    pub(crate) network: bool,
}

/// Refuses: there is no such thing here.
///
/// # Errors
///
/// Always.
pub(crate) fn confine(_given: &Given) -> Result<bool, String> {
    Err("Landlock: only Linux has it".into())
}
