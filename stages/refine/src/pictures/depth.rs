//! Z-buffer: how far the surface is, seen from a picture.

use crate::pictures::picture::Picture;
use nalgebra::Point3;
use shape::Mesh;

/// The depth of the first surface along each pixel's ray.
pub struct DepthMap {
    /// Width. \[px\]
    pub width: usize,
    /// Height. \[px\]
    pub height: usize,
    /// Pixels of the picture a pixel of this map.
    pub step: f64,
    /// Depth along the optical axis, row-major; infinite where nothing is. \[mm\]
    pub depth: Vec<f32>,
}

impl DepthMap {
    /// Draws a mesh, faces that look away left out; one pixel of the map for `step` of the picture.
    pub fn new(mesh: &Mesh, picture: &Picture, step: f64) -> Self {
        let side = |n: usize| ((n as f64 / step).ceil() as usize).max(1);
        let (width, height) = (side(picture.gray.width), side(picture.gray.height));
        let mut map = DepthMap {
            width,
            height,
            step,
            depth: vec![f32::INFINITY; width * height],
        };
        let corners: Vec<_> = (0..mesh.positions.len() as u32)
            .map(|v| {
                let (at, depth) = picture.project(&mesh.point(v))?;
                Some([map.to_map(at[0]), map.to_map(at[1]), 1.0 / depth])
            })
            .collect();
        for face in &mesh.faces {
            let [Some(a), Some(b), Some(c)] = face.map(|v| corners[v as usize]) else {
                continue;
            };
            map.draw(a, b, c);
        }
        map
    }

    /// A pixel of the picture as a pixel of the map.
    #[inline]
    fn to_map(&self, at: f64) -> f64 {
        (at + 0.5) / self.step - 0.5
    }

    /// One triangle, corners as column, row, inverse depth.
    fn draw(&mut self, a: [f64; 3], b: [f64; 3], c: [f64; 3]) {
        // Rows grow downward, so a face that looks here runs clockwise in the picture's axes.
        let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        if area >= 0.0 {
            return;
        }
        let span = |i: usize, n: usize| {
            let lo = a[i].min(b[i]).min(c[i]).ceil().max(0.0) as usize;
            let hi = a[i].max(b[i]).max(c[i]).floor().min(n as f64 - 1.0);
            lo..if hi < 0.0 { 0 } else { hi as usize + 1 }
        };
        let (columns, rows) = (span(0, self.width), span(1, self.height));
        let inverse = 1.0 / area;
        for y in rows {
            let row = y as f64;
            for x in columns.clone() {
                let column = x as f64;
                let part = |p: [f64; 3], q: [f64; 3]| {
                    ((q[0] - p[0]) * (row - p[1]) - (q[1] - p[1]) * (column - p[0])) * inverse
                };
                let (wa, wb, wc) = (part(b, c), part(c, a), part(a, b));
                if wa < 0.0 || wb < 0.0 || wc < 0.0 {
                    continue;
                }
                let depth = (1.0 / (wa * a[2] + wb * b[2] + wc * c[2])) as f32;
                let at = y * self.width + x;
                self.depth[at] = self.depth[at].min(depth);
            }
        }
    }

    /// The depth seen at a pixel of the picture: the map's nearest pixel. Infinite where nothing is.
    #[inline]
    pub fn at(&self, pixel: [f64; 2]) -> f32 {
        let (x, y) = (self.to_map(pixel[0]).round(), self.to_map(pixel[1]).round());
        if x < 0.0 || y < 0.0 || x >= self.width as f64 || y >= self.height as f64 {
            return f32::INFINITY;
        }
        self.depth[y as usize * self.width + x as usize]
    }

    /// Whether a point is the first along its ray, `bias_mm` allowed (paper, III-D 1).
    pub fn shows(&self, picture: &Picture, x: &Point3<f64>, bias_mm: f64) -> bool {
        match picture.project(x) {
            Some((at, depth)) => depth - bias_mm <= f64::from(self.at(at)),
            None => false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Rotation3, Vector3};
    use shape::{Camera, Gray, Intrinsics, Pose};

    #[test]
    fn the_nearer_of_two_faces_is_seen_and_one_that_looks_away_is_not() {
        let camera = Camera {
            lens: Intrinsics::simple(60, 40, 50.0),
            pose: Pose {
                rotation: Rotation3::identity(),
                translation: Vector3::zeros(),
            },
        };
        let picture = Picture::new(Gray::filled(60, 40, 0.0), &camera, None, 0);
        let square = |z: f32| [[-9.0, -9.0, z], [9.0, -9.0, z], [0.0, 9.0, z]];
        let positions = [100.0, 80.0, 60.0].map(square).concat();
        // Seen from the origin along +z with y down: the first two look here, the third away.
        let faces = vec![[0, 2, 1], [3, 5, 4], [6, 7, 8]];
        let mesh = Mesh {
            positions,
            faces,
            ..Mesh::default()
        };
        let map = DepthMap::new(&mesh, &picture, 1.0);
        let x = Point3::new(0.0, 0.0, 80.0);
        let ([c, r], _) = picture.project(&x).unwrap();
        assert_eq!(map.at([c, r]), 80.0);
        assert!(map.shows(&picture, &x, 0.1));
        assert!(!map.shows(&picture, &Point3::new(0.0, 0.0, 100.0), 0.1));
        assert!(map.depth.iter().all(|d| *d >= 80.0));
        assert!(map.at([1.0, 1.0]).is_infinite());
    }
}
