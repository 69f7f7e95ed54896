//! A known length between two points that somebody pointed at in photos: the edge of a sheet on the floor, a rule, a door.

use crate::frame::tag_scale::LEAST_SCALE_SIGMA;
use nalgebra::{Matrix3, Point3};
use shape::triangulate;
use shape::{Camera, Cameras, Reference};
use stage::{Message, message};

stage::messages! {
    NO_PHOTO = "warn-points-photo": "the two points of [reference] are given for {name}, which is no photo of the capture, or one without a camera: correct the name, or point at another; the length was passed over";
    FEW_PHOTOS = "warn-points-few": "the two points of [reference] are seen in {count} {count|photo|photos} with a camera, from too much the same side: point at them in photos that were taken some steps apart; the length was passed over";
    MISS = "warn-points-miss": "the two points of [reference] miss each other by {off:.0 px} from photo to photo: are they the same two in each, in the same order, at full size, and do they move with the subject? The length was passed over";
    UNSURE = "warn-points-unsure": "the length between the two points of [reference] has a standard deviation of {sigma:.0 %}: point at two that are farther apart, in more photos; the length was passed over";
}

/// Standard deviation of a pointed pixel, of each coordinate. By hand: looked at one capture, halved and doubled: no
/// more than chance (docs/lab/numbers.md). \[px\]
const POINTED_PX: f64 = 2.0;
/// Rays that miss by more than so many of those, root mean square, belong to no one point. By hand: looked at one
/// capture, halved and doubled: nothing changes, for its two points are good (docs/lab/numbers.md).
const MOST_MISS_SIGMAS: f64 = 5.0;
/// A length that is less sure than this share is not used. By hand: looked at one capture, halved and doubled: nothing
/// changes, for its two points are good (docs/lab/numbers.md).
const UNSUREST_SHARE: f64 = 0.2;

/// The length in the cameras' unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Between {
    pub(crate) length: f64,
    /// Its standard deviation, as a share.
    pub(crate) sigma: f64,
}

/// Why two points have no length.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum NoLength {
    /// A name that no photo has.
    Photo(String),
    /// Too few photos, or from one side only.
    Few(usize),
    /// Rays that do not meet.
    Miss(f64),
    /// A length lost in its own doubt.
    Unsure(f64),
}

impl NoLength {
    /// As people read it.
    pub(crate) fn message(&self) -> Message {
        match self {
            NoLength::Photo(name) => message!(NO_PHOTO, name = name),
            NoLength::Few(count) => message!(FEW_PHOTOS, count = count),
            NoLength::Miss(px) => message!(MISS, off = px),
            NoLength::Unsure(percent) => message!(UNSURE, sigma = percent),
        }
    }
}

/// How long the way is between the two points of a reference.
///
/// # Errors
///
/// Where they give none: see [`NoLength`].
pub(crate) fn between(cameras: &Cameras, known: &Reference) -> Result<Between, NoLength> {
    let named = |name: &str| cameras.views.values().find(|view| view.name == name);
    let mut views: Vec<Camera> = Vec::new();
    let mut ends: [Vec<(usize, [f64; 2])>; 2] = [vec![], vec![]];
    for seen in &known.seen {
        let view = named(&seen.photo).ok_or_else(|| NoLength::Photo(seen.photo.clone()))?;
        for (end, px) in ends.iter_mut().zip(seen.px) {
            end.push((views.len(), px));
        }
        views.push(view.camera);
    }
    let few = NoLength::Few(views.len());
    if views.len() < 2 {
        return Err(few);
    }
    let [from, to] = ends.map(|end| triangulate(&views, &end));
    let ((from, a), (to, b)) = (from.ok_or(few.clone())?, to.ok_or(few.clone())?);
    let miss = ((a * a + b * b) / 2.0).sqrt();
    if miss > MOST_MISS_SIGMAS * POINTED_PX {
        return Err(NoLength::Miss(miss));
    }
    let px = miss.max(POINTED_PX);
    let (a, b) = (doubt(&views, &from, px), doubt(&views, &to, px));
    let doubt = a.zip(b).map(|(a, b)| a + b).ok_or(few)?;
    let (way, length) = ((to - from).normalize(), (to - from).norm());
    let sigma = libm::hypot(way.dot(&(doubt * way)).sqrt() / length, LEAST_SCALE_SIGMA);
    match sigma < UNSUREST_SHARE {
        true => Ok(Between { length, sigma }),
        false => Err(NoLength::Unsure(100.0 * sigma)),
    }
}

/// The covariance of a point from pixels of a standard deviation: the inverse of what all photos.
fn doubt(views: &[Camera], at: &Point3<f64>, px: f64) -> Option<Matrix3<f64>> {
    let mut information = Matrix3::zeros();
    for camera in views {
        let (_, by_point) = camera.project_with_jacobian(at)?;
        information += by_point.transpose() * by_point / (px * px);
    }
    information.try_inverse()
}
