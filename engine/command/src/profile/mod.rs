//! Where a run's time and memory go: what each node took of the clock, of the processor and of memory, and each loop in it
//! of the clock, as a table and as a trace that Perfetto and Chrome's `about:tracing` show.
//!
//! Arrows: `spans` ← `cost`, `trace` ← `profiler`.

mod cost;
mod profiler;
mod spans;
mod trace;

pub(crate) use cost::Cost;
pub(crate) use profiler::{Profile, Profiler};
