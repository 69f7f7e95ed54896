//! A machine's disk as one of its processes sees it: a real folder, each step counted and written down, so that it may
//! fail, and the power may go.

use super::process::Process;
use super::seam;
use crate::store::{Disk, Real, Step, after_loss, laid};
use proof::Dice;
use std::fs::File;
use std::io::{Error, ErrorKind, Result};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};

/// The steps of a disk since it was last known what is on it.
pub(super) type Steps = Arc<Mutex<Vec<Step>>>;

pub(super) struct Simulated {
    pub(super) process: Arc<Process>,
    pub(super) steps: Steps,
}

impl Simulated {
    fn step<T>(&self, step: Step, grows: bool, real: impl FnOnce() -> Result<T>) -> Result<T> {
        seam::step(&self.process, grows)?;
        let done = real()?;
        self.note(step);
        Ok(done)
    }

    fn note(&self, step: Step) {
        self.steps.lock().expect("one thread").push(step);
    }
}

impl Disk for Simulated {
    fn folder(&self, path: &Path) -> Result<()> {
        self.step(Step::Folder(path.into()), true, || Real.folder(path))
    }
    fn create(&self, path: &Path) -> Result<File> {
        self.step(Step::Create(path.into()), true, || Real.create(path))
    }
    fn write(&self, file: &mut File, path: &Path, bytes: &[u8]) -> Result<()> {
        if self.process.ends_next() {
            // Torn: what fails may have written half.
            let half = &bytes[..bytes.len() / 2];
            Real.write(file, path, half)?;
            self.note(Step::Write(path.into(), half.to_vec()));
        }
        let step = Step::Write(path.into(), bytes.to_vec());
        self.step(step, true, || Real.write(file, path, bytes))
    }
    fn sync(&self, _: &File, path: &Path) -> Result<()> {
        self.step(Step::Sync(path.into()), false, || Ok(()))
    }
    fn rename(&self, from: &Path, to: &Path) -> Result<()> {
        let step = Step::Rename(from.into(), to.into());
        self.step(step, false, || Real.rename(from, to))
    }
    fn link(&self, from: &Path, to: &Path) -> Result<()> {
        let step = Step::Link(from.into(), to.into());
        self.step(step, true, || Real.link(from, to))
    }
    fn sync_names(&self, folder: &Path) -> Result<()> {
        self.step(Step::SyncNames(folder.into()), false, || Ok(()))
    }
    fn remove(&self, path: &Path) -> Result<()> {
        self.step(Step::Remove(path.into()), false, || Real.remove(path))
    }
    fn unlink(&self, root: &Path, folders: &[&str], name: &str) -> bool {
        let path = folders.iter().fold(root.to_owned(), |at, f| at.join(f));
        let path = path.join(name);
        if !path.is_file() {
            return false;
        }
        let removed = self.step(Step::Remove(path), false, || {
            match Real.unlink(root, folders, name) {
                true => Ok(()),
                false => Err(Error::from(ErrorKind::NotFound)),
            }
        });
        removed.is_ok()
    }
}

/// The steps that make what is below a folder, all of it safe.
fn made(there: &[(PathBuf, Option<Vec<u8>>)]) -> Vec<Step> {
    let mut steps = Vec::new();
    for (path, file) in there {
        match file {
            None => steps.push(Step::Folder(path.clone())),
            Some(bytes) => steps.extend(written(path, bytes)),
        }
        steps.push(Step::SyncNames(path.parent().expect("below").into()));
    }
    steps
}

/// The steps that write a file so that it is safe.
pub(super) fn written(path: &Path, bytes: &[u8]) -> [Step; 4] {
    [
        Step::Create(path.into()),
        Step::Write(path.into(), bytes.to_vec()),
        Step::Sync(path.into()),
        Step::SyncNames(path.parent().expect("below").into()),
    ]
}

/// The power goes: what of the store is left is what a disk may have kept.
pub(super) fn lose_power(root: &Path, steps: &Steps, seed: u64) {
    let mut steps = steps.lock().expect("one thread");
    // The folder of the store itself was there before.
    let there = after_loss(&steps, root, &mut Dice(seed));
    let _ = std::fs::remove_dir_all(root);
    std::fs::create_dir(root).expect("a folder");
    laid(&there, root, root);
    *steps = made(&there);
}
