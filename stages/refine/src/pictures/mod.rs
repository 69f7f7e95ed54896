//! Photos made ready to be compared: `turn` (what stages read) → `prepare`, `need` (how much memory) →
//! `picture`; `depth` (what hides what) → `picture` →
//! `resample` → `registers` (kernels for this processor).

pub mod depth;
pub(crate) mod need;
pub mod picture;
pub mod prepare;
pub mod registers;
pub mod resample;
pub mod turn;
