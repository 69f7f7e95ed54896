//! What people read of the program, in their language: on pages and on the first screen of `measure`.
//!
//! | file | what |
//! |---|---|
//! | `parts.rs` | the parts of a measuring, and the nodes of each |
//! | `language.rs`, `en.ftl`, `de.ftl` | texts and numbers in a language |
//! | `findings.rs`, `warnings.rs`, `errors.rs` | sentences of stages, and the texts that mean the same |

mod errors;
pub(crate) mod findings;
pub(crate) mod language;
pub(crate) mod parts;
mod warnings;
