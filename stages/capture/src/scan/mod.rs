//! Surfaces from elsewhere: their files, their holes, and how they are oriented.

mod announced;
mod facing;
mod file;
mod given;
mod glb;
mod holes;
mod pose;
mod three_mf;

pub(crate) use announced::announced;
pub(crate) use facing::agreed;
pub(crate) use file::read;
pub use file::{SCANS, is_scan};
pub use given::Unit;
pub(crate) use given::{MOST_FACES, Read};
pub(crate) use holes::{closed, crown_opened};
pub(crate) use pose::{pieces, turned, unit, up};
