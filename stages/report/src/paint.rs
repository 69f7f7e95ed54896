//! Colours for a surface without an atlas: each vertex takes those of the photos that see it best.

use nalgebra::{Point2, Vector2, Vector3};
use shape::{Adjacency, Camera, Mask, Mesh, Rgb};

/// Height of the pictures that give what hides what (structural: size of a picture). \[px\]
const DEPTH_PX: u32 = 800;
/// Views flatter than this (cosine) show nothing. By hand: not on record.
const FLATTEST: f64 = 0.2;
/// How much straighter views count more: high, for means of many views are blurred.
/// It is structural: how views are mixed in a picture.
const SHARPNESS: i32 = 8;
/// What no photo shows (structural: a colour).
const UNSEEN: [f64; 3] = [204.0, 189.0, 173.0];

/// The sums of colours at each vertex.
pub(crate) struct Paint<'a> {
    mesh: &'a Mesh,
    normals: Vec<Vector3<f64>>,
    reach_mm: f64,
    sums: Vec<([f64; 3], f64)>,
}

impl<'a> Paint<'a> {
    /// Nothing is painted yet.
    pub(crate) fn new(mesh: &'a Mesh) -> Self {
        Paint {
            mesh,
            normals: mesh.normals(),
            reach_mm: 2.0 * mesh.mean_edge(),
            sums: vec![([0.0; 3], 0.0); mesh.positions.len()],
        }
    }

    /// Adds what a photo shows, inside its silhouette.
    pub(crate) fn add(&mut self, photo: &Rgb, mask: &Mask, camera: &Camera) {
        let small = DEPTH_PX.min(camera.lens.height);
        let width = (camera.lens.width * small).div_ceil(camera.lens.height);
        let seen_from = camera.resized(width, small);
        let depth = depths(self.mesh, &seen_from);
        let centre = camera.centre();
        // Beside the border a photo shows what is behind.
        let inward = (camera.lens.height as f64 / 400.0).max(1.0);
        for (v, normal) in (0u32..).zip(&self.normals) {
            let p = self.mesh.point(v);
            let cosine = normal.dot(&(centre - p).normalize());
            if cosine.is_nan() || cosine < FLATTEST {
                continue;
            }
            let (Some(at), Some((small, far))) =
                (camera.project(&p), seen_from.project_with_depth(&p))
            else {
                continue;
            };
            let beside = [[0.0, 0.0], [1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]];
            let mut around = beside.iter().map(|d| at + Vector2::from(*d) * inward);
            let hidden = match pixel(small, width as usize, seen_from.lens.height as usize) {
                Some((x, y)) => far > f64::from(depth[y * width as usize + x]) + self.reach_mm,
                None => true,
            };
            if hidden || !around.all(|q| mask.shows(q)) {
                continue;
            }
            let Some((x, y)) = pixel(at, photo.width, photo.height) else {
                continue;
            };
            let weight = cosine.powi(SHARPNESS);
            let (sum, weights) = &mut self.sums[v as usize];
            let color = photo.at(x, y);
            (0..3).for_each(|c| sum[c] += weight * f64::from(color[c]));
            *weights += weight;
        }
    }

    /// The colours; what no photo shows takes those of its neighbours, ring by ring.
    pub(crate) fn colors(self) -> Vec<[u8; 3]> {
        let mean =
            |(sum, weight): &([f64; 3], f64)| (*weight > 0.0).then(|| sum.map(|s| s / weight));
        let mut known: Vec<Option<[f64; 3]>> = self.sums.iter().map(mean).collect();
        let beside = Adjacency::new(self.mesh);
        for _ in 0..200 {
            let before = known.clone();
            let mut grown = false;
            for v in (0..known.len()).filter(|v| before[*v].is_none()) {
                let colors: Vec<_> = beside
                    .vertices(v as u32)
                    .iter()
                    .filter_map(|n| before[*n as usize])
                    .collect();
                if !colors.is_empty() {
                    let of =
                        |c: usize| colors.iter().map(|k| k[c]).sum::<f64>() / colors.len() as f64;
                    known[v] = Some([of(0), of(1), of(2)]);
                    grown = true;
                }
            }
            if !grown {
                break;
            }
        }
        known
            .into_iter()
            .map(|c| c.unwrap_or(UNSEEN).map(|x| x.round() as u8))
            .collect()
    }
}

fn pixel(at: Point2<f64>, width: usize, height: usize) -> Option<(usize, usize)> {
    let (x, y) = (at.x.round(), at.y.round());
    let inside = x >= 0.0 && y >= 0.0 && x < width as f64 && y < height as f64;
    inside.then_some((x as usize, y as usize))
}

/// Depth of the nearest surface at each pixel, row-major. \[mm\] Infinite where there is none.
fn depths(mesh: &Mesh, camera: &Camera) -> Vec<f32> {
    let (width, height) = (camera.lens.width as usize, camera.lens.height as usize);
    let mut nearest = vec![f32::INFINITY; width * height];
    let seen = |v: u32| camera.project_with_depth(&mesh.point(v));
    let corners: Vec<_> = (0..mesh.positions.len() as u32).map(seen).collect();
    for face in &mesh.faces {
        let [Some(a), Some(b), Some(c)] = face.map(|v| corners[v as usize]) else {
            continue;
        };
        let area = (b.0 - a.0).perp(&(c.0 - a.0));
        if area == 0.0 {
            continue;
        }
        let low = |i: usize| a.0[i].min(b.0[i]).min(c.0[i]).ceil().max(0.0) as usize;
        let high = |i: usize, n: usize| {
            let most = a.0[i].max(b.0[i]).max(c.0[i]).floor() + 1.0;
            (most.max(0.0) as usize).min(n)
        };
        for y in low(1)..high(1, height) {
            for x in low(0)..high(0, width) {
                let p = Point2::new(x as f64, y as f64);
                let u = (c.0 - b.0).perp(&(p - b.0)) / area;
                let v = (a.0 - c.0).perp(&(p - c.0)) / area;
                let w = 1.0 - u - v;
                if u >= 0.0 && v >= 0.0 && w >= 0.0 {
                    let far = (u * a.1 + v * b.1 + w * c.1) as f32;
                    let at = &mut nearest[y * width + x];
                    *at = at.min(far);
                }
            }
        }
    }
    nearest
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Looks along +y from far away; 1 px is 1 mm at the origin.
    fn camera() -> Camera {
        let rotation = nalgebra::Rotation3::from_matrix_unchecked(nalgebra::Matrix3::new(
            1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0,
        ));
        Camera {
            lens: shape::Intrinsics::simple(200, 200, 5000.0),
            pose: shape::Pose {
                rotation,
                translation: Vector3::new(0.0, 0.0, 5000.0),
            },
        }
    }

    /// A square across the view at some y, facing the camera.
    fn square(y: f32, half: f32) -> Mesh {
        let n = 20u32;
        let at = |i: u32| half * (2.0 * i as f32 / n as f32 - 1.0);
        let mut mesh = Mesh::default();
        for i in 0..=n {
            mesh.positions.extend((0..=n).map(|j| [at(j), y, at(i)]));
        }
        for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
            let v = i * (n + 1) + j;
            mesh.faces
                .extend([[v, v + 1, v + n + 2], [v, v + n + 2, v + n + 1]]);
        }
        mesh
    }

    /// Red to the left of the middle, blue to the right.
    fn photo() -> Rgb {
        let data = (0..200 * 200).map(|i| {
            if i % 200 < 100 {
                [250, 0, 0]
            } else {
                [0, 0, 250]
            }
        });
        Rgb {
            width: 200,
            height: 200,
            data: data.collect(),
        }
    }

    #[test]
    fn a_vertex_takes_the_colour_that_the_photo_shows_of_it() {
        let mesh = square(0.0, 50.0);
        let mut paint = Paint::new(&mesh);
        paint.add(&photo(), &Mask::filled(200, 200, 255), &camera());
        for (p, color) in mesh.positions.iter().zip(paint.colors()) {
            if p[0].abs() > 2.0 {
                assert_eq!(
                    color,
                    if p[0] < 0.0 { [250, 0, 0] } else { [0, 0, 250] },
                    "{p:?}"
                );
            }
        }
    }

    #[test]
    fn what_is_hidden_or_outside_the_silhouette_takes_no_colour_of_the_photo() {
        let (front, back) = (square(0.0, 30.0), square(400.0, 60.0));
        let mut both = front.clone();
        let first = both.positions.len() as u32;
        both.positions.extend(&back.positions);
        both.faces
            .extend(back.faces.iter().map(|f| f.map(|v| v + first)));
        let mut mask = Mask::filled(200, 200, 255);
        (0..40).for_each(|y| (0..200).for_each(|x| *mask.at_mut(x, y) = 0));
        let mut paint = Paint::new(&both);
        paint.add(&photo(), &mask, &camera());
        for (p, (_, weight)) in both.positions.iter().zip(&paint.sums) {
            let hidden = p[1] > 1.0 && p[0].abs() < 24.0 && p[2].abs() < 24.0;
            assert!(!hidden || *weight == 0.0, "{p:?} is hidden");
            let seen = p[1] < 1.0 || p[0].abs() > 36.0;
            let inside = p[2] < 50.0;
            assert!(!(seen && inside) || *weight > 0.0, "{p:?} is seen");
            assert!(p[2] < 68.0 || *weight == 0.0, "{p:?} is outside");
        }
    }
}
