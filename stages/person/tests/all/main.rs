//! All tests of `person` in one program: each takes long to link.

mod alarm;
mod networks;
mod odd;
