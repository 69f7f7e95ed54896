//! Records of runs, read by who removes something: what the disk refuses is an error, and not as good as nothing.

use super::record::{FileLists, Head, Old, all_ids, run_file};
use serde::Deserialize;
use serde::de::DeserializeOwned;
use std::collections::BTreeSet;
use std::fs::File;
use std::io::{BufRead, BufReader, ErrorKind, Lines, Result};
use std::path::Path;

/// The lines of a record, `None` if there is none.
pub(super) fn all_lines(store: &Path, id: &str) -> Result<Option<Lines<BufReader<File>>>> {
    match File::open(run_file(store, id)) {
        Err(why) if why.kind() == ErrorKind::NotFound => Ok(None),
        file => Ok(Some(BufReader::new(file?).lines())),
    }
}

/// What a line has; `None` if it is broken.
fn read<T: DeserializeOwned>(line: Option<Result<String>>) -> Result<Option<T>> {
    match line.transpose() {
        // Bytes that are no text are a broken line.
        Err(why) if why.kind() == ErrorKind::InvalidData => Ok(None),
        line => Ok(line?.and_then(|line| serde_json::from_str(&line).ok())),
    }
}

/// What somebody who sweeps reads of a node.
#[derive(Deserialize)]
struct Made {
    content: Option<String>,
}

/// As [`super::head`], `None` if there is none or it is broken.
///
/// # Errors
///
/// The disk refuses.
pub(crate) fn read_head(store: &Path, id: &str) -> Result<Option<Head>> {
    match all_lines(store, id)? {
        Some(mut lines) => read(lines.next()),
        None => Ok(None),
    }
}

/// As [`super::file_lists`], of a record with this head.
///
/// # Errors
///
/// The disk refuses.
pub(crate) fn read_file_lists(store: &Path, id: &str, head: &Head) -> Result<Option<FileLists>> {
    match all_lines(store, head.same_as.as_deref().unwrap_or(id))? {
        Some(mut lines) => read(lines.nth(1)),
        None => Ok(None),
    }
}

/// The contents of a run's results.
fn contents_of(store: &Path, id: &str) -> Result<Vec<String>> {
    let Some(head) = read_head(store, id)? else {
        return Ok(vec![]);
    };
    let Some(mut lines) = all_lines(store, head.same_as.as_deref().unwrap_or(id))? else {
        return Ok(vec![]);
    };
    let old = read::<Old<Made>>(lines.next())?.map_or(vec![], |old| old.nodes);
    let mut contents: Vec<String> = old.into_iter().filter_map(|node| node.content).collect();
    for line in lines.skip(1) {
        contents.extend(read::<Made>(Some(line))?.and_then(|node| node.content));
    }
    Ok(contents)
}

/// The contents of all results of the last so many runs, and of those that are named.
///
/// # Errors
///
/// The disk refuses: then nobody knows what there is.
pub fn contents(store: &Path, last: usize, named: &BTreeSet<String>) -> Result<BTreeSet<String>> {
    let ids = all_ids(store)?;
    let named = named
        .iter()
        .filter(|id| !ids[..last.min(ids.len())].contains(id));
    let mut contents = BTreeSet::new();
    for id in ids.iter().take(last).chain(named) {
        contents.extend(contents_of(store, id)?);
    }
    Ok(contents)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_broken_record_has_nothing_and_one_that_cannot_be_read_is_an_error() {
        let place = tempfile::tempdir().unwrap();
        let of = |name: &str| contents(place.path(), 9, &BTreeSet::from([name.to_owned()]));
        assert_eq!(of("gone").unwrap(), BTreeSet::new());
        let runs = place.path().join("runs");
        std::fs::create_dir(&runs).unwrap();
        let node = r#"{"node":"a","content":"c"}"#;
        let whole = format!("{{\"seconds\":1.0,\"program\":\"toy\"}}\n{{}}\n{node}\n");
        std::fs::write(runs.join("whole.json"), &whole).unwrap();
        assert_eq!(of("whole").unwrap(), BTreeSet::from(["c".to_owned()]));
        // A flipped bit in a line leaves the rest.
        let other = br#"{"node":"b","content":"d"}"#;
        let bytes = [whole.as_bytes(), b"\xff\xfe\n", other];
        std::fs::write(runs.join("flipped.json"), bytes.concat()).unwrap();
        assert_eq!(of("flipped").unwrap().len(), 2);
        // A folder can be opened, and not be read.
        std::fs::create_dir(runs.join("folder.json")).unwrap();
        assert!(of("folder").is_err());
    }
}
