//! Cameras of a turn about one axis: a fixed camera and a turning disk, seen from the disk.

use crate::adjust::lens::LENS;
use nalgebra::{DMatrix, Rotation3, Vector3};
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

    /// How many numbers a ring's step has: three of rotation, three of translation, then the angles.
    pub fn unknowns(&self) -> usize {
        6 + self.angles.len()
    }

    /// Derivative of a step of lens and poses by one of lens and ring.
    pub(crate) fn tangent(&self) -> DMatrix<f64> {
        let count = self.angles.len();
        let mut j = DMatrix::zeros(LENS + 6 * count, LENS + self.unknowns());
        (0..LENS).for_each(|i| j[(i, i)] = 1.0);
        let axis = self.turn * Vector3::z();
        for c in 0..count {
            let at = LENS + 6 * c;
            (0..6).for_each(|i| j[(at + i, LENS + i)] = 1.0);
            (0..3).for_each(|i| j[(at + i, LENS + 6 + c)] = axis[i]);
        }
        j
    }

    /// The ring after a step: rotation, translation, angles.
    pub(crate) fn moved(&self, step: &[f64]) -> Ring {
        let mut turn = Rotation3::new(Vector3::new(step[0], step[1], step[2])) * self.turn;
        turn.renormalize();
        Ring {
            turn,
            offset: self.offset + Vector3::new(step[3], step[4], step[5]),
            angles: self
                .angles
                .iter()
                .zip(&step[6..])
                .map(|(a, s)| a + s)
                .collect(),
        }
    }

    /// Directions of a step that change nothing that is seen: turning the world (by the first angle,
    /// or by the ring about its own axis: the same twice), lifting it along its axis, growing it.
    /// Unit vectors over lens and ring, with the size of a whole unit each.
    pub(crate) fn freedoms(&self) -> Vec<(Vec<f64>, f64)> {
        let n = LENS + self.unknowns();
        let size = self.offset.norm();
        let along = |direction: Vector3<f64>| {
            let mut d = vec![0.0; n];
            (0..3).for_each(|i| d[LENS + 3 + i] = direction[i]);
            (d, size)
        };
        let mut first = vec![0.0; n];
        first[LENS + 6] = 1.0;
        let axis = self.turn * Vector3::z();
        let out = self.offset - axis * axis.dot(&self.offset);
        let mut about = vec![0.0; n];
        (0..3).for_each(|i| about[LENS + i] = axis[i]);
        let turning = [(first, 1.0), (about, 1.0)];
        let moving = [along(axis), along(out.normalize())];
        turning.into_iter().chain(moving).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tilted() -> Ring {
        Ring {
            turn: Rotation3::from_euler_angles(1.7, 0.1, -0.05),
            offset: Vector3::new(10.0, 700.0, 2500.0),
            angles: vec![0.0, 0.4, 0.9],
        }
    }

    #[test]
    fn no_way_to_turn_the_world_is_left_free() {
        let ring = tilted();
        let axis = ring.turn * Vector3::z();
        let mut ways = nalgebra::DMatrix::zeros(LENS + ring.unknowns(), 2);
        (0..3).for_each(|i| ways[(LENS + i, 0)] = axis[i]);
        (0..3).for_each(|c| ways[(LENS + 6 + c, 1)] = 1.0);
        // Both move cameras alike: fixed is what neither, nor their difference, escapes.
        let moved = ring.tangent() * &ways;
        assert!((moved.column(0) - moved.column(1)).norm() < 1e-12 * moved.norm());
        let fixed: Vec<f64> = ring.freedoms().into_iter().flat_map(|f| f.0).collect();
        let fixed = nalgebra::DMatrix::from_row_slice(4, LENS + ring.unknowns(), &fixed);
        assert_eq!((fixed * ways).rank(1e-6), 2);
    }

    #[test]
    fn the_tangent_moves_poses_as_the_ring_moves() {
        let ring = tilted();
        let j = ring.tangent();
        let h = 1e-6;
        for k in 0..ring.unknowns() {
            let mut step = vec![0.0; ring.unknowns()];
            step[k] = h;
            for (c, (was, is)) in ring
                .poses()
                .iter()
                .zip(ring.moved(&step).poses())
                .enumerate()
            {
                let m = (is.rotation * was.rotation.inverse()).into_inner() / h;
                let turn = Vector3::new(m[(2, 1)], m[(0, 2)], m[(1, 0)]);
                let shift = (is.translation - was.translation) / h;
                for i in 0..3 {
                    let at = LENS + 6 * c + i;
                    proof::near(turn[i], j[(at, LENS + k)], 1e-5);
                    proof::near(shift[i], j[(at + 3, LENS + k)], 1e-5);
                }
            }
        }
    }
}
