//! What people read of the program, in their language: on pages and on the first screen of `measure`.
//!
//! | file | what |
//! |---|---|
//! | `parts.rs` | the parts of a measuring, and the nodes of each |
//! | `language.rs`, `en.ftl`, `de.ftl` | texts and numbers in a language |
//! | `messages.rs` | messages of stages by their codes |

pub(crate) mod language;
pub(crate) mod messages;
pub(crate) mod parts;
