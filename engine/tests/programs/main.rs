//! Programs as stages: what they get, what is taken of them, what is not, and who allowed it.

mod allowed;
mod application;
mod bad;
mod kept;
mod node;
mod sandboxed;
mod swapped;
