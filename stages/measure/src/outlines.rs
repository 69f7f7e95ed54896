//! Silhouette girths of level sections, and what photos and cameras say of the surface's error.

use crate::body::Body;
use crate::silhouette::{Support, Tangent, support_girth, tangents};
use crate::taken::Taken;
use nalgebra::Point3;
use rayon::prelude::*;
use shape::{Cameras, Landmark, Masks, Part};

/// The girth by silhouettes of a level section of the trunk, where the arms stand clear.
pub(crate) fn by_silhouettes(
    body: &Body,
    landmark: &Landmark,
    taken: &Taken,
    cameras: &Cameras,
    masks: &Masks,
) -> Option<Support> {
    let level = landmark.part == Part::Trunk && landmark.plane.normal[2].abs() > 0.999;
    if !level || taken.carried > 0.0 {
        return None;
    }
    let z = landmark.plane.point_mm[2];
    let origin = crate::section::centre(&taken.contour);
    // Arms and hands: the other rings of the slice. Legs joined in this ring are part of it.
    let slice = body.slice(z)?;
    let inside = |p: &Point3<f64>| (p - origin).xy().norm();
    let reach = taken.contour.iter().map(inside).fold(0.0, f64::max);
    let others: Vec<&[Point3<f64>]> = slice
        .rings
        .iter()
        .skip(1)
        .filter(|r| inside(&r.centre) > 0.5 * reach)
        .map(|r| r.curve.as_slice())
        .collect();
    let views: Vec<_> = cameras
        .views
        .iter()
        .filter_map(|(id, view)| Some((view, masks.views.get(id)?)))
        .collect();
    let all: Vec<Vec<Tangent>> = views
        .par_iter()
        .map(|(view, mask)| tangents(&taken.contour, &others, origin, &view.camera, mask))
        .collect();
    support_girth(&all.concat())
}

/// Standard deviation of a silhouette girth that its tangents do not show because all share it: a
/// border of masks that is off by a part of a pixel all around. \[mm\]
pub(crate) fn shared_border(cameras: &Cameras, at: Point3<f64>) -> f64 {
    /// Share of a pixel by which borders of masks are off all around.
    const BORDER_PX: f64 = 0.35;
    let sizes: Vec<f64> = cameras
        .views
        .iter()
        .map(|(_, v)| v.camera.pose.apply(&at).z / v.camera.lens.focal[0])
        .collect();
    let mean = sizes.iter().sum::<f64>() / sizes.len().max(1) as f64;
    std::f64::consts::TAU * BORDER_PX * mean
}

/// Standard deviation of the surface along its normal from the cameras: centres and residuals of
/// their adjustment, one half as many independent as there are photos, since few see one place. \[mm\]
pub(crate) fn surface_by_cameras(cameras: &Cameras, at: Point3<f64>) -> Option<f64> {
    let squares: Vec<f64> = cameras
        .views
        .iter()
        .filter(|(_, v)| v.sigma_mm > 0.0 || v.rms_px > 0.0)
        .map(|(_, v)| {
            let pixel = v.camera.pose.apply(&at).z / v.camera.lens.focal[0];
            v.sigma_mm.powi(2) + (v.rms_px * pixel).powi(2)
        })
        .collect();
    let n = squares.len() as f64;
    (n >= 2.0).then(|| (squares.iter().sum::<f64>() / n / (n / 2.0)).sqrt())
}
