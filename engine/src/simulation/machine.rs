//! A machine of a story: its disk, clock and captures, how it uses the shared store, and what is known of it.

use super::captures::{files, photos};
use super::keys::Key;
use super::known::Known;
use super::story::{CAPTURES, Setup, Use};
use crate::store::Steps;
use stage::Files;
use std::cell::{Cell, RefCell};
use std::path::{Path, PathBuf};

/// A machine.
pub(super) struct Machine {
    pub(super) setup: Setup,
    pub(super) uses: Cell<Use>,
    /// Its keys, the one that it signs with last.
    pub(super) keys: RefCell<Vec<Key>>,
    /// Of which keys there were its list of those who are trusted is, and whether a stranger's is among them.
    pub(super) listed: Cell<Option<(usize, bool)>>,
    /// Whether anybody did anything on it.
    pub(super) acted: Cell<bool>,
    /// How often it began to upload.
    pub(super) uploads: Cell<u32>,
    /// Whether it ever believed those whom nobody is to believe.
    pub(super) believed_all: Cell<bool>,
    pub(super) root: PathBuf,
    pub(super) state: PathBuf,
    captures: Vec<PathBuf>,
    /// The files of each as they are, once somebody asked.
    files: RefCell<Vec<Option<Files>>>,
    pub(super) steps: Steps,
    pub(super) ahead_s: Cell<i64>,
    pub(super) full: Cell<bool>,
    pub(super) cut: Cell<bool>,
    /// Processes that are alive on it.
    pub(super) active: Cell<usize>,
    /// How many of them run stages just now, and how many sweep.
    pub(super) working: Cell<usize>,
    pub(super) sweeping: Cell<usize>,
    pub(super) known: RefCell<Known>,
}

impl Machine {
    /// As a story begins, in a folder.
    pub(super) fn new(at: &Path, setup: &Setup, key: Key) -> Machine {
        let captures = (0..CAPTURES).map(|c| at.join(format!("needle-name-{c}-")));
        let root = at.join("cache");
        std::fs::create_dir_all(&root).expect("a folder");
        Machine {
            setup: setup.clone(),
            uses: Cell::new(setup.uses),
            keys: RefCell::new(vec![key]),
            listed: Cell::new(None),
            acted: Cell::new(false),
            uploads: Cell::new(0),
            believed_all: Cell::new(matches!(setup.uses, Use::Open | Use::ReadOnly)),
            root,
            state: at.join("state"),
            captures: captures.collect(),
            files: RefCell::new(vec![None; CAPTURES]),
            steps: Steps::default(),
            ahead_s: Cell::new(setup.ahead_s),
            full: Cell::new(false),
            cut: Cell::new(false),
            active: Cell::new(0),
            working: Cell::new(0),
            sweeping: Cell::new(0),
            known: RefCell::default(),
        }
    }

    /// The folder of a capture, made when somebody asks for it.
    pub(super) fn capture(&self, capture: usize) -> &Path {
        let folder = &self.captures[capture];
        if self.files.borrow()[capture].is_none() {
            if !folder.exists() {
                photos(folder, capture);
            }
            self.files.borrow_mut()[capture] = Some(files(folder));
        }
        folder
    }

    /// The files of a capture.
    pub(super) fn files(&self, capture: usize) -> Files {
        self.capture(capture);
        let files = self.files.borrow()[capture].clone();
        files.expect("looked at a moment ago")
    }

    /// Edits a capture.
    pub(super) fn edit(&self, capture: usize) {
        let path = self.capture(capture).join("0.jpg");
        let mut bytes = std::fs::read(&path).expect("a photo");
        bytes.extend(format!("needle-photo-{capture}-again ").into_bytes());
        std::fs::write(&path, bytes).expect("a photo");
        self.files.borrow_mut()[capture] = None;
    }

    /// Its list of those who are trusted.
    pub(super) fn trust(&self) -> PathBuf {
        self.root.with_file_name("trust")
    }
}
