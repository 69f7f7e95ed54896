//! The kinds of messages of this crate, file by file: a list that nobody joins here is code that nobody uses.

use super::{deliver, fault, result};
use stage::Template;

/// Every kind of message of this crate.
pub const MESSAGES: &[&[Template]] = &[deliver::MESSAGES, fault::MESSAGES, result::MESSAGES];
