//! Whether a surface is cut through lengthwise: a large part of it is in one upright plane, as no body's is.

use nalgebra::{Point3, Vector3};
use shape::Mesh;

/// Planes that are tried, each of one face (structural: even steps through all).
const TRIED: usize = 256;
/// Faces that are asked about each (structural: even steps through all).
const ASKED: usize = 8192;
/// A face is in a plane within this share of the surface's height (structural: twice a cell of a scan).
const NEAR: f64 = 0.003;
/// And where it leans from it by less than this (structural). \[cos\]
const ALONG: f64 = 0.94;

/// A plane is upright where its normal rises less than this (structural: half of all); soles, floors and crowns are level. \[sin\]
const UPRIGHT: f64 = 0.5;

/// The greatest share of a surface's area that is in one upright plane.
pub(crate) fn flat_share(mesh: &Mesh) -> f64 {
    let Some((low, high)) = mesh.bounds() else {
        return 0.0;
    };
    let near = NEAR * (high.z - low.z);
    // Where a face is, its unit normal, its area.
    let step = mesh.faces.len().div_ceil(ASKED).max(1);
    let faces: Vec<(Point3<f64>, Vector3<f64>, f64)> = (0..mesh.faces.len())
        .step_by(step)
        .filter_map(|f| {
            let [a, b, c] = mesh.triangle(f);
            let twice = (b - a).cross(&(c - a));
            let middle = Point3::from((a.coords + b.coords + c.coords) / 3.0);
            Some((middle, twice.try_normalize(0.0)?, twice.norm()))
        })
        .collect();
    let all: f64 = faces.iter().map(|f| f.2).sum();
    let share = |(at, n, _): &(Point3<f64>, Vector3<f64>, f64)| {
        let inside = |(x, m, _): &&(Point3<f64>, Vector3<f64>, f64)| {
            (x - at).dot(n).abs() < near && m.dot(n) > ALONG
        };
        faces.iter().filter(inside).map(|f| f.2).sum::<f64>() / all.max(f64::MIN_POSITIVE)
    };
    let upright = |f: &usize| faces[*f].1.z.abs() < UPRIGHT;
    // Large faces come first: a cover of a cut may be a few.
    let mut order: Vec<usize> = (0..faces.len()).filter(upright).collect();
    order.sort_by(|a, b| faces[*b].2.total_cmp(&faces[*a].2).then(a.cmp(b)));
    let (large, rest) = order.split_at(order.len().min(TRIED / 2));
    let even = rest.iter().step_by(rest.len().div_ceil(TRIED / 2).max(1));
    let tried = large.iter().chain(even);
    tried.map(|f| share(&faces[*f])).fold(0.0, f64::max)
}
