//! The silhouette force: where the surface's occluding contour should run, and where it runs.
//!
//! A picture's horizon, along which lines of sight graze the surface, is the one place where
//! consistency of brightness gives nothing and the silhouette gives all (Hernández and Schmitt 2004,
//! sec. 6; the horizon term of Delaunoy and Prados 2011 becomes this when silhouettes are known).

use crate::evidence::scene::Scene;
use crate::pictures::depth::DepthMap;
use crate::pictures::picture::Picture;
use nalgebra::{Point3, Vector3};
use rayon::prelude::*;

/// One pull on a vertex: the contour is `gap + slope * d` mm inside of the silhouette's border when
/// the vertex has moved outward by `d` mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pull {
    /// The vertex.
    pub vertex: u32,
    /// The picture.
    pub picture: u16,
    /// Its share, 0..=1.
    pub weight: f64,
    /// How far inside of the border the contour is. \[mm\]
    pub gap: f64,
    /// How the gap changes as the vertex moves outward; about −1.
    pub slope: f64,
}

/// All pulls on a mesh. Gaps beyond `most_px` pixels count less and less (Huber).
pub fn pulls(scene: &Scene<'_>, most_px: f64) -> Vec<Pull> {
    let (mesh, normals) = (scene.mesh, &scene.normals);
    let one = |(i, (picture, map)): (usize, (&Picture, &DepthMap))| -> Vec<Pull> {
        if picture.inside.is_none() {
            return vec![];
        }
        let toward = |v: usize| picture.centre - mesh.point(v as u32);
        let faces: Vec<bool> = (0..mesh.positions.len())
            .map(|v| normals[v].dot(&toward(v)) >= 0.0)
            .collect();
        let mut pulls = Vec::new();
        for v in 0..faces.len() {
            if !faces[v] {
                continue;
            }
            for j in scene.around.vertices(v as u32).iter().map(|j| *j as usize) {
                if faces[j] {
                    continue;
                }
                let [here, there] = [v, j].map(|v| normals[v].dot(&toward(v).normalize()));
                let t = here / (here - there);
                let (a, b) = (mesh.point(v as u32), mesh.point(j as u32));
                let (n, edge) = (normals[v].lerp(&normals[j], t), b - a);
                // The chord runs beneath the surface: by an eighth of edge times turn of the normal.
                let sag = t * (1.0 - t) * 0.5 * (normals[j] - normals[v]).dot(&edge);
                let x = a + edge * t + n * sag;
                let Some(pull) = pull(picture, map, &x, &n, most_px) else {
                    continue;
                };
                for (vertex, share) in [(v, 1.0 - t), (j, t)] {
                    pulls.push(Pull {
                        vertex: vertex as u32,
                        picture: i as u16,
                        weight: pull.0 * share,
                        gap: pull.1,
                        slope: pull.2,
                    });
                }
            }
        }
        pulls
    };
    let pictures = scene.pictures.par_iter().zip(&scene.maps);
    pictures.enumerate().flat_map_iter(one).collect()
}

/// Weight, gap and slope at one point of the contour. [`None`] where it is not the outermost.
fn pull(
    picture: &Picture,
    map: &DepthMap,
    x: &Point3<f64>,
    normal: &Vector3<f64>,
    most_px: f64,
) -> Option<(f64, f64, f64)> {
    let (at, depth) = picture.project(x)?;
    if !picture.holds(at, 8.0) {
        return None;
    }
    let [dx, dy] = picture.jacobian(x).map(|row| row.dot(normal));
    let length = libm::hypot(dx, dy);
    if length <= 0.0 {
        return None;
    }
    let out = [dx / length, dy / length];
    let beside = |px: f64| [at[0] + out[0] * px, at[1] + out[1] * px];
    // Surface beside the contour: an arm before the trunk has a contour, but the silhouette does not show it.
    if [3.0, 5.0, 8.0]
        .iter()
        .any(|px| map.at(beside(*px)).is_finite())
    {
        return None;
    }
    let read = |p: [f64; 2]| picture.inside_px(p).map(f64::from);
    let gap_px = read(at)?;
    let steep = (read(beside(1.0))? - read(beside(-1.0))?) / 2.0;
    // On the skeleton of the silhouette the distance has no direction.
    if steep > -0.3 {
        return None;
    }
    let footprint = picture.footprint(depth);
    let weight = (most_px / gap_px.abs().max(1e-9)).min(1.0);
    Some((weight, gap_px * footprint, steep * length * footprint))
}
