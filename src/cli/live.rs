//! What `tailor measure` prints while it runs: what it found, then the part that is on its way; warnings wait
//! for the end.

use super::columns::{broken, wide_err};
use super::first::First;
use super::folder::{Looked, MASKS};
use super::source::Source;
use crate::words::language::Words;
use crate::words::parts::{PARTS, place_of};
use command::Telling;
use engine::walk::{Done, Status};
use stage::Message;
use std::sync::{Arc, Mutex};

/// The nodes that read what is measured: photos, or a scan.
const READERS: [&str; 2] = ["photos", "body"];

/// Of one capture.
pub(super) struct Live {
    words: Words,
    name: String,
    source: Source,
    plate: bool,
    /// Whether masks are there, in place of those that would be made.
    masks: bool,
    /// Whether there is a mat, and how many tags it has.
    mat: Option<Option<u64>>,
    /// Who makes a first answer on the way: what that made is found.
    first: Option<Arc<First>>,
    warnings: Mutex<Vec<Message>>,
}

impl Live {
    /// Of a capture called so, that was looked at.
    pub(super) fn new(
        words: Words,
        name: &str,
        looked: &Looked,
        first: Option<Arc<First>>,
    ) -> Live {
        let mat = |text: &str| text.parse().ok();
        Live {
            words,
            name: name.to_owned(),
            source: looked.source.clone(),
            plate: looked.plate_there,
            masks: looked.source.folder().join(MASKS).is_dir(),
            mat: looked.mat.as_deref().map(mat),
            first,
            warnings: Mutex::default(),
        }
    }

    /// What was warned of so far: for a run that does not come to its end.
    pub(super) fn warnings(&self) -> Vec<Message> {
        self.warnings.lock().expect("bug: poisoned").clone()
    }

    /// What was found, by what the node that reads the photos reports.
    fn found(&self, done: &Done) -> Option<String> {
        if let Source::Scan(..) = self.source {
            return Some(format!("{}: {}", self.name, self.words.text("screen-scan")));
        }
        let metrics = done.metrics.iter();
        let number = |name: &str| Some(metrics.clone().find(|m| m.name == name)?.value);
        let count = number("photos")?;
        let megapixels = number("width")? * number("height")? / 1e6;
        let words = self.words;
        let plate = if self.plate { "there" } else { "none" };
        let put = [
            ("count", (count as usize).into()),
            ("size", words.number(megapixels, 1).into()),
        ];
        let mut facts = vec![words.with("screen-found", &put)];
        let video = matches!(self.source, Source::Video(..));
        facts.extend(video.then(|| words.text("screen-video")));
        facts.push(words.text(&format!("plate-{plate}")));
        facts.extend(self.masks.then(|| words.text("screen-own-masks")));
        facts.extend(self.mat.map(|tags| match tags {
            Some(count) => words.with("screen-mat", &[("count", count.into())]),
            None => words.text("screen-mat-some"),
        }));
        let found = broken(
            &format!("{}: {}", self.name, facts.join(", ")),
            2,
            wide_err(),
        );
        Some(found.trim_end().to_owned())
    }

    fn part(&self, step: usize) -> String {
        self.words.text(&format!("part-{}", PARTS[step].0))
    }
}

impl Telling for Live {
    fn step(&self, node: &str) -> usize {
        place_of(node)
    }

    fn heard(&self, node: &str, done: &Done) -> Vec<String> {
        let warnings = done.warnings.iter().cloned();
        self.warnings
            .lock()
            .expect("bug: poisoned")
            .extend(warnings);
        let well = matches!(done.status, Status::Hit | Status::Executed);
        let scan = matches!(self.source, Source::Scan(..));
        let reader = READERS[usize::from(scan)];
        let found = (node == reader && well).then(|| self.found(done));
        found.flatten().into_iter().collect()
    }

    fn over(&self, step: usize, found: bool) -> String {
        let first = self.first.as_ref().is_some_and(|first| first.begun());
        let how = if found && !first { "cached" } else { "over" };
        let put = [("step", self.part(step).into())];
        self.words.with(&format!("screen-{how}"), &put)
    }

    fn line(&self, step: usize, spent: f64, left: Option<f64>) -> String {
        let (part, spent) = (self.part(step), self.words.duration(spent));
        let left = left.map(|left| {
            let time = self.words.duration(left);
            ", ".to_owned() + &self.words.with("screen-left", &[("time", time.into())])
        });
        let (at, of) = (step + 1, PARTS.len());
        format!("[{at}/{of}] {part}, {spent}{}", left.unwrap_or_default())
    }
}
