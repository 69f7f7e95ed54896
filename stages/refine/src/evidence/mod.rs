//! What photos and silhouettes say at a vertex: `visible` (who sees it) and `agreement` (eq. 1) → `look` →
//! `patch`; `contours` and `outside` (silhouettes).

pub mod agreement;
pub mod contours;
pub mod look;
pub mod outside;
pub mod params;
pub mod patch;
pub mod visibility;
