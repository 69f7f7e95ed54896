//! All tests of `hull` in one program: each takes long to link.

mod bad_input;
mod contradicted;
mod cylinder;
mod surface;
