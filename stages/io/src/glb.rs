//! Meshes as GLB (glTF 2.0 binary), in metres, y up, as the format wants; the asset names it where lengths are relative.

use serde_json::{Value, json};
use shape::{Mesh, Textured, Unit, rgb_to_jpeg};
use std::collections::BTreeMap;

/// World millimetres (z up) to glTF metres (y up).
fn place([x, y, z]: [f32; 3]) -> [f32; 3] {
    [x / 1000.0, z / 1000.0, -y / 1000.0]
}

/// The parts of a binary buffer, each at a multiple of four bytes.
#[derive(Default)]
struct Buffer {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl Buffer {
    fn view(&mut self, bytes: &[u8], target: Option<u32>) -> usize {
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let mut view =
            json!({ "buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len() });
        if let Some(target) = target {
            view["target"] = json!(target);
        }
        self.bytes.extend_from_slice(bytes);
        self.views.push(view);
        self.views.len() - 1
    }

    fn accessor(&mut self, mut accessor: Value, view: usize) -> usize {
        accessor["bufferView"] = json!(view);
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }

    fn positions(&mut self, points: &[[f32; 3]]) -> usize {
        let points: Vec<[f32; 3]> = points.iter().map(|p| place(*p)).collect();
        let fold = |f: fn(f32, f32) -> f32, start: f32| {
            points.iter().fold([start; 3], |c, p| {
                [f(c[0], p[0]), f(c[1], p[1]), f(c[2], p[2])]
            })
        };
        let (lo, hi) = (fold(f32::min, f32::MAX), fold(f32::max, f32::MIN));
        let view = self.view(bytemuck::cast_slice(&points), Some(34962));
        let accessor = json!({
            "componentType": 5126, "count": points.len(), "type": "VEC3", "min": lo, "max": hi,
        });
        self.accessor(accessor, view)
    }

    fn indices(&mut self, indices: &[u32]) -> usize {
        let view = self.view(bytemuck::cast_slice(indices), Some(34963));
        let accessor = json!({ "componentType": 5125, "count": indices.len(), "type": "SCALAR" });
        self.accessor(accessor, view)
    }
}

/// A mesh without colours, or with those of its vertices.
pub fn mesh_to_glb(mesh: &Mesh) -> Vec<u8> {
    let mut buffer = Buffer::default();
    let mut attributes = json!({ "POSITION": buffer.positions(&mesh.positions) });
    if !mesh.colors.is_empty() {
        let colors: Vec<[u8; 4]> = mesh
            .colors
            .iter()
            .map(|[r, g, b]| [*r, *g, *b, 255])
            .collect();
        let view = buffer.view(bytemuck::cast_slice(&colors), Some(34962));
        let accessor = json!({ "componentType": 5121, "normalized": true, "count": colors.len(), "type": "VEC4" });
        attributes["COLOR_0"] = json!(buffer.accessor(accessor, view));
    }
    let indices = buffer.indices(bytemuck::cast_slice(&mesh.faces));
    let primitive = json!({ "attributes": attributes, "indices": indices, "material": 0 });
    let material =
        json!({ "pbrMetallicRoughness": { "metallicFactor": 0.0, "roughnessFactor": 1.0 } });
    glb(
        buffer,
        mesh.unit,
        primitive,
        json!({ "materials": [material] }),
    )
}

/// A mesh with its atlas. Vertices are split where the atlas is cut.
pub fn textured_to_glb(body: &Textured) -> Vec<u8> {
    let mut known: BTreeMap<(u32, [u32; 2]), u32> = BTreeMap::new();
    let (mut positions, mut places, mut indices) = (Vec::new(), Vec::new(), Vec::new());
    for (face, uvs) in body.mesh.faces.iter().zip(&body.corners) {
        for (v, uv) in face.iter().zip(uvs) {
            let at = *known
                .entry((*v, uv.map(f32::to_bits)))
                .or_insert(positions.len() as u32);
            if at as usize == positions.len() {
                positions.push(body.mesh.positions[*v as usize]);
                places.push(*uv);
            }
            indices.push(at);
        }
    }
    let mut buffer = Buffer::default();
    let at = buffer.positions(&positions);
    let view = buffer.view(bytemuck::cast_slice(&places), Some(34962));
    let accessor = json!({ "componentType": 5126, "count": places.len(), "type": "VEC2" });
    let uv = buffer.accessor(accessor, view);
    let indices = buffer.indices(&indices);
    let image = buffer.view(&rgb_to_jpeg(&body.atlas, 90), None);
    let primitive = json!({ "attributes": { "POSITION": at, "TEXCOORD_0": uv }, "indices": indices, "material": 0 });
    let rest = json!({
        "materials": [{ "pbrMetallicRoughness": {
            "baseColorTexture": { "index": 0 }, "metallicFactor": 0.0, "roughnessFactor": 1.0,
        } }],
        "textures": [{ "source": 0, "sampler": 0 }],
        "samplers": [{ "magFilter": 9729, "minFilter": 9987, "wrapS": 33071, "wrapT": 33071 }],
        "images": [{ "bufferView": image, "mimeType": "image/jpeg" }],
    });
    glb(buffer, body.mesh.unit, primitive, rest)
}

/// Header, JSON chunk, binary chunk.
fn glb(mut buffer: Buffer, unit: Unit, primitive: Value, rest: Value) -> Vec<u8> {
    buffer
        .bytes
        .resize(buffer.bytes.len().next_multiple_of(4), 0);
    let mut asset = json!({ "version": "2.0", "generator": "tailor" });
    if unit == Unit::Relative {
        asset["extras"] = json!({ "unit": "relative: 1 is the radius of the camera ring" });
    }
    let mut file = json!({
        "asset": asset,
        "scene": 0, "scenes": [{ "nodes": [0] }], "nodes": [{ "mesh": 0, "name": "body" }],
        "meshes": [{ "primitives": [primitive] }],
        "buffers": [{ "byteLength": buffer.bytes.len() }],
        "bufferViews": buffer.views, "accessors": buffer.accessors,
    });
    for (key, value) in rest.as_object().expect("bug: rest is a table") {
        file[key] = value.clone();
    }
    let mut text = file.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let mut glb = Vec::new();
    let total = 12 + 8 + text.len() + 8 + buffer.bytes.len();
    glb.extend_from_slice(b"glTF");
    [2u32, total as u32]
        .iter()
        .for_each(|n| glb.extend(n.to_le_bytes()));
    for (chunk, kind) in [(&text, b"JSON"), (&buffer.bytes, b"BIN\0")] {
        glb.extend((chunk.len() as u32).to_le_bytes());
        glb.extend_from_slice(kind);
        glb.extend_from_slice(chunk);
    }
    glb
}
