//! An application's stages and kinds of artifacts: all that the engine knows of what flows.

use stage::{AnyArtifact, AnyStage, Metric};
use std::error::Error;

/// What a program is made of: its name, its stages, its kinds.
pub struct Catalog {
    /// The program with its version, for records of runs: `words 0.2.0`.
    pub program: &'static str,
    /// The stages, in several lists.
    pub stages: &'static [&'static [&'static dyn AnyStage]],
    /// The kinds of which there is something to be known; inherited may flow as well.
    pub kinds: &'static [Kind],
    /// How what programs made (`stage = "exec"`) is read, a kind each.
    pub importers: &'static [Importer],
    /// Pipelines that the program brings along: name and text. Every verb takes their names in place of a file.
    pub pipelines: &'static [(&'static str, &'static str)],
}

/// Files of an artifact: names and bytes. One nameless file, or several in a folder.
pub type NamedFiles = Vec<(String, Vec<u8>)>;

/// Why an artifact cannot be written.
pub type WriteError = Box<dyn Error + Send + Sync>;

/// How files that a program wrote become an artifact of a kind.
pub struct Importer {
    /// A stage with one port of files; its other ports take what the program's node reads of their kinds.
    /// Its params have defaults.
    pub stage: &'static dyn AnyStage,
    /// Patterns of the files, where the result is a folder; or the name of its one file.
    pub files: &'static [&'static str],
    /// Raise it whenever artifacts of the kind are laid out for programs as other bytes.
    pub layout: u32,
}

/// What is to be known of a kind of artifact.
#[derive(Clone, Copy)]
pub struct Kind {
    /// As [`stage::Artifact::KIND`].
    pub name: &'static str,
    /// The formats that it is written in, the usual one first; none is the artifact's own file.
    pub formats: &'static [&'static str],
    /// Another kind that it takes to write one: the files of masks are called after photos.
    pub beside: Option<&'static str>,
    /// The artifact as files in one of its formats, with the artifact of the kind beside if there is one.
    pub files: fn(AnyArtifact, &str, Option<AnyArtifact>) -> Result<NamedFiles, WriteError>,
    /// What its file in the usual format ends with, where that is not the format's name.
    pub extension: fn(&AnyArtifact) -> Option<&'static str>,
    /// Numbers of an artifact itself, beside the metrics that its stage gave.
    pub facts: fn(AnyArtifact) -> Vec<Metric>,
    /// The names of all that `facts` may give, `*` for any text; given the entries of the pipeline's
    /// sections, which may be among them.
    pub names: fn(&[String]) -> Vec<String>,
}

/// The stages or kinds of another catalog, and one's own before them, for a catalog that adds to it.
/// `N` is one more than `inherited` has.
pub const fn with_own<T: Copy, const N: usize>(own: T, inherited: &[T]) -> [T; N] {
    assert!(
        N == inherited.len() + 1,
        "N is one more than there are already"
    );
    let mut all = [own; N];
    let mut i = 0;
    while i < inherited.len() {
        all[i + 1] = inherited[i];
        i += 1;
    }
    all
}

impl Catalog {
    /// Every stage.
    pub fn stages(&self) -> impl Iterator<Item = &'static dyn AnyStage> + use<> {
        self.stages.iter().copied().flatten().copied()
    }

    /// The stage of a name.
    pub fn find(&self, name: &str) -> Option<&'static dyn AnyStage> {
        self.stages().find(|stage| stage.name() == name)
    }

    /// The built-in pipeline of a name, with `.toml` or without: its name and text.
    pub fn pipeline(&self, name: &str) -> Option<(&'static str, &'static str)> {
        let name = name.strip_suffix(".toml").unwrap_or(name);
        self.pipelines.iter().find(|(n, _)| *n == name).copied()
    }

    /// The kind of a name, if there is something to be known of it.
    pub fn kind(&self, name: &str) -> Option<&Kind> {
        self.kinds.iter().find(|kind| kind.name == name)
    }

    /// How a program's result of a kind is read, if programs can make one.
    pub fn importer(&self, kind: &str) -> Option<&'static Importer> {
        self.importers.iter().find(|i| i.stage.yields() == kind)
    }

    /// The numbers of an artifact itself.
    pub fn facts(&self, artifact: AnyArtifact) -> Vec<Metric> {
        let kind = self.kind(artifact.kind());
        kind.map_or(vec![], |kind| (kind.facts)(artifact))
    }

    /// The names of all numbers that artifacts of a kind may have.
    pub fn names(&self, kind: &str, declared: &[String]) -> Vec<String> {
        self.kind(kind)
            .map_or(vec![], |kind| (kind.names)(declared))
    }
}
