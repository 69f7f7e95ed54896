//! What motions of a body cannot be distinguished from: motions of the camera, or of the whole turn.

use nalgebra::{DMatrix, DVector, Point3, Vector3};

/// What all photos may share that is none of the body's motion, as orthonormal columns: a common turn and shift in
/// the world, and one in the cameras' own axes. The latter moves the camera against the disk (its approach is a
/// change of scale), and that is the calibration's to find.
pub struct Gauge(DMatrix<f64>);

impl Gauge {
    /// Of cameras with these centres.
    pub fn new(centres: &[Point3<f64>]) -> Self {
        let axes = |c: &Point3<f64>| {
            let radial = Vector3::new(c.x, c.y, 0.0).try_normalize(0.0);
            let radial = radial.unwrap_or(Vector3::x());
            let up = Vector3::z();
            [Vector3::x(), Vector3::y(), up, radial, up.cross(&radial)]
        };
        let mut columns: Vec<DVector<f64>> = vec![];
        for (axis, first) in (0..5).flat_map(|axis| [(axis, 0), (axis, 3)]) {
            let mut column = DVector::zeros(6 * centres.len());
            for (i, c) in centres.iter().enumerate() {
                let mut part = column.fixed_rows_mut::<3>(6 * i + first);
                part.copy_from(&axes(c)[axis]);
            }
            // Of cameras that are not all around, some are the same.
            let whole = column.norm();
            for other in &columns {
                column -= other * other.dot(&column);
            }
            if column.norm() > 1e-6 * whole {
                columns.push(column.normalize());
            }
        }
        let number = |i: usize, k: usize| columns[k][i];
        Gauge(DMatrix::from_fn(6 * centres.len(), columns.len(), number))
    }

    /// Six rows a photo, turn first, then shift.
    pub fn columns(&self) -> &DMatrix<f64> {
        &self.0
    }
}

/// So many cameras around an axis.
#[cfg(test)]
pub(crate) fn ring(photos: usize) -> Vec<Point3<f64>> {
    let step = std::f64::consts::TAU / photos as f64;
    let at = |i: usize| libm::sincos(i as f64 * step);
    (0..photos)
        .map(|i| Point3::new(3000.0 * at(i).1, 3000.0 * at(i).0, 1000.0))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_motion_is_what_all_photos_share() {
        // All around: a turn and a shift of the world, and two of each in the cameras' own axes; up is the same in both.
        let whole = Gauge::new(&ring(18)).0;
        assert_eq!(whole.ncols(), 10);
        assert!((whole.transpose() * &whole - DMatrix::identity(10, 10)).norm() < 1e-12);
        // Of one camera, both are the same.
        assert_eq!(Gauge::new(&ring(1)).0.ncols(), 6);
        assert_eq!(Gauge::new(&[]).0.ncols(), 0);
    }
}
