//! The rules of the house: what a file may import, name and contain.

mod builds;
mod circles;
mod engine;
mod files;
#[path = "../imports/mod.rs"]
mod imports;
mod names;
mod numbers;
mod rules;
mod words;
