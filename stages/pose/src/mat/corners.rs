//! Where the corners of a mat's tags are on the disk.

use nalgebra::Point3;
use shape::Mat;

/// A tag's corners on the disk: top left, top right, bottom right, bottom left; top is outward. \[mm\]
pub fn mat_corners(mat: &Mat, id: u32) -> Option<[Point3<f64>; 4]> {
    let i = id.checked_sub(mat.first_id).filter(|i| *i < mat.count)?;
    let (sin, cos) = libm::sincos(f64::from(i) * std::f64::consts::TAU / f64::from(mat.count));
    let half = mat.tag_mm / 2.0;
    Some(
        [(1.0, 1.0), (1.0, -1.0), (-1.0, -1.0), (-1.0, 1.0)].map(|(out, left)| {
            let (r, l) = (mat.ring_mm + out * half, left * half);
            Point3::new(r * cos - l * sin, r * sin + l * cos, 0.0)
        }),
    )
}
