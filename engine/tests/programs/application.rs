//! An application for programs: a text (one file), pages (a folder of texts); and a folder to run them in.

use engine::graph::Graph;
use engine::recipe::{Overrides, open_text};
use engine::store::Store;
use engine::walk::{Done, Status, Watch};
use engine::{Catalog, Kind, Options, Outcome, permission};
use engine::{Importer, NamedFiles, WriteError};
use stage::{AnyArtifact, Artifact, Corrupt, Ctx, Files, Packer, Stage, Stop, Unpacker, erase};
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;
use std::sync::{Arc, LazyLock};

/// A text.
#[derive(Debug, PartialEq)]
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

/// Texts by name.
#[derive(Debug, PartialEq)]
pub(crate) struct Pages(pub(crate) Vec<(String, String)>);

impl Artifact for Pages {
    const KIND: &'static str = "pages";
    const FORMAT: u32 = 1;
    fn pack(&self, to: &mut Packer) {
        to.meta(&self.0);
    }
    fn unpack(from: &Unpacker<'_>) -> Result<Self, Corrupt> {
        Ok(Pages(from.meta()?))
    }
}

stage::inputs! {
    /// Files.
    pub struct FromFiles {
        /// Files.
        files: Arc<Files>,
    }
}
stage::inputs! {
    /// Files, and what they are called after.
    pub struct FromFilesAndText {
        /// Files.
        files: Arc<Files>,
        /// The text that names them, a line each.
        names: Arc<Text>,
    }
}
stage::inputs! {
    /// A text.
    pub struct FromText {
        /// A text.
        text: Arc<Text>,
    }
}

/// A text from its file.
struct Take;
impl Stage for Take {
    const NAME: &'static str = "text.take";
    const VERSION: u32 = 1;
    const ABOUT: &'static str = "Takes a text.";
    type Params = ();
    type Input = FromFiles;
    type Output = Text;
    fn run(_: &(), input: FromFiles, _: &Ctx<'_>) -> Result<Text, Stop> {
        let bytes = input.files.read(&input.files.entries[0])?;
        Ok(Text(String::from_utf8(bytes)?))
    }
}

/// Pages from a file for each name.
struct Bind;
impl Stage for Bind {
    const NAME: &'static str = "pages.bind";
    const VERSION: u32 = 1;
    const ABOUT: &'static str = "Takes pages.";
    type Params = ();
    type Input = FromFilesAndText;
    type Output = Pages;
    fn run(_: &(), input: FromFilesAndText, _: &Ctx<'_>) -> Result<Pages, Stop> {
        let mut pages = Vec::new();
        for name in input.names.0.split_whitespace() {
            let mut entries = input.files.entries.iter();
            let entry = entries.find(|e| e.name == format!("{name}.txt"));
            let entry = entry.ok_or_else(|| std::io::Error::other(format!("no page {name}")))?;
            let text = String::from_utf8(input.files.read(entry)?)?;
            pages.push((name.to_owned(), text));
        }
        Ok(Pages(pages))
    }
}

/// How long a text is.
struct Length;
impl Stage for Length {
    const NAME: &'static str = "text.length";
    const VERSION: u32 = 1;
    const ABOUT: &'static str = "Tells the length.";
    type Params = ();
    type Input = FromText;
    type Output = Text;
    fn run(_: &(), input: FromText, _: &Ctx<'_>) -> Result<Text, Stop> {
        Ok(Text(input.text.0.len().to_string()))
    }
}

fn files(
    artifact: AnyArtifact,
    format: &str,
    _: Option<AnyArtifact>,
) -> Result<NamedFiles, WriteError> {
    if let Some(pages) = artifact.clone().downcast::<Pages>() {
        let one = |(name, text): &(String, String)| (format!("{name}.txt"), text.clone().into());
        return Ok(pages.0.iter().map(one).collect());
    }
    let text = artifact.downcast::<Text>().unwrap();
    let text = match format {
        "loud" => text.0.to_uppercase(),
        _ => text.0.clone(),
    };
    Ok(vec![(String::new(), text.into_bytes())])
}

const fn kind(name: &'static str, formats: &'static [&'static str]) -> Kind {
    Kind {
        name,
        formats,
        beside: None,
        files,
        extension: |_| None,
        facts: |_| vec![],
        names: |_| vec![],
    }
}

/// The application.
pub(crate) static CATALOG: Catalog = Catalog {
    program: "texts 1",
    stages: &[&[&erase::<Take>(), &erase::<Bind>(), &erase::<Length>()]],
    pipelines: &[],
    kinds: &[
        kind(Text::KIND, &["txt", "loud"]),
        kind(Pages::KIND, &["txt"]),
    ],
    importers: &[
        Importer {
            stage: &erase::<Take>(),
            files: &["text.txt"],
            layout: 1,
        },
        Importer {
            stage: &erase::<Bind>(),
            files: &["*.txt"],
            layout: 1,
        },
    ],
};

/// A folder with a pipeline, its files, a source and a store.
pub(crate) struct Place(tempfile::TempDir);

impl Place {
    pub(crate) fn new() -> Place {
        static STATE: LazyLock<tempfile::TempDir> = LazyLock::new(|| tempfile::tempdir().unwrap());
        permission::keep_permissions_in(STATE.path().to_owned());
        let place = Place(tempfile::tempdir().unwrap());
        std::fs::create_dir(place.path("src")).unwrap();
        place.write("src/a.txt", "one two\n");
        place
    }
    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }
    pub(crate) fn write(&self, name: &str, text: &str) {
        std::fs::write(self.path(name), text).unwrap();
    }
    pub(crate) fn store(&self) -> Store {
        Store::open(&self.path("cache")).unwrap()
    }
    /// A pipeline whose goal is `x`; reads `@src` if it has it.
    pub(crate) fn open(&self, nodes: &str, sets: &[&str]) -> Result<Graph, String> {
        let input = match nodes.contains("@src") {
            true => "[input.src]\nfiles = \"*.txt\"\n",
            false => "",
        };
        let goal = match nodes.starts_with("goal") {
            true => "",
            false => "goal = \"x\"\n",
        };
        let text = format!("{goal}{input}{nodes}");
        let sets = sets.iter().map(|s| (*s).to_owned()).collect();
        let overrides = Overrides {
            variant: None,
            sets,
        };
        let name = self.path("x.toml").display().to_string();
        open_text(&name, &text, &overrides, &CATALOG).map_err(|m| m.to_string())
    }
    pub(crate) fn graph(&self, nodes: &str) -> Graph {
        self.open(nodes, &[]).unwrap_or_else(|m| panic!("{m}"))
    }
    pub(crate) fn options(&self) -> Options {
        Options {
            cache: self.path("cache"),
            threads: Some(2),
            keep_going: true,
        }
    }
    pub(crate) fn folders(&self, graph: &Graph) -> Vec<(String, PathBuf)> {
        let inputs = graph.inputs.iter();
        inputs.map(|i| (i.name.clone(), self.path("src"))).collect()
    }
    pub(crate) fn allow(&self, graph: &Graph) {
        let all: Vec<usize> = (0..graph.nodes.len()).collect();
        permission::allow(graph, &all).unwrap();
    }
    /// Runs what is allowed.
    pub(crate) fn run(
        &self,
        graph: &Graph,
        watch: &dyn Watch,
        cancel: &AtomicBool,
    ) -> Result<Outcome, String> {
        let (folders, options) = (self.folders(graph), self.options());
        engine::run(graph, &folders, &graph.goal, &options, watch, cancel)
            .map_err(|e| e.to_string())
    }
    /// Allows and runs.
    pub(crate) fn made(&self, graph: &Graph) -> Outcome {
        self.allow(graph);
        let outcome = self.run(graph, &(), &false.into()).unwrap();
        assert_eq!(left(&self.path("cache")), Vec::<PathBuf>::new());
        outcome
    }
    /// The text that `x` makes.
    pub(crate) fn text(&self, nodes: &str) -> String {
        let graph = self.graph(nodes);
        let outcome = self.made(&graph);
        assert_eq!(outcome.failure(&graph), None);
        outcome.read::<Text>("x").unwrap().0.clone()
    }
    /// Why `x` fails.
    pub(crate) fn failure(&self, nodes: &str) -> String {
        let graph = self.graph(nodes);
        let outcome = self.made(&graph);
        let (_, why) = outcome.failure(&graph).expect("it fails");
        why.to_string()
    }
}

/// What became of a node.
pub(crate) fn done<'a>(outcome: &'a Outcome, graph: &Graph, node: &str) -> &'a Done {
    outcome.nodes[graph.node(node).unwrap()].as_ref().unwrap()
}

/// Whether a node was made.
pub(crate) fn is_made(outcome: &Outcome, graph: &Graph, node: &str) -> bool {
    done(outcome, graph, node).status == Status::Executed
}

/// Folders of programs that are still there.
pub(crate) fn left(cache: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(cache.join("exec"));
    let entries = entries.into_iter().flatten().flatten();
    entries.map(|e| e.path()).collect()
}

/// A node that runs a line of shell; `$1` is where its result goes.
pub(crate) fn shell(line: &str, more: &str) -> String {
    let line = line.replace('{', "{{").replace('}', "}}");
    format!(
        "[node.x]\nstage = \"exec\"\nout = \"text\"\ncommand = [\"sh\", \"-c\", '''{line}''', \"sh\", \"{{out}}\"]\n{more}"
    )
}
