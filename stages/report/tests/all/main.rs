//! All tests of `report` in one program: each takes long to link.

mod accessible;
mod browser;
// Tests of other pages use more of it.
#[allow(dead_code)]
#[path = "../chromium/mod.rs"]
mod chromium;
mod page;
mod paper;
#[path = "../tube/mod.rs"]
mod tube;
mod units;
