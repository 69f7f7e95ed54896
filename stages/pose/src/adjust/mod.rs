//! Bundle adjustment of any scene. `bundle` → `sureness`, `system` → `normal` (points eliminated) → `belief` (terms) →
//! `places` (of unknowns) → `scene` (what is adjusted, what was seen of it) → `residual`, `ring`, `rim` → `lens`,
//! `damped` (Levenberg–Marquardt).

pub(crate) mod belief;
pub(crate) mod bundle;
pub(crate) mod damped;
pub(crate) mod lens;
pub(crate) mod normal;
pub(crate) mod places;
pub(crate) mod residual;
pub(crate) mod rim;
pub(crate) mod ring;
pub(crate) mod scene;
pub(crate) mod sureness;
pub(crate) mod system;
