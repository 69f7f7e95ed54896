//! Surfaces from GLB (glTF 2.0 binary): triangles of the scene's meshes, placed by their nodes.
//!
//! Section numbers are those of the glTF 2.0 specification.

use super::given::MOST_FACES;
use serde_json::Value;
use shape::Mesh;

/// A node's matrix, by columns as the format has them (5.25).
type Matrix = [[f32; 4]; 4];

/// A file: its JSON, and its bytes.
struct File<'a> {
    json: Value,
    bytes: &'a [u8],
}

/// Reads the triangles of a file's scene, in its numbers: metres with y up, if its writer kept to the format.
///
/// # Errors
///
/// What is wrong with the file, in words.
pub(super) fn read(bytes: &[u8]) -> Result<Mesh, String> {
    let file = chunks(bytes)?;
    let scene = file.json["scene"].as_u64().unwrap_or(0);
    let scene = at(&file.json["scenes"], scene).ok_or("it has no scene")?;
    let count = file.json["nodes"].as_array().map_or(0, Vec::len);
    let mut seen = vec![false; count];
    let mut mesh = Mesh::default();
    let mut open: Vec<(u64, Matrix)> = list(&scene["nodes"]).map(|n| (n, IDENTITY)).collect();
    while let Some((node, above)) = open.pop() {
        let missing = || format!("node {node} is not there");
        let own = at(&file.json["nodes"], node).ok_or_else(missing)?;
        let seen = &mut seen[usize::try_from(node).map_err(|_| missing())?];
        if std::mem::replace(seen, true) {
            return Err("a node has two parents: nodes must be a tree".into());
        }
        let place = product(&above, &matrix(own));
        if let Some(m) = own["mesh"].as_u64() {
            let parts = at(&file.json["meshes"], m).ok_or("a mesh is not there")?;
            for part in parts["primitives"].as_array().into_iter().flatten() {
                file.add(&mut mesh, part, &place)?;
            }
        }
        open.extend(list(&own["children"]).map(|child| (child, place)));
    }
    Ok(mesh)
}

/// The two chunks of a file (4.4).
fn chunks(bytes: &[u8]) -> Result<File<'_>, String> {
    let short = || "it is cut short, or no GLB of version 2".to_owned();
    if bytes.get(..8) != Some(b"glTF\x02\0\0\0") {
        return Err(short());
    }
    let chunk = |from: usize| {
        let size: [u8; 4] = bytes.get(from..from + 4)?.try_into().ok()?;
        let end = (from + 8).checked_add(u32::from_le_bytes(size) as usize)?;
        Some((bytes.get(from + 8..end)?, end))
    };
    let (text, end) = chunk(12).ok_or_else(short)?;
    let json = serde_json::from_slice(text).map_err(|e| e.to_string())?;
    // A file may name bytes that it lacks.
    let binary = if end == bytes.len() {
        &[][..]
    } else {
        chunk(end).ok_or_else(short)?.0
    };
    Ok(File {
        json,
        bytes: binary,
    })
}

fn at(list: &Value, number: u64) -> Option<&Value> {
    list.get(usize::try_from(number).ok()?)
}

fn list(numbers: &Value) -> impl Iterator<Item = u64> {
    numbers
        .as_array()
        .into_iter()
        .flatten()
        .filter_map(Value::as_u64)
}

fn numbers<const N: usize>(list: &Value) -> Option<[f32; N]> {
    let numbers = list.as_array()?.iter().filter_map(Value::as_f64);
    numbers
        .map(|n| n as f32)
        .collect::<Vec<f32>>()
        .try_into()
        .ok()
}

const IDENTITY: Matrix = [
    [1.0, 0.0, 0.0, 0.0],
    [0.0, 1.0, 0.0, 0.0],
    [0.0, 0.0, 1.0, 0.0],
    [0.0, 0.0, 0.0, 1.0],
];

/// A node's own place: its matrix, or shift, turn (a unit quaternion x y z w) and scale (3.5.3).
fn matrix(node: &Value) -> Matrix {
    if let Some(m) = numbers::<16>(&node["matrix"]) {
        return std::array::from_fn(|c| std::array::from_fn(|r| m[4 * c + r]));
    }
    let [x, y, z, w] = numbers(&node["rotation"]).unwrap_or([0.0, 0.0, 0.0, 1.0]);
    let scale: [f32; 3] = numbers(&node["scale"]).unwrap_or([1.0; 3]);
    let [a, b, c] = numbers(&node["translation"]).unwrap_or([0.0; 3]);
    let turn = [
        [
            1.0 - 2.0 * (y * y + z * z),
            2.0 * (x * y + w * z),
            2.0 * (x * z - w * y),
        ],
        [
            2.0 * (x * y - w * z),
            1.0 - 2.0 * (x * x + z * z),
            2.0 * (y * z + w * x),
        ],
        [
            2.0 * (x * z + w * y),
            2.0 * (y * z - w * x),
            1.0 - 2.0 * (x * x + y * y),
        ],
    ];
    let [i, j, k] = std::array::from_fn(|n| turn[n].map(|v| v * scale[n]));
    let column = |[x, y, z]: [f32; 3]| [x, y, z, 0.0];
    [column(i), column(j), column(k), [a, b, c, 1.0]]
}

fn product(a: &Matrix, b: &Matrix) -> Matrix {
    std::array::from_fn(|c| std::array::from_fn(|r| (0..4).map(|k| a[k][r] * b[c][k]).sum()))
}

impl File<'_> {
    /// Adds the triangles of one part; points and lines have none.
    fn add(&self, mesh: &mut Mesh, part: &Value, place: &Matrix) -> Result<(), String> {
        let mode = part["mode"].as_u64().unwrap_or(4);
        if !(4..=6).contains(&mode) {
            return Ok(());
        }
        let points = part["attributes"]["POSITION"]
            .as_u64()
            .ok_or("a part has no points")?;
        let points = self.items(points, "VEC3", &[5126])?;
        let first = mesh.positions.len() as u32;
        for point in &points {
            let [x, y, z] = std::array::from_fn(|k| f32::from_le_bytes(word(&point[4 * k..])));
            let put = |r: usize| place[0][r] * x + place[1][r] * y + place[2][r] * z + place[3][r];
            mesh.positions.push(std::array::from_fn(put));
        }
        let indices: Vec<u32> = match part["indices"].as_u64() {
            None => (0..points.len() as u32).collect(),
            Some(indices) => {
                let items = self.items(indices, "SCALAR", &[5121, 5123, 5125])?;
                items.iter().map(|i| u32::from_le_bytes(word(i))).collect()
            }
        };
        if mesh.faces.len() + indices.len() / 3 > MOST_FACES {
            return Err(format!(
                "it has more than {} million faces",
                MOST_FACES / 1_000_000
            ));
        }
        if indices.iter().any(|i| *i as usize >= points.len()) {
            return Err("a face names a point that is not there".into());
        }
        let face = |corners: [usize; 3]| corners.map(|i| first + indices[i]);
        let count = indices.len();
        match mode {
            4 => mesh
                .faces
                .extend((0..count / 3).map(|i| face([3 * i, 3 * i + 1, 3 * i + 2]))),
            // A strip turns every second triangle round.
            5 => mesh.faces.extend(
                (0..count.saturating_sub(2)).map(|i| face([i, i + 1 + i % 2, i + 2 - i % 2])),
            ),
            _ => mesh
                .faces
                .extend((1..count.saturating_sub(1)).map(|i| face([0, i, i + 1]))),
        }
        Ok(())
    }

    /// The items of an accessor (3.6.2) of this type and one of these kinds of numbers, each as its bytes.
    fn items(&self, accessor: u64, wanted: &str, kinds: &[u64]) -> Result<Vec<&[u8]>, String> {
        let accessor = at(&self.json["accessors"], accessor).ok_or("an accessor is not there")?;
        let kind = accessor["componentType"].as_u64().unwrap_or(0);
        if accessor["type"] != wanted || !kinds.contains(&kind) {
            return Err("numbers of a part are not of the type that the format has".into());
        }
        let missing = "its numbers are not in the file itself: save it as one GLB, not compressed";
        let view = accessor["bufferView"]
            .as_u64()
            .and_then(|v| at(&self.json["bufferViews"], v));
        let view = view
            .filter(|_| accessor["sparse"].is_null())
            .ok_or(missing)?;
        let whole = |value: &Value| value.as_u64().and_then(|n| usize::try_from(n).ok());
        let own = view["buffer"].as_u64() == Some(0) && self.json["buffers"][0]["uri"].is_null();
        let from = whole(&view["byteOffset"]).unwrap_or(0);
        let end = whole(&view["byteLength"]).and_then(|n| n.checked_add(from));
        let bytes = end
            .filter(|_| own)
            .and_then(|end| self.bytes.get(from..end))
            .ok_or(missing)?;
        let size = match kind {
            5121 => 1,
            5123 => 2,
            _ => 4,
        } * if wanted == "VEC3" { 3 } else { 1 };
        let step = whole(&view["byteStride"]).unwrap_or(size).max(1);
        let count = whole(&accessor["count"]).unwrap_or(0);
        let start = whole(&accessor["byteOffset"]).unwrap_or(0);
        if count > bytes.len() {
            return Err("it is cut short: numbers are missing".into());
        }
        let item = |i: usize| {
            let from = i.checked_mul(step)?.checked_add(start)?;
            bytes.get(from..from.checked_add(size)?)
        };
        let items: Option<Vec<&[u8]>> = (0..count).map(item).collect();
        items.ok_or_else(|| "it is cut short: numbers are missing".into())
    }
}

/// The first four bytes, or fewer with noughts after them.
fn word(bytes: &[u8]) -> [u8; 4] {
    std::array::from_fn(|k| bytes.get(k).copied().unwrap_or(0))
}
