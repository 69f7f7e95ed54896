//! Which keys this store knows to be in a shared one, so that nobody asks for them again.
//!
//! `shared/TAG` in the store: the identity of the shared store, then keys of 32 bytes, appended. A shared
//! store that was made anew or swept has another identity, and then nothing is known.

use std::collections::HashSet;
use std::fs::OpenOptions;
use std::io::Write;
use std::path::{Path, PathBuf};
use system::private_file;

/// The keys that are known to be there.
#[derive(Debug, Default)]
pub(super) struct Known {
    keys: HashSet<[u8; 32]>,
    file: Option<PathBuf>,
}

impl Known {
    /// Of the store at `root`, for a shared store of this tag and identity.
    pub(super) fn load(root: &Path, tag: &str, identity: [u8; 32]) -> Known {
        let folder = root.join("shared");
        let file = folder.join(tag);
        let bytes = std::fs::read(&file).unwrap_or_default();
        let (chunks, _) = bytes.as_chunks::<32>();
        if chunks.first() != Some(&identity) {
            let _ = system::private_folder(&folder, true);
            let _ = std::fs::remove_file(&file);
            append(&file, &identity);
        }
        let keys = match chunks.split_first() {
            Some((first, keys)) if *first == identity => keys.iter().copied().collect(),
            _ => HashSet::new(),
        };
        let file = Some(file);
        Known { keys, file }
    }

    pub(super) fn has(&self, key: &[u8; 32]) -> bool {
        self.keys.contains(key)
    }

    /// Best effort: what is not remembered is asked again.
    pub(super) fn add(&mut self, key: [u8; 32]) {
        if self.keys.insert(key)
            && let Some(file) = &self.file
        {
            append(file, &key);
        }
    }

    /// It is not there, whatever was known.
    pub(super) fn lose(&mut self, key: &[u8; 32]) {
        self.keys.remove(key);
    }
}

/// One write of 32 bytes at the end: processes side by side do not tear each other's.
fn append(file: &Path, key: &[u8; 32]) {
    let mut open = OpenOptions::new();
    let open = private_file(open.append(true).create(true)).open(file);
    let _ = open.and_then(|mut file| file.write_all(key));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_known_is_of_one_identity_and_a_torn_end_is_passed_over() {
        let place = tempfile::tempdir().unwrap();
        let load = |n: u8| Known::load(place.path(), "00ff00ff00ff00ff", [n; 32]);
        let mut known = load(1);
        known.add([7; 32]);
        known.add([8; 32]);
        assert!(load(1).has(&[7; 32]) && load(1).has(&[8; 32]) && !load(1).has(&[1; 32]));
        let file = place.path().join("shared/00ff00ff00ff00ff");
        let bytes = std::fs::read(&file).unwrap();
        std::fs::write(&file, &bytes[..bytes.len() - 3]).unwrap();
        assert!(load(1).has(&[7; 32]) && !load(1).has(&[8; 32]));
        assert!(!load(2).has(&[7; 32]) && !load(1).has(&[7; 32]));
    }
}
