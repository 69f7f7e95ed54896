//! The rules of the house: what a file may import, name and contain.

mod builds;
mod circles;
mod files;
#[path = "../imports/mod.rs"]
mod imports;
mod names;
mod numbers;
mod rules;
mod words;

/// The engine's crates.
const ENGINE: [&str; 4] = [
    "engine",
    "engine/cluster",
    "engine/command",
    "engine/tables",
];
