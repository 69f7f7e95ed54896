//! All tests of `refine` in one program: each takes long to link.

mod ball;
mod deformation;
mod input;
mod outside;
mod slope;
#[path = "../turn/mod.rs"]
mod turn;
