//! How the body moved between photos: `compensate` (a stage) → `sway`, six numbers a photo, without `gauge`, what
//! cameras share; `deformation` (a stage) → `field`, a smooth field a photo; both → `normal_equations`, how brightness
//! pulls.

pub(crate) mod compensate;
pub(crate) mod deformation;
pub mod field;
pub mod gauge;
pub mod normal_equations;
pub mod params;
pub mod sway;
