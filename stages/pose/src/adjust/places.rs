//! Where unknowns are in the normal equations: lenses, a ring, shots, what is open of a rim. What has no place is fixed.

use crate::adjust::damped::pose_moved;
use crate::adjust::lens::{LENS, lens_values, lens_with};
use crate::adjust::residual::{POSE, SHOT};
use crate::adjust::scene::Scene;
use nalgebra::{SMatrix, Vector3};

/// Where unknowns are.
pub(crate) struct Places {
    pub(crate) lenses: Vec<Option<usize>>,
    /// Of a ring's rotation and translation.
    pub(crate) ring: Option<usize>,
    /// Of each shot's own unknowns: its pose, or on a ring its angle, then its zoom where that is adjusted.
    pub(crate) shots: Vec<Option<usize>>,
    /// How many a shot's own unknowns are.
    own: usize,
    /// The one of them that is its zoom.
    pub(crate) zoom: Option<usize>,
    /// Of what is open of a rim.
    pub(crate) rim: Option<usize>,
    /// How many there are.
    pub(crate) count: usize,
}

/// Unknowns side by side that move a shot.
pub(crate) struct Way {
    pub(crate) at: usize,
    pub(crate) count: usize,
    /// They are its angle about this axis, then its zoom; else its rotation, translation, zoom.
    about: Option<Vector3<f64>>,
}

impl Way {
    /// Derivatives by them, from those by the shot's rotation, translation and zoom.
    pub(crate) fn by<const N: usize>(&self, by: &SMatrix<f64, N, SHOT>) -> SMatrix<f64, N, SHOT> {
        let Some(axis) = self.about else { return *by };
        let mut own = SMatrix::<f64, N, SHOT>::zeros();
        own.set_column(0, &(by.fixed_columns::<3>(0) * axis));
        own.set_column(1, &by.column(POSE));
        own
    }
}

impl Places {
    /// Of all unknowns, or of some shots' alone; `zooms`: theirs are among them. Where neither known points nor a
    /// ring's axis fix the world, the first shot does: it stays.
    pub(crate) fn new(scene: &Scene, zooms: bool, some: Option<&[bool]>) -> Places {
        let (all, on_ring) = (some.is_none(), scene.ring.is_some());
        let tied = on_ring || scene.known > 0;
        let pose = if on_ring { 1 } else { POSE };
        let zoom = zooms.then_some(pose);
        let own = zoom.map_or(pose, |zoom| zoom + 1);
        let mut count = 0;
        let mut place = |free: bool, size: usize| {
            free.then(|| {
                count += size;
                count - size
            })
        };
        let shot = |s| some.map_or(tied || s > 0, |some| some[s]);
        let open = scene.rim.as_ref().map(|rim| rim.unknowns());
        Places {
            lenses: scene.lenses.iter().map(|_| place(all, LENS)).collect(),
            ring: place(all && on_ring, POSE),
            shots: (0..scene.shots.len())
                .map(|s| place(shot(s), own))
                .collect(),
            own,
            zoom,
            rim: open.and_then(|size| place(all, size)),
            count,
        }
    }

    /// What moves a shot.
    pub(crate) fn ways(&self, scene: &Scene, shot: usize) -> Vec<Way> {
        let way = |at, count, about| Way { at, count, about };
        let axis = scene.ring.as_ref().map(|ring| ring.axis());
        let ring = self.ring.map(|at| way(at, POSE, None));
        let own = self.shots[shot].map(|at| way(at, self.own, axis));
        ring.into_iter().chain(own).collect()
    }

    /// The scene after a step, but for its free points.
    pub(crate) fn moved(&self, scene: &Scene, step: &[f64]) -> Scene {
        let mut moved = scene.clone();
        for (lens, at) in moved.lenses.iter_mut().zip(&self.lenses) {
            let Some(at) = *at else { continue };
            let mut values = lens_values(lens);
            (0..LENS).for_each(|i| values[i] += step[at + i]);
            *lens = lens_with(lens, values);
        }
        for (s, (shot, at)) in moved.shots.iter_mut().zip(&self.shots).enumerate() {
            let Some(at) = *at else { continue };
            match &mut moved.ring {
                Some(ring) => ring.angles[s] += step[at],
                None => shot.pose = pose_moved(&shot.pose, &step[at..]),
            }
            shot.zoom += self.zoom.map_or(0.0, |zoom| step[at + zoom]);
        }
        if let Some(ring) = &mut moved.ring {
            if let Some(at) = self.ring {
                *ring = ring.moved(&step[at..]);
            }
            let poses = moved.shots.iter_mut().zip(ring.poses());
            poses.for_each(|(shot, pose)| shot.pose = pose);
        }
        if let (Some(rim), Some(at)) = (&mut moved.rim, self.rim) {
            *rim = rim.moved(&step[at..]);
            moved.points[rim.first..scene.known].copy_from_slice(&rim.corners());
        }
        moved
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::adjust::ring::Ring;
    use nalgebra::{DMatrix, Rotation3};
    use shape::{Intrinsics, PhotoId};

    /// A scene on a ring.
    pub(crate) fn turned() -> Scene {
        let ring = Ring {
            turn: Rotation3::from_euler_angles(1.7, 0.1, -0.05),
            offset: Vector3::new(10.0, 700.0, 2500.0),
            angles: vec![0.0, 0.4, 0.9],
        };
        let shots = (0..3).map(PhotoId).zip(ring.poses());
        let mut scene = Scene::of_one_lens(Intrinsics::simple(600, 800, 900.0), shots);
        scene.ring = Some(ring);
        scene
    }

    /// Rotation, translation and zoom of each shot by all unknowns.
    pub(crate) fn by_all(scene: &Scene, places: &Places) -> DMatrix<f64> {
        let mut all = DMatrix::zeros(SHOT * scene.shots.len(), places.count);
        for s in 0..scene.shots.len() {
            for way in places.ways(scene, s) {
                let mut view = all.view_mut((SHOT * s, way.at), (SHOT, way.count));
                view += way
                    .by(&SMatrix::<f64, SHOT, SHOT>::identity())
                    .columns(0, way.count);
            }
        }
        all
    }

    #[test]
    fn shots_move_as_their_derivatives_are() {
        let h = 1e-6;
        let on_ring = turned();
        let free = Scene {
            ring: None,
            known: 1,
            ..on_ring.clone()
        };
        for (scene, zooms) in [
            (&on_ring, true),
            (&on_ring, false),
            (&free, true),
            (&free, false),
        ] {
            let places = Places::new(scene, zooms, None);
            let by = by_all(scene, &places);
            for k in LENS..places.count {
                let mut step = vec![0.0; places.count];
                step[k] = h;
                let moved = places.moved(scene, &step);
                for (s, (was, is)) in scene.shots.iter().zip(&moved.shots).enumerate() {
                    let turn: Rotation3<f64> = is.pose.rotation * was.pose.rotation.inverse();
                    let shift = is.pose.translation - was.pose.translation;
                    let shot = [turn[(2, 1)], turn[(0, 2)], turn[(1, 0)]].into_iter();
                    let shot = shot
                        .chain(shift.iter().copied())
                        .chain([is.zoom - was.zoom]);
                    for (i, moved) in shot.enumerate() {
                        proof::near(moved / h, by[(SHOT * s + i, k)], 1e-5);
                    }
                }
            }
        }
    }
}
