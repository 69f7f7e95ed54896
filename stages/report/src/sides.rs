//! The body from three sides with its tapes, as a picture: for paper, and for browsers without script or 3D.

use crate::labels::spread;
use crate::lengths::Lengths;
use crate::tables::escaped;
use crate::tape;
use base64::prelude::{BASE64_STANDARD, Engine as _};
use nalgebra::Vector3;
use rayon::prelude::*;
use shape::{Girth, Girths, Image, Mesh, Rgb, fill_triangle, rgb_to_jpeg};
use std::fmt::Write;

/// Height of the pictures, and free space around the body (structural: layout). \[px\]
const TALL: usize = 760;
/// White around the pictures (structural: the drawing's layout).
const MARGIN: usize = 20;
/// Width of the column that holds the names of tapes (structural: layout). \[px\]
const NAMES: f64 = 190.0;
/// Height of a line of it (structural: layout). \[px\]
const LINE: f64 = 19.0;
/// What is behind the surface, and the surface seen head on (structural: colours). \[sRGB\]
const BACK: [u8; 3] = [250, 250, 250];
/// The surface (structural: a colour of the drawing).
const SKIN: [f64; 3] = [206.0, 192.0, 180.0];

/// One side: where the eye is and what is to the right of the picture, both level.
struct Seen {
    eye: Vector3<f64>,
    right: Vector3<f64>,
}

/// A figure with the surface from its front, its left and behind, without perspective and at one scale; the
/// near half of every tape on it, named beside the first. `front` is where the subject looks.
pub(crate) fn figure(body: &Mesh, girths: &Girths, front: [f64; 3], lengths: Lengths) -> String {
    let Some((lo, hi)) = body.bounds() else {
        return String::new();
    };
    let reach = body.positions.iter().map(|p| libm::hypotf(p[0], p[1]));
    let reach = f64::from(reach.fold(1.0, f32::max));
    let scale = (TALL - 2 * MARGIN) as f64 / (hi.z - lo.z).max(2.0 * reach).max(1.0);
    let wide = (2.0 * reach * scale) as usize + 2 * MARGIN;
    let ahead = Vector3::new(front[0], front[1], 0.0);
    let ahead = ahead.try_normalize(1e-9).unwrap_or(-Vector3::y());
    // The subject's left is to the right of whoever looks at its front.
    let left = Vector3::z().cross(&ahead);
    let sides = [(ahead, left), (left, -ahead), (-ahead, -left)];
    let sides = sides.map(|(eye, right)| Seen { eye, right });
    let whole = 3.0 * wide as f64 + NAMES;
    let mut svg = format!(
        "<svg class=\"sides\" viewBox=\"0 0 {whole:.0} {TALL}\" role=\"img\" aria-label=\"the body from the front, the left and behind, with the tapes\">"
    );
    let jpeg = |side| rgb_to_jpeg(&drawn(body, side, [scale, hi.z], wide), 80);
    let jpegs: Vec<Vec<u8>> = sides.par_iter().map(jpeg).collect();
    for (k, (side, jpeg)) in sides.iter().zip(jpegs).enumerate() {
        let from = (k * wide) as f64 + if k == 0 { 0.0 } else { NAMES };
        let _ = write!(
            svg,
            "<image x=\"{from:.0}\" width=\"{wide}\" height=\"{TALL}\" href=\"data:image/jpeg;base64,{}\"/>",
            BASE64_STANDARD.encode(jpeg)
        );
        let place = |p: [f32; 3]| {
            let p = Vector3::from(p.map(f64::from));
            let x = from + wide as f64 / 2.0 + p.dot(&side.right) * scale;
            [x, MARGIN as f64 + (hi.z - p.z) * scale]
        };
        let mut ends = Vec::new();
        for girth in &girths.girths {
            let (path, end) = near_half(girth, side, &place);
            let _ = write!(svg, "<path class=\"band\" d=\"{path}\"/>");
            ends.extend(end.map(|end| (end, girth)));
        }
        if k == 0 {
            names(&mut svg, ends, wide as f64, lengths);
        }
    }
    svg + "</svg>"
}

/// The surface from a side, lit from the eye.
fn drawn(body: &Mesh, side: &Seen, [scale, top]: [f64; 2], wide: usize) -> Rgb {
    let mut picture = Rgb::filled(wide, TALL, BACK);
    let mut near = Image::filled(wide, TALL, f64::MIN);
    for (f, face) in body.faces.iter().enumerate() {
        let normal = body.area_vector(f);
        let faces = normal.dot(&side.eye) / normal.norm().max(1e-12);
        let color = SKIN.map(|s| (s * (0.3 + 0.7 * faces.abs())) as u8);
        let corners = face.map(|v| {
            let p = body.point(v).coords;
            let x = wide as f64 / 2.0 + p.dot(&side.right) * scale;
            [x, MARGIN as f64 + (top - p.z) * scale, p.dot(&side.eye)]
        });
        fill_triangle(corners, &mut near, &mut |x, y, _| {
            *picture.at_mut(x, y) = color;
        });
    }
    picture
}

/// The half of a tape that faces the eye, as a path, and its rightmost end. \[px\]
fn near_half(
    girth: &Girth,
    side: &Seen,
    place: &dyn Fn([f32; 3]) -> [f64; 2],
) -> (String, Option<[f64; 2]>) {
    let tape = tape::around(&girth.contour, girth.plane.normal);
    let middle = tape.iter().map(|p| Vector3::from(p.map(f64::from)));
    let middle = middle.sum::<Vector3<f64>>() / tape.len().max(1) as f64;
    let (mut path, mut end) = (String::new(), None::<[f64; 2]>);
    for (a, b) in tape.iter().zip(tape.iter().cycle().skip(1)) {
        let between = Vector3::from([0, 1, 2].map(|i| f64::from(a[i] + b[i]) / 2.0));
        if (between - middle).dot(&side.eye) < 0.0 {
            continue;
        }
        let [p, q] = [place(*a), place(*b)];
        let _ = write!(path, "M{:.1},{:.1}L{:.1},{:.1}", p[0], p[1], q[0], q[1]);
        for at in [p, q] {
            end = Some(end.filter(|e| e[0] >= at[0]).unwrap_or(at));
        }
    }
    (path, end)
}

/// The tapes' names and lengths in a column, each led to its tape's end.
fn names(svg: &mut String, mut ends: Vec<([f64; 2], &Girth)>, left: f64, lengths: Lengths) {
    ends.sort_by(|a, b| a.0[1].total_cmp(&b.0[1]));
    let wanted: Vec<f64> = ends.iter().map(|(end, _)| end[1]).collect();
    let within = [LINE, TALL as f64 - LINE];
    for ((end, girth), y) in ends.iter().zip(spread(&wanted, LINE, within)) {
        let _ = write!(
            svg,
            "<path class=\"lead\" d=\"M{:.1},{:.1}L{:.1},{y:.1}h8\"/><text x=\"{:.1}\" y=\"{:.1}\">{} {}</text>",
            end[0],
            end[1],
            left + 6.0,
            left + 18.0,
            y + 4.5,
            escaped(&girth.name),
            lengths.text(girth.tape_mm),
        );
    }
}
