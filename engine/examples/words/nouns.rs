//! What flows: counts of words, and a page of text.

use stage::{Artifact, Corrupt, Packer, Unpacker};
use std::collections::BTreeMap;

/// How often each word occurs in each file.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub(crate) struct Counts {
    /// By the file's name, by the word.
    pub(crate) files: BTreeMap<String, BTreeMap<String, u64>>,
}

impl Artifact for Counts {
    const KIND: &'static str = "counts";
    const FORMAT: u32 = 1;

    fn pack(&self, to: &mut Packer) {
        to.meta(&self.files);
    }

    fn unpack(from: &Unpacker<'_>) -> Result<Self, Corrupt> {
        Ok(Counts {
            files: from.meta()?,
        })
    }
}

impl Counts {
    /// Every word with its count in all files.
    pub(crate) fn all(&self) -> BTreeMap<&str, u64> {
        let mut all = BTreeMap::new();
        for (word, count) in self.files.values().flatten() {
            *all.entry(word.as_str()).or_default() += count;
        }
        all
    }
}

/// A text for people.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Text(pub(crate) String);

impl Artifact for Text {
    const KIND: &'static str = "text";
    const FORMAT: u32 = 1;

    fn pack(&self, to: &mut Packer) {
        to.meta(&self.0);
    }

    fn unpack(from: &Unpacker<'_>) -> Result<Self, Corrupt> {
        Ok(Text(from.meta()?))
    }
}
