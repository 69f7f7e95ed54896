//! The square around a person, upright as the person is.

use shape::Crop;

/// How much wider than the circle around the body the square is (MediaPipe).
const WIDER: f32 = 1.25;

/// The square from the middle of the hips and a point on the circle around the body, above the head.
pub(super) fn around(hips: [f32; 2], above: [f32; 2]) -> Crop {
    let (x, y) = (above[0] - hips[0], above[1] - hips[1]);
    Crop {
        centre_px: hips,
        side_px: 2.0 * WIDER * libm::hypotf(x, y),
        angle: libm::atan2f(x, -y),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn up_in_the_square_is_where_the_head_is() {
        for above in [[0.0, -80.0], [80.0, 0.0], [-50.0, 60.0], [0.0, 80.0]] {
            let crop = around([10.0, 20.0], [10.0 + above[0], 20.0 + above[1]]);
            let top = crop.on_photo([0.5, 0.1]);
            let far = 0.4 * crop.side_px / libm::hypotf(above[0], above[1]);
            assert!((top[0] - 10.0 - far * above[0]).abs() < 1e-3);
            assert!((top[1] - 20.0 - far * above[1]).abs() < 1e-3);
        }
    }
}
