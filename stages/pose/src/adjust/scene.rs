//! What is adjusted, and what was seen of it.

use crate::adjust::residual::{MEDIAN_SIGMAS, off_px};
use crate::adjust::rim::OnRim;
use crate::adjust::ring::Ring;
use nalgebra::Point3;
use shape::{Camera, Intrinsics, PhotoId, Pose, upper_median};

/// A photo that has a camera.
#[derive(Debug, Clone, PartialEq)]
pub struct Shot {
    /// The photo that it took.
    pub photo: PhotoId,
    /// Its lens, by its place in [`Scene::lenses`].
    pub lens: usize,
    /// camera_from_world.
    pub pose: Pose,
    /// How much longer its focal length is than its lens', as a share: what focusing does.
    pub zoom: f64,
}

/// A point, and the shots that show it: their places, pixels.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Spot {
    /// The point's place.
    pub(crate) at: Point3<f64>,
    /// What shows it where.
    pub(crate) observations: Vec<(usize, [f64; 2])>,
}

/// Where a camera sees a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointObservation {
    /// The camera, by its place in [`Scene::shots`].
    pub camera: usize,
    /// The point, by its place in [`Scene::points`].
    pub point: usize,
    /// Where. \[px\]
    pub at_px: [f64; 2],
    /// Standard deviation of that. \[px\]
    pub sigma_px: f64,
}

/// All that is adjusted.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Scene {
    /// The lenses.
    pub lenses: Vec<Intrinsics>,
    /// The cameras.
    pub shots: Vec<Shot>,
    /// Where the cameras are bound to a turn about one axis: it; their poses follow from it.
    pub ring: Option<Ring>,
    /// Points in the world.
    pub points: Vec<Point3<f64>>,
    /// Points before this one are known and stay; those from it on are free.
    pub known: usize,
    /// Tags on the disk's rim: known points that follow from what is open of them.
    pub(crate) rim: Option<OnRim>,
}

impl Scene {
    /// Cameras that share one lens, without points.
    pub fn of_one_lens(
        lens: Intrinsics,
        shots: impl IntoIterator<Item = (PhotoId, Pose)>,
    ) -> Scene {
        let shot = |(photo, pose)| Shot {
            photo,
            lens: 0,
            pose,
            zoom: 0.0,
        };
        Scene {
            lenses: vec![lens],
            shots: shots.into_iter().map(shot).collect(),
            ..Scene::default()
        }
    }

    /// The camera of a shot.
    pub fn camera(&self, shot: usize) -> Camera {
        let shot = &self.shots[shot];
        let lens = &self.lenses[shot.lens];
        Camera {
            lens: Intrinsics {
                focal: lens.focal.map(|f| f * (1.0 + shot.zoom)),
                ..*lens
            },
            pose: shot.pose,
        }
    }

    /// All cameras.
    pub(crate) fn cameras(&self) -> Vec<Camera> {
        (0..self.shots.len()).map(|s| self.camera(s)).collect()
    }

    /// Points, all of them free, in place of those there are; what was seen of them.
    pub(crate) fn filled<'a>(
        &mut self,
        spots: impl IntoIterator<Item = &'a Spot>,
        sigma_px: f64,
    ) -> Vec<PointObservation> {
        self.points.clear();
        self.added(spots, sigma_px)
    }

    /// Free points beside those there are; what was seen of them.
    pub(crate) fn added<'a>(
        &mut self,
        spots: impl IntoIterator<Item = &'a Spot>,
        sigma_px: f64,
    ) -> Vec<PointObservation> {
        let mut seen = Vec::new();
        for spot in spots {
            let point = self.points.len();
            self.points.push(spot.at);
            let one = |(camera, at_px): &(usize, [f64; 2])| PointObservation {
                camera: *camera,
                point,
                at_px: *at_px,
                sigma_px,
            };
            seen.extend(spot.observations.iter().map(one));
        }
        seen
    }
}

/// How far each observation is from where its point projects; infinite behind the camera. \[px\]
pub(crate) fn offs(scene: &Scene, observations: &[PointObservation]) -> Vec<f64> {
    let cameras = scene.cameras();
    let off = |o: &PointObservation| {
        off_px(&cameras[o.camera], &scene.points[o.point], o.at_px).unwrap_or(f64::INFINITY)
    };
    observations.iter().map(off).collect()
}

/// Median distance between observations and projections. \[px\]
pub(crate) fn median_px(scene: &Scene, observations: &[PointObservation]) -> f64 {
    upper_median(offs(scene, observations)).unwrap_or(0.0)
}

/// Standard deviation of observations, by the median. \[px\]
pub(crate) fn scatter_px(scene: &Scene, observations: &[PointObservation]) -> f64 {
    median_px(scene, observations) / MEDIAN_SIGMAS
}
