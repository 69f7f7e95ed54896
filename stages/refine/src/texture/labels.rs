//! Which photo each face takes its colours from.

use crate::pictures::depth::DepthMap;
use crate::pictures::picture::Picture;
use crate::texture::charts::NOWHERE;
use crate::texture::seams::give_to_photos_beside;
use nalgebra::{Point3, Vector3};
use rayon::prelude::*;
use shape::Mesh;

/// For each face, with those `beside` it, the picture that shows it best, and is best for its neighbours too: the fewer
/// seams, the better. [`NOWHERE`] where no picture shows all three corners well inside of its
/// silhouette, so that what is behind is never taken for the body.
pub fn labels(mesh: &Mesh, beside: &[Vec<u32>], pictures: &[Picture], rounds: usize) -> Vec<u16> {
    let maps: Vec<_> = pictures
        .par_iter()
        .map(|p| DepthMap::new(mesh, p, 1.0))
        .collect();
    let shown: Vec<Vec<bool>> = pictures
        .par_iter()
        .zip(&maps)
        .map(|(picture, map)| {
            let shows = |v: u32| shows(picture, map, &mesh.point(v));
            (0..mesh.positions.len() as u32).map(shows).collect()
        })
        .collect();
    let quality: Vec<Vec<(u16, f32)>> = (0..mesh.faces.len())
        .into_par_iter()
        .map(|f| {
            let corners = mesh.triangle(f);
            let centre =
                Point3::from((corners[0].coords + corners[1].coords + corners[2].coords) / 3.0);
            let normal = mesh
                .area_vector(f)
                .try_normalize(0.0)
                .unwrap_or_else(Vector3::zeros);
            let of = |(i, picture): (usize, &Picture)| {
                let toward = (picture.centre - centre).normalize();
                let cosine = toward.dot(&normal) as f32;
                let all = mesh.faces[f].iter().all(|v| shown[i][*v as usize]);
                (all && cosine > 0.15).then_some((i as u16, cosine))
            };
            pictures.iter().enumerate().filter_map(of).collect()
        })
        .collect();
    let best = |f: usize, favour: &dyn Fn(u16) -> f32| -> u16 {
        let score = |q: &(u16, f32)| q.1 + favour(q.0);
        let top = quality[f]
            .iter()
            .max_by(|a, b| score(a).total_cmp(&score(b)));
        top.map_or(NOWHERE, |q| q.0)
    };
    // What a seam along an edge costs, as a cosine.
    let seam = 0.25;
    let mut labels: Vec<u16> = (0..mesh.faces.len()).map(|f| best(f, &|_| 0.0)).collect();
    for _ in 0..rounds {
        let next = (0..labels.len()).into_par_iter().map(|f| {
            let like = |label: u16| {
                beside[f]
                    .iter()
                    .filter(|g| labels[**g as usize] == label)
                    .count()
            };
            best(f, &|label| seam * like(label) as f32)
        });
        labels = next.collect();
    }
    give_to_photos_beside(&mut labels, &quality, beside, f64::from(seam));
    labels
}

/// Whether a picture shows a point, two pixels inside of the silhouette at least.
fn shows(picture: &Picture, map: &DepthMap, x: &Point3<f64>) -> bool {
    let Some((at, depth)) = picture.project(x) else {
        return false;
    };
    let body = picture.inside_px(at).is_none_or(|d| d > 2.0);
    body && picture.holds(at, 3.0) && map.shows(picture, x, 4.0 * picture.footprint(depth))
}
