//! Bundle adjustment. Of anything: `damped` (Levenberg–Marquardt), `normal` (points eliminated). Of a
//! turn: `bundle` → `system` → `scene` (what is adjusted, what was seen and believed, the cost) →
//! `residual`, `ring`, `rim` → `lens`.

pub(crate) mod bundle;
pub(crate) mod damped;
pub(crate) mod lens;
pub(crate) mod normal;
pub(crate) mod residual;
pub(crate) mod rim;
pub(crate) mod ring;
pub(crate) mod scene;
pub(crate) mod system;
