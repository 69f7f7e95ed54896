//! How the body moved between photos: `steady` (a stage) → `sway`, six numbers a photo; `bend` (a stage) →
//! `field`, a smooth field a photo; both → `tugs`, what brightness says.

pub(crate) mod bend;
pub mod field;
pub mod params;
pub(crate) mod steady;
pub mod sway;
pub mod tugs;
