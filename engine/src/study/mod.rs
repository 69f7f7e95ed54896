//! Studies: tables that a sweep makes, kept as a page with its data beside it, made again by one command.
//!
//! A study is a pipeline file with a sweep of the file's own name. Its page and data hang on the results alone: no times, no
//! machine, so that what differs from the last time moved by itself.

mod table;

pub use table::{Moved, Table};
