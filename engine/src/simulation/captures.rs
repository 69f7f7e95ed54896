//! The captures of a story: their photos, and by which words they are found again.

use crate::store::below;
use stage::{FileEntry, Files};
use std::path::Path;

/// Makes the photos of a capture; those of equal numbers are equal on all machines.
pub(super) fn photos(folder: &Path, capture: usize) {
    std::fs::create_dir_all(folder).expect("a folder");
    for photo in 0..2 {
        let text = format!("needle-photo-{capture}-{photo} ");
        std::fs::write(folder.join(format!("{photo}.jpg")), text).expect("a photo");
    }
    std::fs::write(folder.join("plate.jpg"), "of all ").expect("a photo");
}

/// The files of a capture as they are now.
pub(super) fn files(folder: &Path) -> Files {
    let entry = |path: std::path::PathBuf| {
        let bytes = std::fs::read(&path).expect("a photo");
        FileEntry {
            name: path
                .file_name()
                .expect("a name")
                .to_string_lossy()
                .into_owned(),
            content: blake3::hash(&bytes),
            size: bytes.len() as u64,
        }
    };
    Files {
        root: folder.to_owned(),
        entries: below(folder).into_iter().map(entry).collect(),
    }
}

/// Words that nothing has but a capture of this number: its photos, its folder on a machine.
pub(super) fn needles(machine: usize, capture: usize) -> [String; 2] {
    [
        format!("needle-photo-{capture}-"),
        format!("machine-{machine}/needle-name-{capture}-"),
    ]
}

/// Whether a word is among some bytes.
pub(super) fn has(bytes: &[u8], needle: &str) -> bool {
    let needle = needle.as_bytes();
    let mut all = bytes.windows(needle.len());
    all.any(|window| window[0] == needle[0] && window == needle)
}
