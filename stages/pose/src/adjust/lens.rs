//! The lens as numbers that are adjusted, and what is believed of them.

use shape::Intrinsics;

/// Unknowns of the lens: focal length, principal point x and y, k1, k2 (structural).
pub const LENS: usize = 5;

/// A belief about the lens: mean and standard deviation of each of its unknowns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LensPrior {
    /// Mean.
    pub mean: [f64; LENS],
    /// Standard deviation; infinite for no belief.
    pub sigma: [f64; LENS],
}

/// The lens' unknowns as numbers.
pub(crate) fn lens_values(lens: &Intrinsics) -> [f64; LENS] {
    [
        lens.focal[0],
        lens.centre[0],
        lens.centre[1],
        lens.radial[0],
        lens.radial[1],
    ]
}

/// The lens with other values.
pub(crate) fn lens_with(lens: &Intrinsics, [f, x, y, k1, k2]: [f64; LENS]) -> Intrinsics {
    Intrinsics {
        focal: [f, f],
        centre: [x, y],
        radial: [k1, k2],
        ..*lens
    }
}
