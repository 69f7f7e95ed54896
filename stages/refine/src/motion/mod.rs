//! How the body moved between photos: `steady` (a stage) → `sway`, six numbers a photo; `bend` (a stage) →
//! `field`, a smooth field a photo; both → `equations`, what brightness says.

pub(crate) mod bend;
pub mod field;
pub mod normal_equations;
pub mod params;
pub(crate) mod steady;
pub mod sway;
