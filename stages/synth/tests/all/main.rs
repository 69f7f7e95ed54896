//! All tests of `synth` in one program: each takes long to link.

mod girths;
mod phone;
mod truth;
