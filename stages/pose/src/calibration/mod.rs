//! What every way to calibrate shares: the params, what is believed of the lens, what was found and
//! how far to trust it. `found`, `prior`, `trust` → `params` and `adjust`.

pub(crate) mod found;
pub(crate) mod params;
pub(crate) mod prior;
pub(crate) mod trust;
pub(crate) mod upright;
