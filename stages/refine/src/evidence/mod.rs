//! What photos and silhouettes show at a vertex: `visibility` (who sees it) → `scene` and `agreement` (eq. 1) → `look` →
//! `patch`; `contours` and `outside` (silhouettes).

pub mod agreement;
pub mod contours;
pub mod look;
pub mod outside;
pub mod params;
pub mod patch;
pub mod scene;
pub mod visibility;
