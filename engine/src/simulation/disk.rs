//! A machine's disk as one of its processes sees it: a real folder, each step counted and written down, so that it may
//! fail, and the power may go.

use super::process::Process;
use super::seam;
use crate::store::{Step, Steps, User, after_loss, laid};
use proof::Dice;
use std::io::Result;
use std::path::{Path, PathBuf};
use std::sync::Arc;

impl User for Arc<Process> {
    fn step(&self, grows: bool) -> Result<()> {
        seam::step(self, grows)
    }
    fn ends_next(&self) -> bool {
        Process::ends_next(self)
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
