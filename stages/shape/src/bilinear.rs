//! What is between four neighbours of a grid.

use std::ops::{Add, Mul, Sub};

/// Between the four neighbours of a place, bilinear: the upper left one, that right of it, the two below; how far right of
/// and below the first it is, 0..=1. What is beyond a border is for the caller to choose.
#[inline(always)]
pub fn bilinear<T>([a, b, c, d]: [T; 4], [right, down]: [T; 2]) -> T
where
    T: Copy + Add<Output = T> + Sub<Output = T> + Mul<Output = T>,
{
    let top = a + right * (b - a);
    let bottom = c + right * (d - c);
    top + down * (bottom - top)
}

#[cfg(test)]
mod tests {
    use super::bilinear;

    #[test]
    fn corners_are_themselves_and_the_middle_is_their_mean() {
        let four = [1.0, 2.0, 5.0, 8.0];
        let at = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
        assert_eq!(at.map(|at| bilinear(four, at)), four);
        assert_eq!(bilinear(four, [0.5, 0.5]), 4.0);
        assert_eq!(bilinear(four, [0.25, 0.0]), 1.25);
        assert_eq!(bilinear(four, [0.0, 0.25]), 2.0);
    }
}
