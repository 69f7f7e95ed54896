//! What is found of a walk: lenses that photos share, where each photo was taken from, points.

use nalgebra::Point3;
use shape::{Camera, Intrinsics, PhotoId, Pose, Tracks};

/// A photo that has a camera.
#[derive(Debug, Clone, PartialEq)]
pub struct Shot {
    /// The photo that it took.
    pub photo: PhotoId,
    /// Its lens, by place.
    pub lens: usize,
    /// Where it was taken from.
    pub pose: Pose,
    /// How much longer its focal length is than its lens', as a share: what focusing does.
    pub zoom: f64,
}

/// A point, and the shots that show it: their places, pixels.
#[derive(Debug, Clone, PartialEq)]
pub struct Spot {
    /// The point's place.
    pub at: Point3<f64>,
    /// What shows it where.
    pub observations: Vec<(usize, [f64; 2])>,
}

/// Lenses, shots and points.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Model {
    /// The lenses, as photos are stored.
    pub lenses: Vec<Intrinsics>,
    /// The photos that have a camera.
    pub shots: Vec<Shot>,
    /// The points.
    pub spots: Vec<Spot>,
}

impl Model {
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

    /// Distance of an observation from where its point projects; none behind the camera. \[px\]
    pub(crate) fn off_px(camera: &Camera, at: &Point3<f64>, [x, y]: [f64; 2]) -> Option<f64> {
        let px = camera.project(at)?;
        Some(libm::hypot(px.x - x, px.y - y))
    }
}

/// Tracks, ready to be looked up: observations by track, tracks by photo; pixels as photos are stored.
pub(crate) struct Seen {
    /// Of each track, where which photo shows it.
    pub(crate) tracks: Vec<Vec<(PhotoId, [f64; 2])>>,
    /// Of each photo, the tracks that it shows, and where.
    pub(crate) by_photo: Vec<Vec<(usize, [f64; 2])>>,
}

impl Seen {
    /// Of tracks; `stored` turns upright pixels of a photo to those of its file.
    pub(crate) fn new(
        tracks: &Tracks,
        photos: usize,
        stored: impl Fn(PhotoId, [f64; 2]) -> [f64; 2],
    ) -> Seen {
        let mut by_photo = vec![Vec::new(); photos];
        let one = |(t, track): (usize, &Vec<shape::Observation>)| {
            track
                .iter()
                .filter(|s| (s.photo.0 as usize) < photos)
                .map(|s| {
                    let at = stored(s.photo, s.at_px.map(f64::from));
                    by_photo[s.photo.0 as usize].push((t, at));
                    (s.photo, at)
                })
                .collect()
        };
        let tracks = tracks.points.iter().enumerate().map(one).collect();
        Seen { tracks, by_photo }
    }

    /// Where two photos show the same.
    pub(crate) fn both(&self, a: PhotoId, b: PhotoId) -> Vec<(usize, [[f64; 2]; 2])> {
        let on_b = |t: usize| {
            let other = self.tracks[t].iter().find(|(photo, _)| *photo == b);
            other.map(|(_, at)| *at)
        };
        self.by_photo[a.0 as usize]
            .iter()
            .filter_map(|(t, at)| Some((*t, [*at, on_b(*t)?])))
            .collect()
    }
}
