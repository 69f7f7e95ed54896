//! Folders of programs: none is lost to who clears away, and no input is half.

use super::*;
use crate::leftover::clear;
use std::sync::atomic::AtomicBool;

#[test]
fn a_folder_that_is_just_made_is_not_taken_for_one_that_was_left() {
    let store = tempfile::tempdir().unwrap();
    let done = AtomicBool::new(false);
    let all = store.path().join(FOLDER);
    let made = |count: usize| {
        let root = all.join(format!("{}-{count}-0", std::process::id()));
        folder(&root).unwrap();
        let lock = locked(&root);
        let stays = lock.is_ok() && root.join(LOCK).exists();
        drop(lock);
        stays
    };
    std::thread::scope(|threads| {
        threads.spawn(|| {
            while !done.load(Ordering::Relaxed) {
                clear(store.path());
            }
        });
        let lost = (0..TIMES).filter(|count| !made(*count)).count();
        done.store(true, Ordering::Relaxed);
        assert_eq!(lost, 0, "of {TIMES}");
    });
    clear(store.path());
    assert_eq!(std::fs::read_dir(&all).unwrap().count(), 0, "what was left");
}

#[test]
fn a_job_gets_all_of_its_inputs_or_does_not_begin() {
    let store = tempfile::tempdir().unwrap();
    let job = Job::new(&Arc::new(Layout::new(store.path()).unwrap())).unwrap();
    let files = [(String::new(), b"all of it".to_vec())];
    let path = job.written("a", "txt", &files).unwrap();
    assert_eq!(std::fs::read(path).unwrap(), files[0].1);
    // What cannot be written is no input.
    folder(&job.inputs().join("b.txt")).unwrap();
    assert!(job.written("b", "txt", &files).is_err());
}

/// Enough to lose some, were the lock named before it is locked.
const TIMES: usize = 1_000;
