//! Sweeps through the command line: processes that share, refusals, what a param reaches.

mod lab;
mod methods;
mod processes;
mod words;
