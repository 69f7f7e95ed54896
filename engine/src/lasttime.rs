//! What nodes were the last time: in the newest run of the same pipeline, variant and input, else
//! in the newest run at all.

use crate::past::NodeLine;
use crate::past::{self, Of};
use std::cell::RefCell;
use std::collections::HashMap;
use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use system::read_exact_at;

/// Earlier runs, read one by one as far back as somebody asks.
pub struct History {
    store: PathBuf,
    of: Of,
    state: RefCell<Read>,
}

#[derive(Default)]
struct Read {
    begun: bool,
    left: Vec<String>,
    /// The runs that were read, the newest of the same first.
    runs: Vec<Index>,
}

/// Where each node with a result is in the record of a run. \[bytes\]
struct Index {
    id: String,
    file: File,
    places: HashMap<Box<str>, (u64, u32)>,
}

/// As far back as it goes for any node: an index of each is in memory.
const MOST_RUNS: usize = 12;

impl History {
    /// Of a store, for what is to be run.
    pub fn of(store: &Path, of: Of) -> History {
        History {
            store: store.into(),
            of,
            state: RefCell::default(),
        }
    }

    /// The node's entry in the newest run that has one with a result.
    pub fn last(&self, node: &str) -> Option<NodeLine> {
        self.last_with_run(node).map(|(_, node)| node)
    }

    /// As [`History::last`], with the run.
    pub fn last_with_run(&self, node: &str) -> Option<(String, NodeLine)> {
        let mut state = self.state.borrow_mut();
        if !state.begun {
            state.begun = true;
            state.left = self.order();
        }
        let mut at = 0;
        loop {
            if at == state.runs.len() && !self.read_one(&mut state) {
                return None;
            }
            let index = &state.runs[at];
            if let Some((start, length)) = index.places.get(node) {
                let mut line = vec![0; *length as usize];
                read_exact_at(&index.file, &mut line, *start).ok()?;
                return Some((index.id.clone(), serde_json::from_slice(&line).ok()?));
            }
            at += 1;
        }
    }

    /// All runs, the newest last; those of the same pipeline after the rest.
    fn order(&self) -> Vec<String> {
        let same = |id: &String| past::head(&self.store, id).is_some_and(|h| h.of == self.of);
        let (same, mut rest): (Vec<String>, Vec<String>) =
            past::ids(&self.store).into_iter().partition(same);
        rest.reverse();
        rest.extend(same.into_iter().rev());
        rest
    }

    /// Reads one run further back.
    fn read_one(&self, state: &mut Read) -> bool {
        while let Some(id) = state.left.pop().filter(|_| state.runs.len() < MOST_RUNS) {
            // A run that found all of an earlier one has nothing that the earlier one has not.
            let head = past::head(&self.store, &id).unwrap_or_default();
            let id = head.same_as.unwrap_or(id);
            if state.runs.iter().any(|run| run.id == id) {
                continue;
            }
            if let Some(index) = self.index(id) {
                state.runs.push(index);
                return true;
            }
        }
        false
    }

    fn index(&self, id: String) -> Option<Index> {
        let path = past::run_file(&self.store, &id);
        let mut lines = BufReader::new(File::open(&path).ok()?);
        let (mut places, mut at, mut line) = (HashMap::new(), 0u64, Vec::new());
        while lines.read_until(b'\n', &mut line).ok()? > 0 {
            if let Some(name) = named(&line) {
                places.insert(name.into(), (at, line.len() as u32));
            }
            at += line.len() as u64;
            line.clear();
        }
        let file = File::open(path).ok()?;
        Some(Index { id, file, places })
    }
}

/// The name of a line's node, if it has a result. Names are plain letters.
fn named(line: &[u8]) -> Option<&str> {
    let rest = line.strip_prefix(b"{\"node\":\"")?;
    let end = rest.iter().position(|b| *b == b'"')?;
    match rest[end..].starts_with(b"\",\"content\":null") {
        true => None,
        false => std::str::from_utf8(&rest[..end]).ok(),
    }
}
