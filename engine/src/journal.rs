//! The event log of a run: one JSON object a line in `runs/ID.jsonl`, written as things happen.
//!
//! `{"t":1.25,"event":"started","node":"hull"}`, and likewise `progress` (with `label`,
//! `done`, `of`) and `done` (with `status`, `seconds`, `bytes`, and `why` of a failure); `t` is in
//! seconds from the start of the run. A run that makes nothing leaves no log.

use crate::done::{Done, Status, Watch};
use serde_json::{Value, json};
use stage::Hash;
use std::fs::File;
use std::io::Write;
use std::path::PathBuf;
use std::sync::Mutex;
use std::time::Instant;
use system::{private_file, private_folder};

/// Writes down what happens.
pub(crate) struct Journal {
    path: PathBuf,
    start: Instant,
    log: Mutex<Log>,
}

#[derive(Default)]
struct Log {
    file: Option<File>,
    /// Set when the file could not be made: a run is not worth less for it.
    given_up: bool,
    found: usize,
    /// Time of the last progress that was written. \[s\]
    last_line: f64,
}

impl Journal {
    pub(crate) fn new(path: PathBuf) -> Self {
        Journal {
            path,
            start: Instant::now(),
            log: Mutex::default(),
        }
    }

    fn write(&self, log: &mut Log, event: &str, node: &str, more: Value) {
        let t = (self.start.elapsed().as_secs_f64() * 1e6).round() / 1e6;
        if log.file.is_none() && !log.given_up {
            if let Some(folder) = self.path.parent() {
                let _ = private_folder(folder, true);
            }
            let mut open = File::options();
            let open = private_file(open.create(true).append(true)).open(&self.path);
            log.given_up = open.is_err();
            log.file = open.ok();
            let found = json!({ "t": t, "event": "found", "nodes": log.found });
            log.line(&found);
        }
        let mut line = json!({ "t": t, "event": event, "node": node });
        if let (Some(line), Value::Object(more)) = (line.as_object_mut(), more) {
            line.extend(more);
        }
        log.line(&line);
    }
}

impl Log {
    fn line(&mut self, line: &Value) {
        if let Some(file) = &mut self.file {
            let _ = file.write_all(format!("{line}\n").as_bytes());
        }
    }
}

impl Watch for Journal {
    fn started(&self, node: &str) {
        let mut log = self.log.lock().expect("bug: poisoned");
        self.write(&mut log, "started", node, Value::Null);
    }

    fn progress(&self, node: &str, label: &str, done: usize, of: usize) {
        let mut log = self.log.lock().expect("bug: poisoned");
        let t = self.start.elapsed().as_secs_f64();
        if t - log.last_line > 0.2 || done == of {
            log.last_line = t;
            let more = json!({ "label": label, "done": done, "of": of });
            self.write(&mut log, "progress", node, more);
        }
    }

    fn differs(&self, node: &str, theirs: Hash, ours: Hash) {
        let mut log = self.log.lock().expect("bug: poisoned");
        let more = json!({ "theirs": theirs.to_hex().as_str(), "ours": ours.to_hex().as_str() });
        self.write(&mut log, "differs", node, more);
    }

    fn done(&self, node: &str, done: &Done) {
        let mut log = self.log.lock().expect("bug: poisoned");
        if done.status == Status::Hit && log.file.is_none() {
            log.found += 1;
        } else {
            let mut more = json!({
                "status": done.status.word(), "seconds": done.seconds, "bytes": done.bytes,
            });
            if let Status::Failed(why) = &done.status {
                more["why"] = json!(why);
            }
            self.write(&mut log, "done", node, more);
        }
    }
}
