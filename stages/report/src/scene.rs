//! What the viewer draws, as JSON: meshes, an atlas, tapes, where the cameras were.

use crate::lengths::Lengths;
use crate::packing::{corners, steps};
use crate::tape;
use base64::prelude::{BASE64_STANDARD, Engine as _};
use serde_json::{Value, json};
use shape::{Camera, Girths, Mesh, Rgb, Textured, rgb_to_jpeg};
use std::collections::BTreeMap;

/// Finest step of a coordinate (structural: precision of a file). \[mm\]
const STEP_MM: f32 = 0.1;

/// A mesh for the viewer, with the colours of its vertices if it has some; `exact` as [`packed`] has it.
pub(crate) fn mesh(label: &str, mesh: &Mesh, exact: bool) -> Value {
    let (bytes, order) = corners(&mesh.faces, mesh.positions.len());
    let mut value = packed(label, &mesh.positions, &bytes, &order, exact);
    if !mesh.colors.is_empty() {
        let colors = order
            .iter()
            .map(|v| mesh.colors[*v as usize].map(i32::from));
        value["colors"] = json!(BASE64_STANDARD.encode(steps(colors)));
    }
    value
}

/// A mesh with an atlas for the viewer: vertices are split where the atlas is cut; `exact` as [`packed`] has it.
pub(crate) fn textured(label: &str, body: &Textured, atlas_px: usize, exact: bool) -> Value {
    let mut known: BTreeMap<(u32, [i32; 2]), u32> = BTreeMap::new();
    let (mut split, mut places) = (Vec::new(), Vec::new());
    let mut faces = Vec::with_capacity(body.mesh.faces.len());
    for (face, uvs) in body.mesh.faces.iter().zip(&body.corners) {
        let at = [0, 1, 2].map(|i| {
            let uv = uvs[i].map(|x| (x.clamp(0.0, 1.0) * 65535.0).round() as i32);
            let at = *known.entry((face[i], uv)).or_insert(split.len() as u32);
            if at as usize == split.len() {
                split.push(body.mesh.positions[face[i] as usize]);
                places.push(uv);
            }
            at
        });
        faces.push(at);
    }
    let (bytes, order) = corners(&faces, split.len());
    let mut value = packed(label, &split, &bytes, &order, exact);
    let places = order.iter().map(|v| places[*v as usize]);
    let jpeg = rgb_to_jpeg(&halved(&body.atlas, atlas_px), 80);
    value["uv"] = json!(BASE64_STANDARD.encode(steps(places)));
    value["atlas"] = json!(format!(
        "data:image/jpeg;base64,{}",
        BASE64_STANDARD.encode(&jpeg)
    ));
    value
}

/// The image, halved until neither side is longer.
fn halved(image: &Rgb, most_px: usize) -> Rgb {
    let mut small = image.clone();
    while small.width.max(small.height) > most_px.max(1) {
        let (w, h) = (small.width.div_ceil(2), small.height.div_ceil(2));
        let at = |x: usize, y: usize| small.at(x.min(small.width - 1), y.min(small.height - 1));
        let mean = |x: usize, y: usize| {
            let four = [
                at(2 * x, 2 * y),
                at(2 * x + 1, 2 * y),
                at(2 * x, 2 * y + 1),
                at(2 * x + 1, 2 * y + 1),
            ];
            [0, 1, 2].map(|c| (four.iter().map(|p| u16::from(p[c])).sum::<u16>() / 4) as u8)
        };
        let data = (0..h).flat_map(|y| (0..w).map(move |x| (x, y)));
        let data = data.map(|(x, y)| mean(x, y)).collect();
        small = Rgb {
            width: w,
            height: h,
            data,
        };
    }
    small
}

/// The tapes: name, label, length, normal, the tape's points and the contour's, closed. \[mm\]
pub(crate) fn tapes(girths: &Girths, lengths: Lengths) -> Value {
    let flat = |points: &[[f32; 3]]| -> Vec<f64> {
        let rounded = |x: &f32| (f64::from(*x) * 10.0).round() / 10.0;
        points.as_flattened().iter().map(rounded).collect()
    };
    let tape = |g: &shape::Girth| {
        json!({
            "name": g.name, "label": g.label, "normal": g.plane.normal,
            "definition": g.definition, "text": format!("{} {}", lengths.text(g.tape_mm), lengths.word()),
            "tape": flat(&tape::around(&g.contour, g.plane.normal)), "contour": flat(&g.contour),
        })
    };
    girths.girths.iter().map(tape).collect()
}

/// How the page writes lengths: millimetres in one, digits, what they are in; and by how much a worn
/// tape is shorter.
pub(crate) fn written(girths: &Girths, lengths: Lengths) -> Value {
    let (mm, digits) = lengths.scale();
    let worn = 1.0 - girths.compression_pct / 100.0;
    json!({ "mm": mm, "digits": digits, "word": lengths.word(), "worn": worn })
}

/// Where each camera was; null for a photo without one. \[mm\]
pub(crate) fn views<'a>(cameras: impl Iterator<Item = Option<&'a Camera>>) -> Value {
    let centre = |c: &Camera| <[f64; 3]>::from(c.centre()).map(f64::round);
    cameras.map(|c| json!(c.map(centre))).collect()
}

/// Corners and places. Places are rounded to [`STEP_MM`], but for an `exact` surface: which points are near a picked plane, and
/// with them where the plane comes to rest, changes by millimetres where points are moved by 0.1 mm.
fn packed(label: &str, points: &[[f32; 3]], corners: &[u8], order: &[u32], exact: bool) -> Value {
    if exact {
        let bytes = order.iter().flat_map(|v| points[*v as usize]);
        let bytes: Vec<u8> = bytes.flat_map(f32::to_le_bytes).collect();
        return json!({
            "label": label, "exact": BASE64_STANDARD.encode(bytes), "corners": BASE64_STANDARD.encode(corners),
        });
    }
    let fold = |f: fn(f32, f32) -> f32, start: f32| {
        points.iter().fold([start; 3], |c, p| {
            [f(c[0], p[0]), f(c[1], p[1]), f(c[2], p[2])]
        })
    };
    let (lo, hi) = (fold(f32::min, f32::MAX), fold(f32::max, f32::MIN));
    let longest = (0..3).map(|i| hi[i] - lo[i]).fold(0.0, f32::max);
    let step = (longest / 65535.0).max(STEP_MM);
    let at = |v: &u32| {
        let p = points[*v as usize];
        [0, 1, 2].map(|i| ((p[i] - lo[i]) / step).round() as i32)
    };
    json!({
        "label": label, "step": step,
        "lo": if points.is_empty() { [0.0; 3] } else { lo },
        "at": BASE64_STANDARD.encode(steps(order.iter().map(at))), "corners": BASE64_STANDARD.encode(corners),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_atlas_is_halved_until_a_phone_can_hold_it() {
        let mut image = Rgb::filled(10, 6, [0; 3]);
        *image.at_mut(9, 5) = [200; 3];
        let small = halved(&image, 5);
        assert_eq!((small.width, small.height), (5, 3));
        assert_eq!(small.at(4, 2), [50; 3]);
        assert_eq!(halved(&image, 10), image);
    }
}
