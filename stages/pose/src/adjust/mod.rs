//! Bundle adjustment: `bundle` → `system` → `schur` → `scene` (what is adjusted, what was seen and
//! believed, the cost) → `residual`, `ring`, `rim` → `lens`.

pub(crate) mod bundle;
pub(crate) mod lens;
pub(crate) mod residual;
pub(crate) mod rim;
pub(crate) mod ring;
pub(crate) mod scene;
pub(crate) mod schur;
pub(crate) mod system;
