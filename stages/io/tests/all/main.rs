//! All tests of `io` in one program: each takes long to link.

mod fhir;
mod girths;
mod published;
mod relative;
