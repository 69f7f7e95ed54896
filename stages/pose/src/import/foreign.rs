//! A camera out of a file that somebody else wrote.

use nalgebra::{Matrix3, Rotation3, Vector3};
use shape::Pose;

/// One camera of a file.
#[derive(Debug, Clone, PartialEq)]
pub struct Foreign {
    /// The photo's name.
    pub name: String,
    /// Width and height, where the file has them. \[px\]
    pub size: Option<[u32; 2]>,
    /// Focal length along x and y. \[px\]
    pub focal: [f64; 2],
    /// Principal point, the top-left pixel's centre at (0, 0). \[px\]
    pub centre: [f64; 2],
    /// k1, k2.
    pub radial: [f64; 2],
    /// camera_from_world, in the file's unit.
    pub pose: Pose,
}

/// All of a file.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Model {
    /// The cameras.
    pub cameras: Vec<Foreign>,
    /// Points, in the file's unit.
    pub points: Vec<[f64; 3]>,
    /// Millimetres of the file's unit, where it has one.
    pub unit_mm: Option<f64>,
    /// Whether its world is marked as the turntable frame, and then the ground's height.
    pub ground: Option<f64>,
}

/// A file that is not what it should be.
#[derive(Debug, thiserror::Error, PartialEq)]
pub enum ForeignError {
    /// A file that cannot be read.
    #[error("{file}: {why}")]
    Unread {
        /// The file.
        file: String,
        /// What is wrong, where.
        why: String,
    },
    /// A lens that is not known here.
    #[error(
        "{file}: the lens model {model} is not known here (pinhole, simple radial, radial and OpenCV without tangential distortion are): undistort the photos first"
    )]
    Lens {
        /// The file.
        file: String,
        /// Its name or number.
        model: String,
    },
}

/// A file that does not read.
pub(crate) fn unread(file: &str, why: impl Into<String>) -> ForeignError {
    ForeignError::Unread {
        file: file.to_owned(),
        why: why.into(),
    }
}

/// A pose from nine numbers row by row, which must be nearly a rotation, and a translation.
pub(crate) fn pose(file: &str, r: &[f64], t: &[f64]) -> Result<Pose, ForeignError> {
    let bad = || {
        unread(
            file,
            "holds an R that is no rotation, or numbers that are none",
        )
    };
    if r.len() != 9 || t.len() != 3 || r.iter().chain(t).any(|x| !x.is_finite()) {
        return Err(bad());
    }
    let m = Matrix3::from_row_slice(r);
    let svd = m.svd(true, true);
    let (Some(u), Some(v_t)) = (svd.u, svd.v_t) else {
        return Err(bad());
    };
    let near = u * v_t;
    if near.determinant() < 0.0 || (near - m).norm() > 1e-2 {
        return Err(bad());
    }
    Ok(Pose {
        rotation: Rotation3::from_matrix_unchecked(near),
        translation: Vector3::from_column_slice(t),
    })
}
