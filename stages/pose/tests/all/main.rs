//! All tests of `pose` in one program: each takes long to link.

mod any_order;
mod disagree;
mod found;
mod import;
mod lengths;
mod lens;
mod mat;
#[path = "../post/mod.rs"]
mod post;
mod recognise;
mod sway;
mod turn;
mod two_points;
mod walk;
