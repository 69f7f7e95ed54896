//! The front door: an exit code.

fn main() {}
