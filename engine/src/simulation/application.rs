//! The application of the simulation: cheap stages whose results show the capture that they came of.

use super::seam;
use super::story::NUMBERS;
use crate::graph::Graph;
use crate::recipe::{Overrides, Pipeline};
use crate::store::remote::SMALL;
use programs::Catalog;
use programs::Importer;
use stage::{AnyArtifact, AnyStage, Artifact, Corrupt, Ctx, Files, Packer, Stage, Stop};
use stage::{Unpacker, erase};
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::Rc;
use std::sync::Arc;

/// A text.
pub(super) struct Text(pub(super) Vec<u8>);

impl Artifact for Text {
    const KIND: &'static str = "text";
    const FORMAT: u32 = 1;
    fn pack(&self, to: &mut Packer) {
        to.section("bytes", &self.0);
    }
    fn unpack(from: &Unpacker<'_>) -> Result<Self, Corrupt> {
        Ok(Text(from.section("bytes")?))
    }
}

stage::inputs! {
    /// Photos.
    pub struct FromPhotos {
        /// Photos.
        files: Arc<Files>,
    }
}
stage::inputs! {
    /// A text, and another one.
    pub struct FromTexts {
        /// One.
        a: Arc<Text>,
        /// Another, or none.
        b: Option<Arc<Text>>,
    }
}
stage::params! {
    /// A number, and how long it takes.
    pub struct Number {
        /// A number.
        #[range(0..=1_000_000)]
        #[source(structural)]
        n: i64 = 1,
        /// How long it takes.
        #[source(structural)]
        takes_s: u32 = 0,
    }
}

/// Reads all photos.
struct Read;
impl Stage for Read {
    const NAME: &'static str = "sim.read";
    const VERSION: u32 = 1;
    const ABOUT: &'static str = "Reads photos.";
    type Params = Number;
    type Input = FromPhotos;
    type Output = Text;
    fn run(p: &Number, input: FromPhotos, ctx: &Ctx<'_>) -> Result<Text, Stop> {
        let mut text = Vec::new();
        for entry in &input.files.entries {
            let part = ctx.part("photo", &[entry.content], || {
                Ok(Text(input.files.read(entry)?))
            })?;
            text.extend(&part.0);
        }
        seam::works("read", p.takes_s, &text);
        Ok(Text(text))
    }
}

/// Puts texts and a number together.
struct Join;
impl Stage for Join {
    const NAME: &'static str = "sim.join";
    const VERSION: u32 = 1;
    const ABOUT: &'static str = "Puts texts together.";
    type Params = Number;
    type Input = FromTexts;
    type Output = Text;
    fn run(p: &Number, input: FromTexts, ctx: &Ctx<'_>) -> Result<Text, Stop> {
        let mut text = format!("{}:", p.n).into_bytes();
        text.extend(&input.a.0);
        text.extend(input.b.iter().flat_map(|b| b.0.iter()));
        seam::works("join", p.takes_s, &text);
        if p.takes_s > 0 {
            ctx.checkpoint("half", &Text(text.clone()));
        }
        ctx.warn("so so");
        Ok(Text(text))
    }
}

/// More than rides in a record of a shared store.
struct Large;
impl Stage for Large {
    const NAME: &'static str = "sim.large";
    const VERSION: u32 = 1;
    const ABOUT: &'static str = "Repeats a text.";
    type Params = Number;
    type Input = FromTexts;
    type Output = Text;
    fn run(p: &Number, input: FromTexts, _: &Ctx<'_>) -> Result<Text, Stop> {
        seam::works("large", p.takes_s, &input.a.0);
        let more = SMALL + 1;
        let mut text = input.a.0.repeat(more / input.a.0.len().max(1) + 1);
        text.truncate(more);
        Ok(Text(text))
    }
}

static STAGES: &[&dyn AnyStage] = &[&erase::<Read>(), &erase::<Join>(), &erase::<Large>()];

pub(super) static CATALOG: Catalog = Catalog {
    program: "sim 1",
    stages: &[STAGES],
    pipelines: &[],
    kinds: &[],
    importers: &[Importer {
        stage: &erase::<Read>(),
        files: &["*.txt"],
        layout: 1,
    }],
};

/// The pipeline of captures.
const TEXT: &str = r#"
goal = ["large", "last"]
[input.turn]
files = "*.jpg"
[node.read]
stage = "sim.read"
from = { files = "@turn" }
[node.mid]
stage = "sim.join"
from = { a = "read" }
with = { n = 1, takes_s = 5 }
[node.large]
stage = "sim.large"
from = { a = "mid" }
[node.last]
stage = "sim.join"
from = { a = "mid", b = "read" }
with = { n = 7 }
"#;

/// The bytes of each node's result.
pub(super) type Results = Rc<Vec<Vec<u8>>>;

/// The pipelines that the stories know, made once.
pub(super) struct Application {
    pub(super) pipeline: Pipeline,
    graphs: Vec<Graph>,
    expected: RefCell<BTreeMap<(usize, String), Results>>,
}

pub(super) fn overrides(n: usize) -> Overrides {
    Overrides {
        variant: None,
        sets: vec![format!("mid.n={n}")],
    }
}

impl Application {
    fn new() -> Application {
        let pipeline = Pipeline::of_text("sim.toml", TEXT, &CATALOG).expect("a pipeline");
        let graph = |n| pipeline.graph(&overrides(n)).expect("a graph");
        let graphs = (0..NUMBERS).map(graph).collect();
        let expected = RefCell::default();
        Application {
            pipeline,
            graphs,
            expected,
        }
    }

    pub(super) fn graph(&self, n: usize) -> &Graph {
        &self.graphs[n]
    }

    /// The bytes of each node's result, made by the stages alone.
    pub(super) fn expected(&self, n: usize, files: &Files) -> Results {
        let key = (n, stage::content(files).to_hex().to_string());
        if let Some(known) = self.expected.borrow().get(&key) {
            return known.clone();
        }
        let quiet = seam::quiet();
        let graph = &self.graphs[n];
        let mut made: Vec<(AnyArtifact, Vec<u8>)> = Vec::new();
        for node in &graph.nodes {
            let input = |source: &Option<crate::graph::Source>| match source.as_ref()? {
                crate::graph::Source::Input(_) => Some(AnyArtifact::new(files.clone())),
                crate::graph::Source::Node(j) => Some(made[*j].0.clone()),
            };
            let inputs = node.from.iter().map(input).collect();
            let result = node.stage.run(&node.params, inputs, &Ctx::alone());
            let result = result.unwrap_or_else(|_| panic!("a stage of the simulation failed"));
            made.push((result.artifact, result.bytes));
        }
        drop(quiet);
        let bytes = Rc::new(made.into_iter().map(|(_, bytes)| bytes).collect::<Vec<_>>());
        self.expected.borrow_mut().insert(key, bytes.clone());
        bytes
    }
}

thread_local! {
    static APPLICATION: Rc<Application> = Rc::new(Application::new());
}

pub(super) fn application() -> Rc<Application> {
    APPLICATION.with(Rc::clone)
}
