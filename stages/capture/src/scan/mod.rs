//! Surfaces from elsewhere: their files, their holes, and how they stand.

mod file;
mod given;
mod glb;
mod holes;
mod stand;
mod three_mf;

pub(crate) use file::read;
pub use file::{SCANS, is_scan};
pub use given::Unit;
pub(crate) use given::{MOST_FACES, Read};
pub(crate) use holes::closed;
pub(crate) use stand::{pieces, turned, unit, up};
