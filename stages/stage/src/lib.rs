//! The contract: what a stage is, and what its cached result depends on.
//!
//! A stage is a pure function whose signature is its cache key:
//!
//! | in the key | not in the key |
//! |---|---|
//! | `NAME`, `VERSION` | names of nodes, variants, files of pipelines |
//! | params after defaults, one line each | how the TOML was laid out |
//! | content of each input, by port | paths, times, machine |
//! | kind and format of the output | threads, verbosity, progress |
//! | versions of foreign programs that it runs | where they are installed |
//!
//! What is in the right column comes through [`Ctx`], which cannot enter a key.

mod any;
mod artifact;
mod choice;
mod codec;
mod ctx;
mod day;
mod erase;
mod failure;
mod field;
mod files;
mod input;
mod kinds;
pub mod machine;
mod message;
mod message_file;
mod metrics;
mod named;
mod nearest;
mod param_type;
mod params;
pub mod process;
mod provenance;
mod template;
mod value;

pub use any::AnyArtifact;
pub use artifact::{Artifact, Hash, Packer, Unpacker, content, from_bytes, hash, opened, to_bytes};
pub use choice::Choice;
pub use codec::Corrupt;
pub use ctx::{Ctx, Host, Metric, Steps};
pub use day::{day_number, day_text};
pub use erase::{AnyStage, Checked, Erased, Made, erase};
pub use failure::{Coded, Recognise, recognise};
pub use files::{FileEntry, Files, FilesError};
pub use input::{Input, Port, PortSpec, Wrong};
pub use kinds::MESSAGES;
pub use message::{Field, Message};
pub use metrics::fits_any;
pub use named::Named;
pub use nearest::{nearest, unknown};
pub use param_type::ParamType;
#[doc(hidden)]
pub use param_type::read_one;
pub use params::{Mistake, ParamSpec, Params};
pub use provenance::NumberSource;
pub use template::Template;
pub use value::Value;

/// One step of a pipeline: a pure function from artifacts and params to an artifact.
pub trait Stage: 'static {
    /// What a pipeline file calls this stage: `crate.verb`, such as `hull.carve`.
    const NAME: &'static str;
    /// Raise it whenever equal inputs and equal params may give other bytes.
    const VERSION: u32;
    /// One sentence for the reference.
    const ABOUT: &'static str;
    /// What the user may tune; see [`params!`].
    type Params: Params;
    /// What flows in; see [`inputs!`].
    type Input: Input;
    /// What flows out.
    type Output: Artifact;
    /// The names of all metrics that `run` may report; `*` is a part that follows from the
    /// input. What is not here can be asked for by nobody.
    const METRICS: &'static [&'static str] = &[];

    /// The foreign programs that `run` calls, each with the version that is installed: a part of the
    /// key, so that another version makes the result anew.
    fn programs() -> Vec<(&'static str, String)> {
        vec![]
    }

    /// What is wrong with params that fit one by one, such as a name that is taken: reported before anything runs, at the
    /// place where it was written. A mistake's name is the param, within a section `section.entry`.
    fn check(_params: &Self::Params) -> Vec<Mistake> {
        vec![]
    }

    /// What a run takes at most beside its input, as far as that can be estimated before. Stages of one
    /// process that together need more than is free run one after the other. No part of the key.
    /// \[bytes\]
    fn memory(_params: &Self::Params, _input: &Self::Input) -> u64 {
        0
    }

    /// Does the work. Must be deterministic: the same arguments give the same bytes.
    ///
    /// # Errors
    ///
    /// Whatever the stage finds wrong with its inputs, or that the user asked to stop.
    fn run(params: &Self::Params, input: Self::Input, ctx: &Ctx<'_>) -> Result<Self::Output, Stop>;
}

/// Why a stage returned without an output. Never cached.
#[derive(Debug)]
pub enum Stop {
    /// The user asked to stop. Not a fault.
    Cancelled,
    /// The input is of a kind that this stage can't use; the error names what to do about it.
    Failed(Box<dyn std::error::Error + Send + Sync>),
}

/// The user asked to stop. `?` turns it into [`Stop::Cancelled`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Cancelled;

impl From<Cancelled> for Stop {
    fn from(_: Cancelled) -> Stop {
        Stop::Cancelled
    }
}

impl<E: std::error::Error + Send + Sync + 'static> From<E> for Stop {
    fn from(error: E) -> Stop {
        Stop::Failed(Box::new(error))
    }
}
