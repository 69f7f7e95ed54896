//! The surface follows the photos: `optimize` (a stage) → `round` → `sight`, `energy`, `sweep`, `smooth` → `step`;
//! `evolve` (a stage, the paper's own) → `smooth`, `progress`; all know `params`.

pub mod energy;
pub(crate) mod evolve;
pub mod median;
pub(crate) mod optimize;
pub(crate) mod params;
pub mod progress;
pub(crate) mod round;
pub(crate) mod sight;
pub mod smooth;
pub mod step;
pub mod sweep;
