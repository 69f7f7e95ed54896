//! What may be in a folder, and what a file is called while it is written.

/// What may be in a folder; all else is let be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FileKind {
    /// A plain file.
    File,
    /// A folder.
    Folder,
}

/// What was met below a folder.
#[derive(Debug, Clone)]
pub struct Met {
    /// Its path from that folder on, with `/` between parts; what is no UTF-8 is replaced.
    pub path: String,
    /// Whether its own name is UTF-8.
    pub named: bool,
    /// What it is; none for all but plain files and folders.
    pub kind: Option<FileKind>,
    /// Whether it is a link.
    pub link: bool,
    /// Its size and what shows a change.
    pub stamp: crate::Stamp,
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
    WRITING.to_owned() + &numbered(count)
}

/// A name that nothing else has: this process, how many it named before, and the time.
pub fn numbered(count: u64) -> String {
    let (process, now) = (std::process::id(), crate::clock::now_ns());
    format!("{process}-{count}-{now:x}")
}

/// Whether a name is of the form of [`numbered`].
pub fn is_numbered(name: &str) -> bool {
    let decimal = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
    let hex = |b: u8| b.is_ascii_digit() || (b'a'..=b'f').contains(&b);
    let words: Vec<&str> = name.split('-').collect();
    matches!(words[..], [process, count, now] if decimal(process) && decimal(count)
        && !now.is_empty() && now.bytes().all(hex))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbered_names_are_known() {
        assert!(is_numbered(&numbered(0)) && is_numbered("12-0-17f"));
        assert!(!is_numbered("12-0") && !is_numbered("a-0-1") && !is_numbered("1-0-1F"));
    }
}
