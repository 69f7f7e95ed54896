//! Photos made ready to be compared: `turn` (what stages read) → `prepare`, `need` (how much memory) →
//! `picture`; `depth` (what hides what) → `picture`.

pub mod depth;
pub(crate) mod need;
pub mod picture;
pub mod prepare;
pub mod turn;
