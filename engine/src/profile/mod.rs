//! Where a run's time and memory go: what each node and each loop in it took of the clock, of the processor, and of
//! memory, as a table and as a trace that Perfetto and Chrome's `about:tracing` show.
//!
//! Arrows: `sample`, `spans` ← `profiler` ← `cost` ← `trace`.

mod cost;
mod profiler;
mod sample;
mod spans;
mod trace;

pub use cost::{Cost, costs};
pub use profiler::{Profile, Profiler};
pub use trace::trace;
