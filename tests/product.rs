//! The product's tests in one program: it is linked once, and tests that wait run beside those that compute.
//!
//! `book`, `tidy` and `fingerprints`, which are asked for by name, are programs of their own, too: `--test tidy`.

#[path = "book/main.rs"]
mod book;
// Tests of other pages use more of it.
#[allow(dead_code)]
#[path = "../stages/report/tests/chromium/mod.rs"]
mod chromium;
mod cluster;
mod decoders;
mod fingerprints;
mod front;
mod results;
mod serve;
mod small;
mod sweeps;
#[path = "tidy/main.rs"]
mod tidy;
