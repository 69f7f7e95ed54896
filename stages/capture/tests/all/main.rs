//! All tests of `capture` in one program: each takes long to link.

#[path = "../films/mod.rs"]
mod films;
mod no_video;
mod private;
mod raw;
mod surface;
mod video;
