//! The kinds of messages of this crate.

use crate::{compare, score};

/// Each file's kinds.
pub const MESSAGES: &[&[stage::Template]] = &[
    compare::girths::MESSAGES,
    compare::side::SideError::MESSAGES,
    compare::words::MESSAGES,
    score::girths::MESSAGES,
    score::paper::MESSAGES,
    score::table::MESSAGES,
    score::truth::MESSAGES,
    score::truth::Unreadable::MESSAGES,
];
