//! What is remembered of a capture beside its files.

use super::facts::{Facts, Plate};
use crate::catalog::is_plate;
use serde::{Deserialize, Serialize};
use stage::Message;
use std::collections::BTreeMap;

/// A file of a capture.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Kept {
    /// What its owner calls it; shown, never a path.
    pub(super) name: String,
    /// Its name in the folder: its number in turning order.
    pub(super) file: String,
    /// \[bytes\]
    pub(super) bytes: u64,
    /// Width and height, where they are known. \[px\]
    pub(super) size: Option<[u32; 2]>,
    /// Whether it is a video.
    pub(super) video: bool,
}

/// What is remembered.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Record {
    /// What its owner calls it.
    pub(super) name: String,
    /// When it began. \[s since 1970\]
    pub(super) begun: u64,
    /// Its files by their number in turning order.
    pub(super) files: BTreeMap<u32, Kept>,
    /// What is known of it.
    #[serde(default)]
    pub(super) facts: Facts,
    /// How often the facts were changed.
    #[serde(default)]
    pub(super) version: u64,
}

impl Record {
    /// All files. \[bytes\]
    pub(super) fn bytes(&self) -> u64 {
        self.files.values().map(|f| f.bytes).sum()
    }

    /// The photo of the empty scene with its number: the one that was chosen, else the first that is called so.
    pub(super) fn plate(&self) -> Option<(u32, &Kept)> {
        let mut photos = self.files.iter().filter(|(_, kept)| !kept.video);
        let found = match self.facts.plate {
            Plate::ByName => photos.find(|(_, kept)| is_plate(&kept.name)),
            Plate::Nothing => None,
            Plate::Photo(number) => photos.find(|(n, _)| **n == number),
        };
        found.map(|(number, kept)| (*number, kept))
    }

    /// A text with the files named as their owner calls them.
    pub(super) fn named(&self, text: &str) -> String {
        let (mut replaced, mut rest, mut before) = (String::new(), text, ' ');
        while let Some(letter) = rest.chars().next() {
            let file = |kept: &&Kept| {
                let after = rest.strip_prefix(kept.file.as_str());
                let ends = |after: &str| !after.starts_with(|c: char| c.is_alphanumeric());
                !before.is_alphanumeric() && after.is_some_and(ends)
            };
            let (taken, shown) = match self.files.values().find(file) {
                Some(kept) => (kept.file.len(), kept.name.as_str()),
                None => (letter.len_utf8(), &rest[..letter.len_utf8()]),
            };
            replaced += shown;
            before = letter;
            rest = &rest[taken..];
        }
        replaced
    }

    /// What the owner calls a file of this name.
    pub(super) fn called<'a>(&'a self, file: &'a str) -> &'a str {
        let kept = self.files.values().find(|kept| kept.file == file);
        kept.map_or(file, |kept| &kept.name)
    }
}

/// What became of a measuring; written when it ends, and once when it begins.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Ended {
    /// `begun`, `done`, `failed` or `stopped`. A `begun` that nobody works on was interrupted.
    pub(super) state: String,
    /// Why it failed.
    pub(super) why: Vec<Message>,
    /// What the user should know.
    pub(super) warnings: Vec<Message>,
    /// How long it took. \[s\]
    pub(super) seconds: f64,
    /// The content of each node's result that can be shown, with its stage.
    pub(super) results: BTreeMap<String, (String, String)>,
}

/// A text of the user's as it is kept: no control letters, not too long.
pub(super) fn tidy(text: &str) -> String {
    let letters = text.chars().map(|c| if c.is_control() { ' ' } else { c });
    let short: String = letters.take(LONGEST_NAME).collect();
    short.trim().to_owned()
}

/// \[letters\]
const LONGEST_NAME: usize = 120;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_names_files_as_their_owner_calls_them() {
        let mut record = Record::default();
        for (number, name) in [(1, "0002.jpg"), (2, "trunc.jpg"), (3, "a b.png")] {
            let ending = name.rsplit('.').next().unwrap();
            let kept = Kept {
                name: name.into(),
                file: format!("{number:04}.{ending}"),
                bytes: 1,
                size: Some([1, 1]),
                video: false,
            };
            record.files.insert(number, kept);
        }
        let text = "0001.jpg, 0002.jpg (0003.png): x0001.jpg, 0001.jpgs, 0004.jpg, é";
        let named = "0002.jpg, trunc.jpg (a b.png): x0001.jpg, 0001.jpgs, 0004.jpg, é";
        assert_eq!(record.named(text), named);
    }
}
