//! The kinds of messages of this crate.

use crate::Template;

/// Each file's kinds.
pub const MESSAGES: &[&[Template]] = &[crate::nearest::MESSAGES, crate::param_type::MESSAGES];
