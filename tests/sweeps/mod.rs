//! Sweeps through the command line: processes that share, refusals, what a param reaches.

mod columns;
mod methods;
mod processes;
mod searches;
mod turning;
mod words;
