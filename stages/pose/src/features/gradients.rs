//! Gradients of neighbours in a row of an image, and a table that fades what is further out.

use shape::Gray;
use stage::machine::widest;

/// The direction of a gradient in turns, 0..=1 (Abramowitz and Stegun 4.4.49: to 2e-6 of a turn).
#[inline(always)]
pub(crate) fn turn(gx: f32, gy: f32) -> f32 {
    let (ax, ay) = (gx.abs(), gy.abs());
    let (low, high) = if ax < ay { (ax, ay) } else { (ay, ax) };
    let a = low / (high + 1e-20);
    let s = a * a;
    let arc =
        a * (0.999_866 + s * (-0.330_299_5 + s * (0.180_141 + s * (-0.085_133 + s * 0.020_835_1))));
    let first = arc * (1.0 / std::f32::consts::TAU);
    let half = if ax < ay { 0.25 - first } else { first };
    let upper = if gx < 0.0 { 0.5 - half } else { half };
    if gy < 0.0 { 1.0 - upper } else { upper }
}

/// exp(-x) for 0 <= x < 8 in steps of 1/128.
pub fn fading() -> Vec<f32> {
    (0..1024)
        .map(|i| libm::expf(-(i as f32 + 0.5) / 128.0))
        .collect()
}

/// Looks up [`fading`]; nothing beyond its end.
#[inline(always)]
pub(crate) fn faded(table: &[f32], x: f32) -> f32 {
    table
        .get((x * 128.0) as u32 as usize)
        .copied()
        .unwrap_or(0.0)
}

/// Pixels of a row that are looked at together (structural: speed alone).
pub(crate) const AT_ONCE: usize = 64;

/// Gradients of neighbours in a row.
pub(crate) struct Row {
    /// How steep.
    pub(crate) steep: [f32; AT_ONCE],
    /// Direction of the gradient, in turns.
    pub(crate) turn: [f32; AT_ONCE],
}

impl Default for Row {
    fn default() -> Self {
        Row {
            steep: [0.0; AT_ONCE],
            turn: [0.0; AT_ONCE],
        }
    }
}

impl Row {
    /// Those of `count` pixels from (x, y) on, which are inside the image's border.
    pub(crate) fn look(&mut self, image: &Gray, x: usize, y: usize, count: usize) {
        let (above, below) = (
            &image.row(y - 1)[x..][..count],
            &image.row(y + 1)[x..][..count],
        );
        let (left, right) = (
            &image.row(y)[x - 1..][..count],
            &image.row(y)[x + 1..][..count],
        );
        let (steep, turns) = (&mut self.steep[..count], &mut self.turn[..count]);
        widest(
            #[inline(always)]
            || {
                for i in 0..count {
                    let (gx, gy) = (right[i] - left[i], below[i] - above[i]);
                    steep[i] = (gx * gx + gy * gy).sqrt();
                    turns[i] = turn(gx, gy);
                }
            },
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_are_those_of_the_arc_tangent() {
        for k in 0..1000 {
            let angle = (k as f32 + 0.3) / 1000.0 * std::f32::consts::TAU;
            let (sin, cos) = libm::sincosf(angle);
            let got = turn(7.0 * cos, 7.0 * sin) * std::f32::consts::TAU;
            assert!((got - angle).abs() < 2e-5, "{got} {angle}");
        }
        assert!((0.0..=1.0).contains(&turn(0.0, 0.0)));
    }
}
