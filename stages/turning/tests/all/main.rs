//! All tests of `turning` in one program: each takes long to link.

mod body;
mod turns;
