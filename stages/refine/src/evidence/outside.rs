//! The visual hull as a bound: what shows on the background of a photo is no body, seen or hidden.
//!
//! Contours alone do not hold it: where arm and trunk nearly touch, neither has a contour of its own, and a web
//! across the gap is before the background of the one photo that looks through.

use crate::pictures::picture::Picture;
use nalgebra::{Point3, Vector3};
use rayon::prelude::*;
use shape::Mesh;

/// Farthest that a vertex is sent at once (structural: a step of a search; it goes on in the next round). \[px\]
const FARTHEST_PX: f64 = 6.0;

/// How far inward along its normal each vertex has to go until it is inside of all silhouettes but
/// for `slack_px` \[mm\]; 0 where it does already, at most six footprints.
/// Nothing is looked at where that is `known`.
pub fn outside(
    mesh: &Mesh,
    normals: &[Vector3<f64>],
    pictures: &[Picture],
    slack_px: f64,
    footprint: f64,
    known: impl Fn(usize) -> Option<f64> + Sync,
) -> Vec<f64> {
    let out = |x: &Point3<f64>| pictures.iter().any(|picture| beyond(picture, x, slack_px));
    let one = |v: usize| {
        if let Some(known) = known(v) {
            return known;
        }
        let x = mesh.point(v as u32);
        let at = |px: f64| x - normals[v] * (px * footprint);
        let mut px = 0.0;
        while px < FARTHEST_PX && out(&at(px)) {
            px += 0.5;
        }
        px * footprint
    };
    (0..mesh.positions.len())
        .into_par_iter()
        .with_min_len(1024)
        .map(one)
        .collect()
}

/// Whether a point shows more than `slack_px` outside of a picture's silhouette, and more than two standard deviations of
/// its border. What the picture does not hold may be anything.
fn beyond(picture: &Picture, x: &Point3<f64>, slack_px: f64) -> bool {
    let Some((at, _)) = picture.project(x) else {
        return false;
    };
    if !picture.holds(at, 2.0) {
        return false;
    }
    let Some(inside) = picture.inside_px(at) else {
        return false;
    };
    let out = -f64::from(inside);
    out > slack_px && out > 2.0 * picture.border_sigma(at)
}
