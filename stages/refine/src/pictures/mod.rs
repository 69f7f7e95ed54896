//! Photos made ready to be compared: `turn` (what stages read) → `prepare`, `need` (how much memory) →
//! `picture`; `depth` (what hides what) → `picture` →
//! `border` (how sure it is), `crop` (the body's part) → `pinhole`, `halving`, `resample`, `fixed` (in
//! sixteen bits).

pub mod border;
pub(crate) mod crop;
pub mod depth;
pub mod fixed;
pub mod halving;
pub(crate) mod need;
pub mod picture;
pub(crate) mod pinhole;
pub mod prepare;
pub mod resample;
pub mod turn;
