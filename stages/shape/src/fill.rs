//! A triangle drawn on a picture, pixel by pixel, the nearest surface winning.

use crate::Image;

/// Calls `at` for the pixels of a triangle that are nearer than what was there, with the corners' shares, and keeps how near
/// they are.
/// Corners are (x, y, nearness): pixels, and a length that grows towards the eye.
pub fn fill_triangle(
    corners: [[f64; 3]; 3],
    near: &mut Image<f64>,
    at: &mut dyn FnMut(usize, usize, [f64; 3]),
) {
    let [a, b, c] = corners;
    let cross = |p: [f64; 3], q: [f64; 3], r: [f64; 2]| {
        (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
    };
    let whole = cross(a, b, [c[0], c[1]]);
    if whole == 0.0 || !whole.is_finite() {
        return;
    }
    let span = |axis: usize, size: usize| {
        let values = corners.map(|p| p[axis]);
        let lo = values.into_iter().fold(f64::MAX, f64::min).ceil().max(0.0);
        let hi = values.into_iter().fold(f64::MIN, f64::max).floor();
        lo as usize..(hi.min(size as f64 - 1.0) + 1.0).max(0.0) as usize
    };
    for y in span(1, near.height) {
        for x in span(0, near.width) {
            let p = [x as f64, y as f64];
            let share = [cross(b, c, p), cross(c, a, p), cross(a, b, p)].map(|s| s / whole);
            if share.iter().any(|s| *s < 0.0) {
                continue;
            }
            let depth = (0..3).map(|i| share[i] * corners[i][2]).sum();
            if depth > near.at(x, y) {
                *near.at_mut(x, y) = depth;
                at(x, y, share);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearer_of_two_triangles_shows() {
        let mut near = Image::filled(10, 10, f64::MIN);
        let mut draw = |far: f64, half: f64| {
            let mut count = 0;
            let corners = [[0.0, 0.0, far], [half, 0.0, far], [0.0, half, far]];
            fill_triangle(corners, &mut near, &mut |_, _, _| count += 1);
            count
        };
        assert_eq!(draw(5.0, 4.0), 15, "of so many pixels");
        assert_eq!(draw(3.0, 4.0), 0, "behind it");
        assert_eq!(draw(6.0, 1.0), 3, "before it");
        assert_eq!(draw(f64::NAN, 1.0), 0);
    }
}
