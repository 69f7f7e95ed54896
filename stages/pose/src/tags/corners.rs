//! Corners of a tag to a part of a pixel: its four sides as lines through their steepest points.

use nalgebra::{Matrix2, Vector2};
use shape::{Gray, Image, bilinear};

/// How far to both sides of an edge to look, as a share of the shorter side. By hand: looked at four captures: halved,
/// size −0.06 to +0.09 % for three; doubled, size −0.03 to +0.83 % (docs/lab/numbers.md).
const REACH_SHARE: f64 = 0.09;

/// Light that an edge rises by at least, of what the photo can show: white paper in the shade of the feet is 80 of
/// 255, which is less than a tenth. Chosen with the sample in view, not fitted.
const FAINT: f64 = 0.04;

/// The corners of a black square, refined; as they were where its sides cannot be seen well.
///
/// Along each side, away from the corners, the brightness is sampled across the edge; the centroid
/// of its rise is a point of the edge. A line through these points by total least squares, twice,
/// the second time without outliers; corners are where lines meet.
pub fn refined(gray: &Gray, corners: [[f64; 2]; 4]) -> [[f64; 2]; 4] {
    let at: [Vector2<f64>; 4] = corners.map(Vector2::from);
    let sides: Vec<f64> = (0..4).map(|i| (at[(i + 1) % 4] - at[i]).norm()).collect();
    let shortest = sides.iter().copied().fold(f64::MAX, f64::min);
    let reach = (shortest * REACH_SHARE).clamp(1.5, 6.0);
    let light = Light::around(gray, &at, reach + 1.5);
    let lines: Vec<Option<Line>> = (0..4)
        .map(|i| line(&light, at[i], at[(i + 1) % 4], reach))
        .collect();
    let mut refined = corners;
    for i in 0..4 {
        let (Some(before), Some(after)) = (lines[(i + 3) % 4], lines[i]) else {
            return corners;
        };
        let Some(corner) = meeting(before, after) else {
            return corners;
        };
        if (corner - at[i]).norm() > 2.5 {
            return corners;
        }
        refined[i] = corner.into();
    }
    refined
}

/// The line `n · x = c` of an edge between two rough corners.
fn line(light: &Light, a: Vector2<f64>, b: Vector2<f64>, reach: f64) -> Option<Line> {
    let along = (b - a).try_normalize(1e-9)?;
    let across = Vector2::new(-along.y, along.x);
    let length = (b - a).norm();
    let count = (length * 0.8) as usize;
    let mut points = Vec::with_capacity(count);
    for k in 0..count {
        let t = length * 0.1 + k as f64 + 0.5 * (length * 0.8).fract();
        if let Some(offset) = step(light, a + along * t, across, reach) {
            points.push(a + along * t + across * offset);
        }
    }
    let mut fitted = fitted_line(&points)?;
    for _ in 0..2 {
        let (n, c) = fitted;
        let off = shape::upper_median(points.iter().map(|p| (n.dot(p) - c).abs()));
        let most = (off? * 3.0).max(0.05);
        points.retain(|p| (n.dot(p) - c).abs() <= most);
        fitted = fitted_line(&points)?;
    }
    Some(fitted)
}

/// Where the light steps along a short line: the centroid of the slope. The lens blurs light, not
/// the file's gamma-coded values: an edge located in those is up to 0.3 px on its dark side.
fn step(light: &Light, middle: Vector2<f64>, across: Vector2<f64>, reach: f64) -> Option<f64> {
    let [width, height] = light.whole.map(|n| n as f64);
    let end = across * (reach + 1.5);
    let inside =
        |p: Vector2<f64>| p.x >= 0.0 && p.y >= 0.0 && p.x < width - 1.0 && p.y < height - 1.0;
    if !inside(middle + end) || !inside(middle - end) {
        return None;
    }
    let value = |s: f64| {
        let p = middle + across * s;
        light.at(p.x, p.y)
    };
    let rise = value(reach) - value(-reach);
    let spacing = 0.25;
    let count = (reach / spacing) as i32;
    let (mut sum, mut moment, mut strongest) = (0.0, 0.0, 0.0f64);
    for k in -count..=count {
        let s = f64::from(k) * spacing;
        let slope = (value(s + 0.5) - value(s - 0.5)) * rise.signum();
        strongest = strongest.max(slope);
        let weight = if slope > 0.05 * rise.abs() {
            slope
        } else {
            0.0
        };
        sum += weight;
        moment += weight * s;
    }
    (strongest > 0.4 * FAINT && rise.abs() > FAINT).then(|| moment / sum)
}

/// The light of a part of a photo, 0..=1, worked out once a pixel.
struct Light {
    /// Width and height of the photo, and the part's first column and row. \[px\]
    whole: [usize; 2],
    corner: [usize; 2],
    part: Image<f64>,
}

impl Light {
    /// The part around points, so far out.
    fn around(gray: &Gray, points: &[Vector2<f64>; 4], far: f64) -> Self {
        let whole = [gray.width, gray.height];
        let [(left, width), (top, height)] = [0, 1].map(|i| {
            let each = points.iter().map(|p| p[i]);
            let low = each.clone().fold(f64::MAX, f64::min) - far;
            let high = each.fold(f64::MIN, f64::max) + far;
            let first = (low.floor().max(0.0) as usize).min(whole[i]);
            let end = (high.ceil().max(0.0) as usize + 1).min(whole[i]);
            (first, end.saturating_sub(first))
        });
        let row = |y: usize| &gray.row(y)[left..left + width];
        let light = |v: &f32| libm::pow(f64::from(v.max(0.0)) / 255.0, 2.2);
        let data = (top..top + height).flat_map(row).map(light).collect();
        Light {
            whole,
            corner: [left, top],
            part: Image {
                width,
                height,
                data,
            },
        }
    }

    /// The light between pixels, bilinear; inside the part.
    fn at(&self, x: f64, y: f64) -> f64 {
        let (x0, y0) = (x.floor(), y.floor());
        let [column, row] = [x0 as usize - self.corner[0], y0 as usize - self.corner[1]];
        let at = |dx: usize, dy: usize| self.part.at(column + dx, row + dy);
        bilinear([at(0, 0), at(1, 0), at(0, 1), at(1, 1)], [x - x0, y - y0])
    }
}

/// A line `n · x = c` of the plane: its unit normal, and how far along it the line is.
pub type Line = (Vector2<f64>, f64);

/// Where two lines meet. `None` if they are parallel.
pub fn meeting((n, c): Line, (m, d): Line) -> Option<Vector2<f64>> {
    let system = Matrix2::new(n.x, n.y, m.x, m.y);
    Some(system.try_inverse()? * Vector2::new(c, d))
}

/// The line through points by total least squares. `None` of fewer than four.
pub fn fitted_line(points: &[Vector2<f64>]) -> Option<Line> {
    if points.len() < 4 {
        return None;
    }
    let mean = points.iter().sum::<Vector2<f64>>() / points.len() as f64;
    let spread: Matrix2<f64> = points
        .iter()
        .map(|p| (p - mean) * (p - mean).transpose())
        .sum();
    let eigen = spread.symmetric_eigen();
    let least = usize::from(eigen.eigenvalues[1] < eigen.eigenvalues[0]);
    let normal: Vector2<f64> = eigen.eigenvectors.column(least).into();
    Some((normal, normal.dot(&mean)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A black square turned by an angle, seen through a lens that blurs light over two pixels.
    fn square(centre: Vector2<f64>, half: f64, angle: f64) -> (Gray, [[f64; 2]; 4]) {
        let turn = nalgebra::Rotation2::new(angle);
        let mut gray = Gray::filled(80, 80, 0.0);
        for (y, x) in (0..80).flat_map(|y| (0..80).map(move |x| (y, x))) {
            let mut white = 0.0;
            for s in 0..64 {
                let at = Vector2::new(
                    x as f64 + f64::from(s % 8) / 4.0 - 0.875,
                    y as f64 + f64::from(s / 8) / 4.0 - 0.875,
                );
                let q = turn.inverse() * (at - centre);
                white += if q.x.abs() < half && q.y.abs() < half {
                    0.0
                } else {
                    1.0 / 64.0
                };
            }
            *gray.at_mut(x, y) = 255.0 * libm::powf(0.02f32 + 0.75 * white, 1.0 / 2.2);
        }
        let corner = |x: f64, y: f64| (centre + turn * Vector2::new(x * half, y * half)).into();
        (
            gray,
            [
                corner(-1.0, -1.0),
                corner(1.0, -1.0),
                corner(1.0, 1.0),
                corner(-1.0, 1.0),
            ],
        )
    }

    #[test]
    fn corners_come_out_to_a_twentieth_of_a_pixel() {
        for (i, angle) in [0.1, 0.4, 0.77].into_iter().enumerate() {
            let centre = Vector2::new(39.3 + 0.21 * i as f64, 40.7);
            let (gray, truth) = square(centre, 17.4, angle);
            let rough = truth.map(|[x, y]| [x + 0.6, y - 0.5]);
            for (got, want) in refined(&gray, rough).iter().zip(&truth) {
                let off = (Vector2::from(*got) - Vector2::from(*want)).norm();
                assert!(off < 0.05, "angle {angle}: {off} px");
            }
        }
    }

    #[test]
    fn a_flat_picture_leaves_corners_as_they_were() {
        let corners = [[20.0, 20.0], [50.0, 20.0], [50.0, 50.0], [20.0, 50.0]];
        assert_eq!(refined(&Gray::filled(80, 80, 90.0), corners), corners);
    }
}
