//! What the viewer draws, as JSON: meshes with 16-bit positions, an atlas, tapes.

use crate::base64::base64;
use serde_json::{Value, json};
use shape::{Girths, Mesh, Textured, rgb_to_jpeg};
use std::collections::BTreeMap;

/// A mesh for the viewer.
pub(crate) fn mesh(label: &str, mesh: &Mesh) -> Value {
    json!({
        "label": label,
        "positions": positions(&mesh.positions),
        "indices": indices(mesh.faces.iter().flatten().copied()),
        "count": mesh.faces.len() * 3,
    })
}

/// A mesh with an atlas for the viewer: vertices are split where the atlas is cut.
pub(crate) fn textured(label: &str, body: &Textured) -> Value {
    let mut known: BTreeMap<(u32, [u16; 2]), u32> = BTreeMap::new();
    let (mut split, mut places, mut corners) = (Vec::new(), Vec::new(), Vec::new());
    for (face, uvs) in body.mesh.faces.iter().zip(&body.corners) {
        for (v, uv) in face.iter().zip(uvs) {
            let uv = uv.map(|x| (x.clamp(0.0, 1.0) * 65535.0).round() as u16);
            let at = *known.entry((*v, uv)).or_insert(split.len() as u32);
            if at as usize == split.len() {
                split.push(body.mesh.positions[*v as usize]);
                places.extend(uv);
            }
            corners.push(at);
        }
    }
    let bytes: Vec<u8> = places.iter().flat_map(|x| x.to_le_bytes()).collect();
    json!({
        "label": label,
        "positions": positions(&split),
        "uv": base64(&bytes),
        "indices": indices(corners.iter().copied()),
        "count": corners.len(),
        "atlas": format!("data:image/jpeg;base64,{}", base64(&rgb_to_jpeg(&body.atlas, 85))),
    })
}

/// The tapes: name, label and closed polylines. \[mm\]
pub(crate) fn tapes(girths: &Girths) -> Value {
    let rounded = |p: &[f32; 3]| p.map(|x| (f64::from(x) * 10.0).round() / 10.0);
    let tape = |g: &shape::Girth| {
        json!({
            "name": g.name, "label": g.label,
            "points": g.contour.iter().map(rounded).collect::<Vec<_>>(),
        })
    };
    girths.girths.iter().map(tape).collect()
}

/// Positions as 16-bit steps of their bounding cube.
fn positions(points: &[[f32; 3]]) -> Value {
    let fold = |f: fn(f32, f32) -> f32, start: f32| {
        points.iter().fold([start; 3], |c, p| {
            [f(c[0], p[0]), f(c[1], p[1]), f(c[2], p[2])]
        })
    };
    let (lo, hi) = (fold(f32::min, f32::MAX), fold(f32::max, f32::MIN));
    let step = (0..3).map(|i| hi[i] - lo[i]).fold(1e-3, f32::max) / 65535.0;
    let mut bytes = Vec::with_capacity(points.len() * 6);
    for p in points {
        (0..3).for_each(|i| {
            bytes.extend((((p[i] - lo[i]) / step).round() as u16).to_le_bytes());
        });
    }
    json!({ "lo": if points.is_empty() { [0.0; 3] } else { lo }, "step": step, "data": base64(&bytes) })
}

fn indices(corners: impl Iterator<Item = u32>) -> String {
    base64(&corners.flat_map(u32::to_le_bytes).collect::<Vec<u8>>())
}
