//! What the program makes of captures: pipelines, results beside each other, pages, formats.

// Tests of other pages use more of it.
#[allow(dead_code)]
#[path = "../../stages/report/tests/chromium/mod.rs"]
mod chromium;
mod comparisons;
mod films;
mod formats;
mod over_time;
mod pages;
mod picker;
mod pipelines;
mod plots;
mod repeats;
mod resume;
mod sections;
mod sides;
mod synth;
#[path = "../../stages/report/tests/tube/mod.rs"]
mod tube;
