//! A surface from four sides on one picture, to look at.

use crate::lettering::write_on;
use nalgebra::Vector3;
use shape::{Image, Mesh, Rgb, fill_triangle};

/// Height of each view (structural: layout). \[px\]
const TALL: usize = 900;
/// Free space around it (structural: layout). \[px\]
const MARGIN: usize = 24;
/// What is behind the surface, and the surface seen head on (structural: colours). \[sRGB\]
const BACK: [u8; 3] = [236, 236, 238];
/// The surface (structural: a colour of the drawing).
const SKIN: [f64; 3] = [214.0, 190.0, 168.0];

/// The surface without perspective, from where the angle of the world is 270°, 0°, 90°, 180° (the first
/// photo's side first), z up, lit from the eye, all at one scale; what is seen from inside is red.
pub fn mesh_to_views(mesh: &Mesh) -> Rgb {
    let (mut reach, mut lo, mut hi) = (1.0f64, f64::MAX, f64::MIN);
    for v in 0..mesh.positions.len() as u32 {
        let p = mesh.point(v);
        reach = reach.max(libm::hypot(p.x, p.y));
        (lo, hi) = (lo.min(p.z), hi.max(p.z));
    }
    let unit = (TALL - 2 * MARGIN) as f64 / (hi - lo).max(1.0);
    let wide = (2.0 * reach * unit) as usize + 2 * MARGIN;
    let mut picture = Rgb::filled(4 * wide, TALL, BACK);
    for (k, angle) in [270.0f64, 0.0, 90.0, 180.0].into_iter().enumerate() {
        let (s, c) = libm::sincos(angle.to_radians());
        // Towards the eye, and to the right of the picture.
        let (eye, right) = (Vector3::new(c, s, 0.0), Vector3::new(-s, c, 0.0));
        let mut near = Image::filled(wide, TALL, f64::MIN);
        for (f, face) in mesh.faces.iter().enumerate() {
            let normal = mesh.area_vector(f);
            let faces = normal.dot(&eye) / normal.norm().max(1e-12);
            let corners = face.map(|v| {
                let p = mesh.point(v).coords;
                let x = wide as f64 / 2.0 + p.dot(&right) * unit;
                [x, MARGIN as f64 + (hi - p.z) * unit, p.dot(&eye)]
            });
            let light = 0.25 + 0.75 * faces.abs();
            let color = match faces < 0.0 {
                true => [230, 40, 30],
                false => SKIN.map(|s| (s * light) as u8),
            };
            fill_triangle(corners, &mut near, &mut |x, y, _| {
                *picture.at_mut(k * wide + x, y) = color;
            });
        }
        let label = format!("FROM {angle:.0}");
        write_on(&mut picture, (k * wide + 6, 6), 3, [255; 3], &label);
    }
    let label = format!(
        "{:.0} TALL: MM WHERE A LENGTH IS KNOWN. {} FACES",
        hi - lo,
        mesh.faces.len()
    );
    write_on(&mut picture, (6, TALL - 27), 3, [255; 3], &label);
    picture
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slab_is_wide_from_two_sides_and_narrow_from_the_other_two() {
        // 400 × 100 × 852 mm: a millimetre a pixel.
        let at = |i: usize| {
            let side = |bit: usize, half: f32| if i >> bit & 1 == 1 { half } else { -half };
            [side(0, 200.0), side(1, 50.0), side(2, 426.0) + 426.0]
        };
        let quads = [
            [0, 4, 6, 2],
            [1, 3, 7, 5],
            [0, 1, 5, 4],
            [2, 6, 7, 3],
            [0, 2, 3, 1],
            [4, 5, 7, 6],
        ];
        let mesh = Mesh {
            positions: (0..8).map(at).collect(),
            faces: quads
                .iter()
                .flat_map(|q| [[q[0], q[1], q[2]], [q[0], q[2], q[3]]])
                .collect(),
            ..Mesh::default()
        };
        let picture = mesh_to_views(&mesh);
        let wide = picture.width / 4;
        let across = |k: usize| {
            let row = &picture.row(450)[k * wide..(k + 1) * wide];
            row.iter().filter(|p| **p != BACK).count()
        };
        for (k, want) in [(0, 400usize), (1, 100), (2, 400), (3, 100)] {
            assert!(across(k).abs_diff(want) <= 1, "{k}: {}", across(k));
        }
        // Nothing shows its inside.
        assert!(picture.data.iter().all(|p| *p != [230, 40, 30]));
    }
}
