//! What may lie in a folder, and what a file is called while it is written.

/// What may lie in a folder; all else is let be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum FileKind {
    /// A plain file.
    File,
    /// A folder.
    Folder,
}

/// What names of files that are being written begin with; process, count and time follow.
pub(super) const WRITING: &str = ".writing-";

/// The name of a file while it is being written.
pub(super) fn writing(count: u64) -> String {
    let (process, now) = (std::process::id(), crate::clock::now_ns());
    format!("{WRITING}{process}-{count}-{now:x}")
}
