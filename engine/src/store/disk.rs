//! What publishing asks of a disk, in single steps: the real one, and in tests one that loses power.

use crate::own;
use std::fs::{self, File, OpenOptions};
use std::io::{Result, Write};
use std::path::Path;
use system::{nofollow, private_file, private_folder};

/// The steps. Paths are those that the store uses; a file is written by who made it.
pub(crate) trait Disk: Send + Sync {
    /// Makes a folder, mode 0700; one that is there is as good.
    fn folder(&self, path: &Path) -> Result<()> {
        match private_folder(path, false) {
            Err(error) if !path.is_dir() => Err(error),
            _ => Ok(()),
        }
    }

    /// Makes a file that is not there yet, mode 0600.
    fn create(&self, path: &Path) -> Result<File> {
        let mut open = OpenOptions::new();
        private_file(open.write(true).create_new(true)).open(path)
    }

    /// Writes bytes behind those that are there.
    fn write(&self, file: &mut File, _path: &Path, bytes: &[u8]) -> Result<()> {
        file.write_all(bytes)
    }

    /// Whatever was written outlives a loss of power, once this is done; the name need not.
    fn sync(&self, file: &File, _path: &Path) -> Result<()> {
        file.sync_data()
    }

    /// Gives a file another name, over what has that name.
    fn rename(&self, from: &Path, to: &Path) -> Result<()> {
        fs::rename(from, to)
    }

    /// Gives a file another name, if nothing has that name.
    fn link(&self, from: &Path, to: &Path) -> Result<()> {
        fs::hard_link(from, to)
    }

    /// The names in a folder outlive a loss of power, once this is done.
    fn sync_names(&self, folder: &Path) -> Result<()> {
        nofollow::sync(folder)
    }

    /// Removes a file.
    fn remove(&self, path: &Path) -> Result<()> {
        fs::remove_file(path)
    }

    /// Removes a plain file of the store at `root`, never through a link; whether it was there.
    fn unlink(&self, root: &Path, folders: &[&str], name: &str) -> bool {
        own::remove(root, folders, name)
    }
}

/// The disk that there is.
pub(crate) struct Real;

impl Disk for Real {}
