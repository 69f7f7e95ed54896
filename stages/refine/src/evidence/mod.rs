//! What photos and silhouettes say at a vertex: `sights` (who sees it) and `agreement` (eq. 1) → `look` →
//! `patch`; `rims` and `outside` (silhouettes).

pub mod agreement;
pub mod look;
pub mod outside;
pub mod params;
pub mod patch;
pub mod rims;
pub mod sights;
