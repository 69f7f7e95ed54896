//! What may be in a folder, and what a file is called while it is written.

/// What may be in a folder; all else is let be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum FileKind {
    /// A plain file.
    File,
    /// A folder.
    Folder,
}

/// What was met below a folder.
#[derive(Debug, Clone)]
pub(crate) struct Met {
    /// Its path from that folder on, with `/` between parts; what is no UTF-8 is replaced.
    pub(crate) path: String,
    /// Whether its own name is UTF-8.
    pub(crate) named: bool,
    /// What it is; none for all but plain files and folders.
    pub(crate) kind: Option<FileKind>,
    /// Whether it is a link.
    pub(crate) link: bool,
    /// Its size and what shows a change.
    pub(crate) stamp: super::Stamp,
}

/// Folders that are deeper in each other are not looked into: each costs open files. \[folders\]
pub(super) const DEEPEST_FOLDERS: usize = 100;

/// Why one is not looked into.
pub(super) fn too_deep() -> std::io::Error {
    std::io::Error::other(format!(
        "has more than {DEEPEST_FOLDERS} folders in each other"
    ))
}

/// What names of files that are being written begin with; process, count and time follow.
pub(super) const WRITING: &str = ".writing-";

/// The name of a file while it is being written.
pub(super) fn writing(count: u64) -> String {
    let (process, now) = (std::process::id(), crate::clock::now_ns());
    format!("{WRITING}{process}-{count}-{now:x}")
}
