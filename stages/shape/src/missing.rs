//! What could not be measured, and why.

use crate::{GirthId, Refusal};
use serde::{Deserialize, Serialize};

/// A girth, or a height, that could not be measured.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Missing {
    /// Which girth; `None` for what is none: the stature.
    pub id: Option<GirthId>,
    /// Short name.
    pub name: String,
    /// The reason, for programs.
    pub reason: Refusal,
    /// Why on this body, and what would help: a sentence.
    pub why: String,
}

impl Missing {
    /// A girth of the table, with the sentence that goes with the reason.
    pub fn new(id: GirthId, reason: Refusal) -> Self {
        Missing::because(id, reason, reason.why())
    }

    /// With a sentence of its own.
    pub fn because(id: GirthId, reason: Refusal, why: &str) -> Self {
        Missing {
            id: Some(id),
            name: id.name(),
            reason,
            why: why.into(),
        }
    }
}
