//! Cameras of a turn about one axis: a fixed camera and a turning disk, seen from the disk.

use crate::adjust::damped::pose_moved;
use nalgebra::{Rotation3, Vector3};
use shape::Pose;

/// A fixed camera before a turning disk. Pose i is `R = turn · Rz(angles[i])`, `t = offset`: the
/// world's z axis is the disk's axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Ring {
    /// camera_from_world where the angle is zero, its rotation.
    pub turn: Rotation3<f64>,
    /// And its translation.
    pub offset: Vector3<f64>,
    /// How far the disk has turned, counter-clockwise from above. \[rad\]
    pub angles: Vec<f64>,
}

impl Ring {
    /// camera_from_world of each photo.
    pub fn poses(&self) -> Vec<Pose> {
        let pose = |angle: &f64| Pose {
            rotation: self.turn * Rotation3::from_axis_angle(&Vector3::z_axis(), *angle),
            translation: self.offset,
        };
        self.angles.iter().map(pose).collect()
    }

    /// The disk's axis, as the camera sees it.
    pub(crate) fn axis(&self) -> Vector3<f64> {
        self.turn * Vector3::z()
    }

    /// The ring after a step of its rotation and translation.
    pub(crate) fn moved(&self, step: &[f64]) -> Ring {
        let pose = Pose {
            rotation: self.turn,
            translation: self.offset,
        };
        let pose = pose_moved(&pose, step);
        Ring {
            turn: pose.rotation,
            offset: pose.translation,
            angles: self.angles.clone(),
        }
    }

    /// Directions of a step that change nothing that is seen: turning the world (by the first angle,
    /// or by the ring about its own axis: the same twice), lifting it along its axis, growing it.
    /// Unit vectors over rotation, translation and the first angle, with the size of a whole unit each.
    pub(crate) fn freedoms(&self) -> [([f64; 7], f64); 4] {
        let (axis, size) = (self.axis(), self.offset.norm());
        let out = (self.offset - axis * axis.dot(&self.offset)).normalize();
        let along = |d: Vector3<f64>| ([0.0, 0.0, 0.0, d.x, d.y, d.z, 0.0], size);
        [
            ([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0], 1.0),
            ([axis.x, axis.y, axis.z, 0.0, 0.0, 0.0, 0.0], 1.0),
            along(axis),
            along(out),
        ]
    }
}
