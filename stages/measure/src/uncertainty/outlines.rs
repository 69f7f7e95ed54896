//! Silhouette girths of level sections, and what photos and cameras show of the surface's error.

use crate::features::body::Body;
use crate::sections::one::SectionMeasurement;
use crate::uncertainty::silhouette::{Support, Tangent, support_girth, tangents};
use crate::uncertainty::unobserved::{clear_sights, unconfirmed};
use nalgebra::Point3;
use rayon::prelude::*;
use shape::{Cameras, Landmark, Masks, Part};
use std::f64::consts::TAU;

/// The girth that silhouettes give of a level section of the trunk, where no arm hides it; about its tape, or of a hull, whose
/// corners are between its borders, about none. `None` where too few borders show.
pub(crate) fn by_silhouettes(
    body: &Body,
    (landmark, hull): (&Landmark, bool),
    taken: &SectionMeasurement,
    cameras: &Cameras,
    masks: &Masks,
) -> Option<Support> {
    if !is_whole(landmark, taken) {
        return None;
    }
    let origin = crate::geometry::section::centre(&taken.contour);
    let beside = limbs(body, landmark.plane.point_mm[2], &taken.contour, origin);
    let views: Vec<_> = cameras
        .views
        .iter()
        .filter_map(|(id, view)| Some((view, masks.views.get(id)?)))
        .collect();
    let all: Vec<Vec<Tangent>> = views
        .par_iter()
        .map(|(view, mask)| {
            let mask = mask.pixels();
            tangents(&taken.contour, &beside, origin, &view.camera, &mask)
        })
        .collect();
    let all = all.concat();
    if hull {
        return support_girth(&all, |_| 0.0, 0.0);
    }
    let farthest = |angle: f64| {
        let (s, c) = libm::sincos(angle);
        let out = |p: &Point3<f64>| c * (p.x - origin.x) + s * (p.y - origin.y);
        taken.contour.iter().map(out).fold(f64::MIN, f64::max)
    };
    support_girth(&all, farthest, taken.tape_mm)
}

/// Whether a section is a level one of the trunk alone, of which nothing is hidden.
fn is_whole(landmark: &Landmark, taken: &SectionMeasurement) -> bool {
    let level = landmark.part == Part::Trunk && landmark.plane.normal[2].abs() > 0.999;
    level && taken.bridged == 0.0
}

/// Arms and hands beside a section at a height: the other rings of the slice. Legs joined in this
/// ring are part of it.
fn limbs<'a>(
    body: &'a Body,
    z: f64,
    curve: &[Point3<f64>],
    origin: Point3<f64>,
) -> Vec<&'a [Point3<f64>]> {
    let inside = |p: &Point3<f64>| (p - origin).xy().norm();
    let reach = curve.iter().map(inside).fold(0.0, f64::max);
    let rings = body
        .slice(z)
        .into_iter()
        .flat_map(|s| s.rings.iter().skip(1));
    let apart = rings.filter(|r| inside(&r.centre) > 0.5 * reach);
    apart.map(|r| r.curve.as_slice()).collect()
}

/// How much of a section's tape no photo's outline confirms, see [`unconfirmed`]. \[mm\]
pub(crate) fn open_mm(
    body: &Body,
    landmark: &Landmark,
    taken: &SectionMeasurement,
    cameras: &Cameras,
) -> f64 {
    if !is_whole(landmark, taken) {
        return 0.0;
    }
    let z = landmark.plane.point_mm[2];
    let origin = crate::geometry::section::centre(&taken.contour);
    let beside = limbs(body, z, &taken.contour, origin);
    let sights = |eye: Point3<f64>| clear_sights(&taken.contour, &beside, origin, eye);
    let eyes = cameras.views.values().map(|v| v.camera.centre());
    let flat: Vec<[f64; 2]> = taken.contour.iter().map(|p| [p.x, p.y]).collect();
    unconfirmed(&flat, eyes.flat_map(sights).collect())
}

/// Standard deviation of a silhouette girth that its tangents do not show because all share it: a
/// border of masks that is off by a part of a pixel all around. \[mm\]
pub(crate) fn shared_border(cameras: &Cameras, at: Point3<f64>) -> f64 {
    /// Share of a pixel by which borders of masks are off all around. By hand: looked at five captures, at 0.7 and 1.4
    /// of it: intervals change by at most 18 and 18 %.
    const BORDER_PX: f64 = 0.35;
    let sizes: Vec<f64> = cameras
        .views
        .iter()
        .map(|(_, v)| v.camera.pose.apply(&at).z / v.camera.lens.focal[0])
        .collect();
    let mean = sizes.iter().sum::<f64>() / sizes.len().max(1) as f64;
    TAU * BORDER_PX * mean
}

/// Standard deviation of the surface along its normal from the cameras: centres and residuals of
/// their adjustment, one half as many independent as there are photos, since few see one place.
/// `None` where nobody knows how sure the cameras are; of a subject that sways only residuals are
/// known. \[mm\]
pub(crate) fn surface_by_cameras(cameras: &Cameras, at: Point3<f64>) -> Option<f64> {
    let mean = |squares: Vec<f64>| {
        let n = squares.len() as f64;
        (n >= 2.0).then(|| squares.iter().sum::<f64>() / n)
    };
    let views = || cameras.views.values();
    let centres = mean(views().filter_map(|v| Some(v.sigma_mm?.powi(2))).collect());
    let residuals = views().filter_map(|v| {
        let pixel = v.camera.pose.apply(&at).z / v.camera.lens.focal[0];
        Some((v.rms_px? * pixel).powi(2))
    });
    let residuals = mean(residuals.collect());
    let known = [centres, residuals];
    let sum: f64 = known.iter().flatten().sum();
    let seen = cameras.views.len() as f64;
    (known != [None; 2]).then(|| (sum / (seen / 2.0)).sqrt())
}
