//! Sweeps through the command line: processes that share, refusals, what a param reaches.

mod processes;
mod words;
