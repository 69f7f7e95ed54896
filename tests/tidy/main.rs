//! The rules of the house: what a file may know, name, hold.

mod builds;
mod circles;
mod files;
#[path = "../imports/mod.rs"]
mod imports;
mod names;
mod numbers;
mod rules;
