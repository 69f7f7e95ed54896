//! Stage graphs with cached artifacts: how a pipeline is read, checked, planned, run, remembered and
//! compared. What flows and what is done with it is an application's: see [`Catalog`].
//!
//! A pipeline has four forms, each a type, and only the next function makes the next form:
//! [`recipe::Recipe`] (as written) → [`graph::Graph`] (means something) → [`plan`] (found, stale
//! because, waiting) → [`Outcome`].
//!
//! ```
//! use engine::recipe::{Overrides, open_text, read};
//! use engine::store::Store;
//! use engine::sweep::{self, Points, Sweeping, axes};
//! use engine::{Catalog, Options, plan};
//! # use stage::{Artifact, Corrupt, Ctx, Packer, Stage, Stop, Unpacker, erase};
//! # struct Number(i64);
//! # impl Artifact for Number {
//! #     const KIND: &'static str = "number";
//! #     const FORMAT: u32 = 1;
//! #     fn pack(&self, to: &mut Packer) { to.meta(&self.0) }
//! #     fn unpack(from: &Unpacker<'_>) -> Result<Self, Corrupt> { Ok(Number(from.meta()?)) }
//! # }
//! # stage::params! { #[doc = "A number."] pub struct Of { #[doc = "It."] n: i64 = 1 } }
//! # struct Square;
//! # impl Stage for Square {
//! #     const NAME: &'static str = "toy.square";
//! #     const VERSION: u32 = 1;
//! #     const ABOUT: &'static str = "Squares a number.";
//! #     const METRICS: &'static [&'static str] = &["square"];
//! #     type Params = Of;
//! #     type Input = ();
//! #     type Output = Number;
//! #     fn run(p: &Of, _: (), ctx: &Ctx<'_>) -> Result<Number, Stop> {
//! #         ctx.metric("square", (p.n * p.n) as f64, "");
//! #         Ok(Number(p.n * p.n))
//! #     }
//! # }
//! static CATALOG: Catalog = Catalog {
//!     program: "toys 1",
//!     stages: &[&[&erase::<Square>()]],
//!     pipelines: &[],
//!     kinds: &[],
//!     importers: &[],
//! };
//! let text = "goal = \"four\"\n[node.four]\nstage = \"toy.square\"\nwith = { n = 2 }\n\
//!             [sweep.some]\nover.four = { n = [2, 3] }\ntell = \"four.square\"\n";
//! // A pipeline, with a param set as `--set` does it.
//! let three = Overrides { sets: vec!["four.n=3".into()], ..Overrides::default() };
//! let graph = open_text("toy.toml", text, &three, &CATALOG)?;
//! # let place = tempfile::tempdir()?;
//! # let cache = place.path().join("cache");
//! // What would run, and then the run.
//! let store = Store::open(&cache)?;
//! let planned = plan::plan(&graph, &[], &graph.goal, &store);
//! assert!(matches!(planned[0].as_ref().unwrap().state, plan::State::Stale(_)));
//! let (options, go) = (Options { cache, threads: None, keep_going: false }, false.into());
//! let outcome = engine::run(&graph, &[], &graph.goal, &options, &(), &go)?;
//! assert_eq!(outcome.read::<Number>("four")?.0, 9);
//! // A sweep: what was made already is found.
//! let recipe = read(text).unwrap();
//! let axes = axes::axes(&recipe.sweeps[0], "toy".as_ref())?;
//! let points = Points::new(&graph, vec![None], axes);
//! let sweeping = Sweeping {
//!     open: &|point| {
//!         let overrides = point.overrides(&Overrides::default());
//!         open_text("toy.toml", text, &overrides, &CATALOG).map_err(|m| m.to_string())
//!     },
//!     nodes: &[],
//!     folders: &[],
//!     options: &options,
//!     tell: &["four.square".into()],
//!     errors: None,
//!     watch: &(),
//!     cancel: &go,
//! };
//! let rows = sweep::run(&sweeping, points.iter(), |_| {})?;
//! let metrics: Vec<f64> = rows.iter().map(|r| r.metrics[0].1.as_ref().unwrap().value).collect();
//! assert_eq!((metrics, rows[1].made), (vec![4.0, 9.0], 0));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod agenda;
pub mod delivery;
pub mod differ;
mod done;
mod engine_error;
pub mod graph;
pub mod history;
pub mod impact;
mod journal;
pub mod key;
pub mod lasttime;
mod memory;
mod meter;
mod numbers;
mod outcome;
mod own;
pub mod past;
pub mod permission;
pub mod plan;
pub mod provenance;
pub mod recipe;
pub mod run_one;
pub mod search;
mod session;
#[cfg(test)]
mod simulation;
pub mod source;
mod stopwatch;
pub mod store;
pub mod strands;
pub mod sweep;
pub mod verify;
pub mod walk;
pub mod why;

pub use meter::Spent;
pub use outcome::{Outcome, ResultError};
pub use own::whole;
pub use programs::{Catalog, Importer, Kind, NamedFiles, WriteError, out, with_own};
pub use session::{
    EngineError, Options, given_inputs, inputs, run, run_in, run_unrecorded, runs, threads,
};

/// Every kind of message of this crate.
pub const MESSAGES: &[&[stage::Template]] = &[
    delivery::error::MESSAGES,
    engine_error::MESSAGES,
    recipe::MESSAGES[0],
    recipe::MESSAGES[1],
    source::MESSAGES,
    store::error::MESSAGES,
];
