//! Photos made ready to be compared: `turn` (what stages read) → `prepare`, `need` (how much memory) →
//! `picture`; `depth` (what hides what) → `picture` →
//! `crop` (the body's part), `halving`, `resample`.

pub(crate) mod crop;
pub mod depth;
pub mod halving;
pub(crate) mod need;
pub mod picture;
pub mod prepare;
pub mod resample;
pub mod turn;
