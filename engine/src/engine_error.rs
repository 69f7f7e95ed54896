//! Why nothing could be run.

use crate::source::SourceError;
use crate::store::StoreError;
use stage::{Coded, Message, message};

stage::messages! {
    INPUT = "cli-input": "input `{name}`: {why}";
}

/// Why nothing could be run.
#[derive(Debug, thiserror::Error)]
pub enum EngineError {
    /// The store.
    #[error(transparent)]
    Store(#[from] StoreError),
    /// The inputs.
    #[error("{}", self.message())]
    Source {
        /// Which input.
        name: String,
        /// Why.
        why: SourceError,
    },
    /// An input that is missing.
    #[error("input `{0}` is missing{1}: add --input {0}=FOLDER")]
    Unsaid(String, String),
    /// An input that the pipeline does not have.
    #[error("{0}")]
    Unknown(String),
    /// Programs that nobody allowed.
    #[error("{0}")]
    NotAllowed(String),
    /// A program of which it is not known what it is.
    #[error("node `{name}`: {why}")]
    Identity {
        /// The node.
        name: String,
        /// Why.
        why: String,
    },
}

impl Coded for EngineError {
    fn message(&self) -> Message {
        match self {
            EngineError::Store(why) => why.message(),
            EngineError::Source { name, why } => message!(INPUT, name = name, why = why.message()),
            rest => rest.to_string().into(),
        }
    }
}
