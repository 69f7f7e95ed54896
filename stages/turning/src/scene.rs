//! One standing camera, and somebody who turns before it: how body, floor and picture belong together.
//!
//! The camera is the origin, z is up, and it looks along y, downward by its pitch. Lengths are shares of the
//! distance from the camera to the axis, which is (0, 1).

use nalgebra::{Matrix2x3, Matrix3, Point3, Rotation3, Vector2, Vector3};
use shape::{Camera, Intrinsics, Pose};

/// Where the body is on a photo.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Step {
    /// How far it turned from facing the camera, counter-clockwise seen from above. \[rad\]
    pub azimuth: f64,
    /// How far it is beside the axis, to the camera's right, and behind it. \[distance to the axis\]
    pub off: [f64; 2],
    /// How far it leans, as a turn about the camera's right and about its view, at the camera's height. \[rad\]
    pub lean: [f64; 2],
}

/// Unknowns of a step, structural: its azimuth, where it is, how it leans.
pub const PER_STEP: usize = 5;

/// The whole motion.
#[derive(Debug, Clone, PartialEq)]
pub struct Motion {
    /// How far the camera looks downward. \[rad\]
    pub pitch: f64,
    /// By photo.
    pub steps: Vec<Step>,
}

impl Step {
    /// fixed_from_body.
    pub fn pose(&self) -> Pose {
        let lean = Rotation3::new(Vector3::new(self.lean[0], self.lean[1], 0.0));
        let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), self.azimuth);
        Pose {
            rotation: lean * turn,
            translation: Vector3::new(self.off[0], 1.0 + self.off[1], 0.0),
        }
    }

    /// From the body's frame to that in which the camera is fixed.
    pub fn to_fixed(&self, x: &Vector3<f64>) -> Vector3<f64> {
        self.pose().apply(&Point3::from(*x))
    }

    /// How a point of the body moves in the fixed frame by azimuth, by each of the offsets, and by each lean.
    pub fn slopes(&self, x: &Vector3<f64>) -> [Vector3<f64>; PER_STEP] {
        let at = self.pose().rotation * x;
        [
            Vector3::z().cross(&at),
            Vector3::x(),
            Vector3::y(),
            Vector3::x().cross(&at),
            Vector3::y().cross(&at),
        ]
    }

    /// Goes by what was solved for its unknowns.
    pub fn stepped(&mut self, by: &[f64]) {
        self.azimuth += by[0];
        (0..2).for_each(|k| self.off[k] += by[1 + k]);
        (0..2).for_each(|k| self.lean[k] += by[3 + k]);
    }
}

/// camera_from_fixed of a camera so pitched.
pub fn looking(pitch: f64) -> Matrix3<f64> {
    let (s, c) = libm::sincos(pitch);
    Matrix3::new(1.0, 0.0, 0.0, 0.0, -s, -c, 0.0, c, -s)
}

/// What is seen of a point of the fixed frame on the plane z = 1, how that moves with the point, and with the pitch.
/// [`None`] behind the camera.
pub fn seen(pitch: f64, x: &Vector3<f64>) -> Option<(Vector2<f64>, Matrix2x3<f64>, Vector2<f64>)> {
    let turn = looking(pitch);
    let at = turn * x;
    if at.z <= 1e-6 {
        return None;
    }
    let p = Vector2::new(at.x, at.y) / at.z;
    let by_camera = Matrix2x3::new(1.0, 0.0, -p.x, 0.0, 1.0, -p.y) / at.z;
    // Tilted further, y goes against z and z with y.
    let by_pitch = by_camera * Vector3::new(0.0, -at.z, at.y);
    Some((p, by_camera * turn, by_pitch))
}

impl Motion {
    /// The cameras as the body saw them: its axis is z, its height 0 that of the camera.
    pub fn cameras(&self, lens: Intrinsics) -> impl Iterator<Item = Camera> {
        let fixed = Rotation3::from_matrix_unchecked(looking(self.pitch));
        self.steps.iter().map(move |step| {
            let body = step.pose();
            Camera {
                lens,
                pose: Pose {
                    rotation: fixed * body.rotation,
                    translation: fixed * body.translation,
                },
            }
        })
    }

    /// camera_from_body of a photo.
    pub fn camera_from_body(&self, photo: usize) -> (Matrix3<f64>, Vector3<f64>) {
        let (turn, body) = (looking(self.pitch), self.steps[photo].pose());
        (turn * body.rotation.matrix(), turn * body.translation)
    }
}
