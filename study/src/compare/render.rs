//! A surface as a camera sees it: triangles into a buffer of depths, lit from the camera.

use nalgebra::{Point2, Vector3};
use shape::{Camera, Image, Mesh, Rgb, fill_triangle};

/// What is behind the surface. \[sRGB\]
const BACK: [u8; 3] = [233, 234, 236];

/// The surface, a colour 0..=1 a vertex, in the size of the camera's photo. Faces that reach
/// behind the camera are left out.
pub(crate) fn render(mesh: &Mesh, camera: &Camera, color: &dyn Fn(usize) -> [f32; 3]) -> Rgb {
    let (width, height) = (camera.lens.width as usize, camera.lens.height as usize);
    let mut picture = Rgb::filled(width, height, BACK);
    let mut nearest = Image::filled(width, height, 0.0f64);
    let seen: Vec<Option<(Point2<f64>, f64)>> = (0..mesh.positions.len() as u32)
        .map(|v| camera.project_with_depth(&mesh.point(v)))
        .collect();
    let eye = camera.centre();
    let lit_by = |(v, n): (u32, Vector3<f64>)| {
        let to_eye = (eye - mesh.point(v)).normalize();
        let n = if n == Vector3::zeros() { to_eye } else { n };
        0.3 + 0.7 * n.dot(&to_eye).abs()
    };
    let light: Vec<f64> = (0..).zip(mesh.normals()).map(lit_by).collect();
    for face in &mesh.faces {
        let [Some(a), Some(b), Some(c)] = face.map(|v| seen[v as usize]) else {
            continue;
        };
        let lit = face.map(|v| {
            let l = light[v as usize] as f32;
            color(v as usize).map(|x| x * l)
        });
        // Inverse depth is linear on the picture.
        let corners = [a, b, c].map(|(p, depth)| [p.x, p.y, 1.0 / depth]);
        fill_triangle(corners, &mut nearest, &mut |x, y, share| {
            let mix = |k: usize| (0..3).map(|i| lit[i][k] * share[i] as f32).sum::<f32>();
            *picture.at_mut(x, y) = [0, 1, 2].map(|k| (mix(k) * 255.0).clamp(0.0, 255.0) as u8);
        });
    }
    picture
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Rotation3;
    use shape::{Intrinsics, Pose};

    #[test]
    fn the_nearer_of_two_squares_is_seen_where_it_should_be() {
        let square = |half: f32, z: f32| {
            [
                [-half, -half, z],
                [half, -half, z],
                [half, half, z],
                [-half, half, z],
            ]
        };
        let mesh = Mesh {
            positions: [square(50.0, 0.0), square(10.0, -100.0)].concat(),
            faces: vec![[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]],
            ..Mesh::default()
        };
        // One pixel is 1 mm at the large square, which the camera sees from 1000 mm.
        let camera = Camera {
            lens: Intrinsics::simple(201, 201, 1000.0),
            pose: Pose {
                rotation: Rotation3::identity(),
                translation: Vector3::new(0.0, 0.0, 1000.0),
            },
        };
        let near_is_red = |v: usize| {
            if v < 4 {
                [0.0, 0.0, 1.0]
            } else {
                [1.0, 0.0, 0.0]
            }
        };
        let picture = render(&mesh, &camera, &near_is_red);
        let count = |f: fn(&[u8; 3]) -> bool| picture.data.iter().filter(|p| f(p)).count();
        assert_eq!(count(|p| *p == BACK), 201 * 201 - 101 * 101);
        // 10 mm at 900 mm are 11.1 px.
        assert_eq!(count(|p| p[0] > 0 && p[2] == 0), 23 * 23);
        assert!(picture.at(100, 100)[0] > 250, "seen head on");
        assert_eq!(picture.at(100, 140)[0], 0, "the large one");
    }
}
