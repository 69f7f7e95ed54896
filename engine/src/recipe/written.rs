//! A pipeline as it is written: every name and value with its place.

use stage::Value;
use std::ops::Range;

/// The keys of the grammar itself.
pub(super) const KEYS: [&str; 10] = [
    "about", "goal", "extends", "without", "params", "input", "node", "variant", "sweep", "search",
];

/// The keys of a node.
pub(super) const NODE: [&str; 12] = [
    "stage",
    "from",
    "with",
    "command",
    "out",
    "files",
    "identity",
    "env",
    "timeout_s",
    "memory_mb",
    "network",
    "keep",
];

/// Something written, and where. \[bytes of the file, behind those of the files read before\]
#[derive(Debug, Clone, PartialEq)]
pub struct Spanned<T> {
    /// What was written.
    pub value: T,
    /// Where.
    pub span: Range<usize>,
}

/// Where a node's ports read from, as written.
#[derive(Debug, Clone, PartialEq)]
pub enum From {
    /// `from = ["photos", "masks"]`: each port is called like what it reads.
    List(Vec<Spanned<String>>),
    /// `from = { mesh = "hull" }`: port, then what it reads.
    Table(Vec<(Spanned<String>, Spanned<String>)>),
}

/// `with = { voxel_mm = 2.0 }`.
pub type With = Vec<(Spanned<String>, Spanned<Value>)>;

/// `[node.NAME]`.
#[derive(Debug, Clone, PartialEq)]
pub struct Node {
    /// Its name.
    pub name: Spanned<String>,
    /// Its stage.
    pub stage: Spanned<String>,
    /// What it reads.
    pub from: From,
    /// Its params.
    pub with: With,
    /// Its keys for a program that it runs.
    pub exec: Exec,
}

/// The keys of a node with `stage = "exec"` for its program.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Exec {
    /// The first of its keys, with its place.
    pub key: Option<Spanned<String>>,
    /// `command`.
    pub command: Option<Vec<Spanned<String>>>,
    /// `out`: the kind that it makes.
    pub out: Option<Spanned<String>>,
    /// `files` of its own, beside the pipeline.
    pub files: Option<Vec<Spanned<String>>>,
    /// `identity`: a command that prints what it is.
    pub identity: Option<Vec<Spanned<String>>>,
    /// `env`: variables of the environment that it gets.
    pub env: Option<Vec<Spanned<String>>>,
    /// `reads`: files and folders that it reads beside what it is given.
    pub reads: Option<Vec<Spanned<String>>>,
    /// `timeout_s`: how long it may take.
    pub timeout_s: Option<Spanned<f64>>,
    /// `memory_mb`: what it may hold.
    pub memory_mb: Option<Spanned<f64>>,
    /// `network`: whether it may reach the network.
    pub network: Option<bool>,
    /// `keep`: whether it stays for further jobs.
    pub keep: Option<bool>,
}

/// `[input.NAME]`.
#[derive(Debug, Clone, PartialEq)]
pub struct Input {
    /// Its name.
    pub name: Spanned<String>,
    /// What it is.
    pub about: String,
    /// Patterns of its files.
    pub files: Vec<String>,
}

/// `[KIND.NAME]`: one entry of a section.
#[derive(Debug, Clone, PartialEq)]
pub struct Section {
    /// The param that it fills.
    pub kind: Spanned<String>,
    /// Its own name.
    pub name: Spanned<String>,
    /// Its keys.
    pub keys: With,
}

/// `[variant.NAME]`: the same pipeline, otherwise.
#[derive(Debug, Clone, PartialEq)]
pub struct Variant {
    /// Its name.
    pub name: Spanned<String>,
    /// What it is for.
    pub about: String,
    /// Params by node; `params` are the shared ones.
    pub with: Vec<(Spanned<String>, With)>,
    /// Another stage for a node.
    pub stage: Vec<(Spanned<String>, Spanned<String>)>,
    /// Other sources for a node.
    pub from: Vec<(Spanned<String>, From)>,
    /// Nodes left out: their readers read what they read.
    pub without: Vec<Spanned<String>>,
}

/// The values that a param takes in a sweep.
#[derive(Debug, Clone, PartialEq)]
pub enum Over {
    /// `[2.0, 3.0, 4.0]`.
    List(Vec<Spanned<Value>>),
    /// `{ from = 1.0, to = 8.0, steps = 4, log = true }`.
    Range(Spanned<Stretch>),
}

/// Node (or `params`), param, and the values that it takes.
pub type OverParam = (Spanned<String>, Spanned<String>, Over);

/// Values from one number to another.
#[derive(Debug, Clone, PartialEq)]
pub struct Stretch {
    /// The first.
    pub from: f64,
    /// The last.
    pub to: f64,
    /// How many; none where a sample sets it.
    pub steps: Option<usize>,
    /// Whether equal steps are equal ratios.
    pub log: bool,
    /// Whether both ends were written as whole numbers.
    pub whole: bool,
}

/// `sample = { points = 40, seed = 1 }`: a Latin hypercube instead of the grid.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Sample {
    /// How many points.
    pub points: usize,
    /// Which of all samples.
    pub seed: u64,
}

/// `[sweep.NAME]`: a grid of params, or a sample of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Sweep {
    /// Its name.
    pub name: Spanned<String>,
    /// The question it answers.
    pub about: String,
    /// Node (or `params`), param and the values it takes.
    pub over: Vec<OverParam>,
    /// Params that go side by side instead of crosswise: `node.param`.
    pub zip: Vec<Vec<Spanned<String>>>,
    /// A table of points: a file beside the pipeline, `node.param` at the head of each column.
    pub csv: Option<Spanned<String>>,
    /// A sample instead of the grid.
    pub sample: Option<Spanned<Sample>>,
    /// How often each point is repeated, each time with other seeds of what is by chance.
    pub replicate: Option<Spanned<u32>>,
    /// Variants to be crossed with the grid; none is the pipeline as it is.
    pub with: Vec<Spanned<String>>,
    /// Metrics to report: `node.metric`.
    pub tell: Vec<Spanned<String>>,
    /// The nodes that are wanted at each point; none is the pipeline's goal.
    pub goal: Vec<Spanned<String>>,
}

/// How a search chooses its points.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Method {
    /// Each by itself.
    Random,
    /// A Latin hypercube.
    Hypercube,
    /// A Latin hypercube at the least of a param that makes points dear, the best third at three times as much, and so on
    /// (successive halving: Jamieson and Talwalkar 2016).
    Halving,
    /// Latin hypercubes one after the other, each of ranges half as wide around the best point so far.
    Narrowing,
}

impl Method {
    /// All, with their words.
    pub const ALL: [(&'static str, Method); 4] = [
        ("random", Method::Random),
        ("hypercube", Method::Hypercube),
        ("halving", Method::Halving),
        ("narrowing", Method::Narrowing),
    ];
}

/// `[search.NAME]`: the best set of params within ranges.
#[derive(Debug, Clone, PartialEq)]
pub struct Search {
    /// Ranges, variants, metrics and replicates, as in a sweep; its sample has the budget and the seed.
    pub sweep: Sweep,
    /// How points are chosen.
    pub method: Method,
    /// The metric that is to be small, or large.
    pub metric: Spanned<String>,
    /// Whether it is to be large.
    pub most: bool,
    /// What makes points of a halving dear: node, param, its least and its full value.
    pub dear: Option<(Spanned<String>, Spanned<String>, Spanned<Stretch>)>,
}

/// A pipeline as written.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Recipe {
    /// What it is for.
    pub about: String,
    /// The nodes that are wanted.
    pub goal: Vec<Spanned<String>>,
    /// The user's files.
    pub inputs: Vec<Input>,
    /// The nodes.
    pub nodes: Vec<Node>,
    /// `extends`: the pipeline that this one changes.
    pub extends: Option<Spanned<String>>,
    /// Nodes of that one that are left out: their readers read what they read.
    pub without: Vec<Spanned<String>>,
    /// `[params]`: values that several nodes share.
    pub params: With,
    /// Entries of sections.
    pub sections: Vec<Section>,
    /// The same, otherwise.
    pub variants: Vec<Variant>,
    /// Grids of params.
    pub sweeps: Vec<Sweep>,
    /// Searches for the best set of params.
    pub searches: Vec<Search>,
}

/// What the command line changes.
#[derive(Debug, Clone, Default)]
pub struct Overrides {
    /// A variant, or several separated by commas, applied in order.
    pub variant: Option<String>,
    /// `NODE.PARAM=VALUE`, applied after variants.
    pub sets: Vec<String>,
}
