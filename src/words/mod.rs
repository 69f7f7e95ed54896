//! What people read of the program, in their language: on pages and on the first screen of `measure`.
//!
//! | file | what |
//! |---|---|
//! | `parts.rs` | the parts of a measuring, and the nodes of each |
//! | `language.rs`, `en.ftl`, `de.ftl` | texts and numbers in a language |
//! | `messages.rs` | messages of stages by their codes |
//! | `alike.rs` | warnings that differ only in their photo, as one |

pub(crate) mod alike;
pub(crate) mod language;
pub(crate) mod messages;
pub(crate) mod parts;
