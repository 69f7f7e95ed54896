//! Surfaces as scanners and programs write them: PLY, OBJ, STL, OFF, GLB, 3MF; triangles and their corners alone.

use super::given::{Read, Unit};
use super::{glb, three_mf};
use shape::{Mesh, mesh_from_ply};
use std::collections::BTreeMap;

/// Endings of files that are read as a surface.
pub const SCANS: [&str; 6] = ["ply", "obj", "stl", "off", "glb", "3mf"];

/// Whether a file of this name is read as a surface.
pub fn is_scan(name: &str) -> bool {
    ending(name).is_some()
}

pub(super) fn ending(name: &str) -> Option<&'static str> {
    let (_, own) = name.rsplit_once('.')?;
    SCANS.into_iter().find(|e| own.eq_ignore_ascii_case(e))
}

/// Reads a surface by the ending of its name; polygons become fans of triangles.
///
/// # Errors
///
/// What is wrong with the file, in words.
pub(crate) fn read(name: &str, bytes: &[u8]) -> Result<Read, String> {
    let plain = |mesh| Read { mesh, unit: None };
    let read = match ending(name) {
        Some("obj") => plain(obj(text(bytes)?)?),
        Some("off") => plain(off(text(bytes)?)?),
        Some("stl") => plain(stl(bytes)?),
        // The format knows metres alone.
        Some("glb") => Read {
            mesh: glb::read(bytes)?,
            unit: Some(Unit::M),
        },
        Some("3mf") => three_mf::read(bytes)?,
        _ => plain(mesh_from_ply(bytes).map_err(|e| e.to_string())?),
    };
    // Our own surfaces are PLY, and closed as they are.
    let mesh = match ending(name) == Some("ply") && read.mesh.validate_closed().is_ok() {
        true => read.mesh,
        false => welded(&read.mesh),
    };
    mesh.validate().map_err(|fault| fault.to_string())?;
    Ok(Read { mesh, ..read })
}

fn text(bytes: &[u8]) -> Result<&str, String> {
    std::str::from_utf8(bytes).map_err(|_| "no text".to_owned())
}

/// A number in a line.
fn number<T: std::str::FromStr>(word: Option<&str>, line: usize) -> Result<T, String> {
    let number = word.and_then(|w| w.parse().ok());
    number.ok_or_else(|| format!("line {line}: a number is missing"))
}

/// A polygon as triangles.
fn fan(mesh: &mut Mesh, corners: &[u32]) {
    for pair in corners.windows(2).skip(1) {
        mesh.faces.push([corners[0], pair[0], pair[1]]);
    }
}

/// Wavefront OBJ: its lines `v` and `f`.
fn obj(text: &str) -> Result<Mesh, String> {
    let mut mesh = Mesh::default();
    for (i, line) in text.lines().enumerate() {
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => {
                let mut one = || number(words.next(), i + 1);
                mesh.positions.push([one()?, one()?, one()?]);
            }
            Some("f") => {
                let there = mesh.positions.len() as i64;
                // 1 is the first vertex, -1 the last so far; what follows a slash is no corner.
                let corner = |word: &str| {
                    let k: i64 = number(word.split('/').next(), i + 1)?;
                    let k = if k < 0 { there + k } else { k - 1 };
                    u32::try_from(k).map_err(|_| format!("line {}: no such vertex", i + 1))
                };
                let corners: Result<Vec<u32>, String> = words.map(corner).collect();
                fan(&mut mesh, &corners?);
            }
            _ => {}
        }
    }
    Ok(mesh)
}

/// Object File Format (Geomview): counts, vertices, faces.
fn off(text: &str) -> Result<Mesh, String> {
    let plain = |(i, line): (usize, &str)| {
        let words = line.split('#').next().unwrap_or("").trim().to_owned();
        (!words.is_empty()).then_some((i + 1, words))
    };
    let mut lines = text.lines().enumerate().filter_map(plain);
    let end = || "it ends too early".to_owned();
    let (at, head) = lines.next().ok_or_else(end)?;
    let rest = head
        .strip_prefix("OFF")
        .ok_or("its first word is not OFF")?;
    let (at, counts) = match rest.trim() {
        "" => lines.next().ok_or_else(end)?,
        counts => (at, counts.to_owned()),
    };
    let mut words = counts.split_whitespace();
    let count = [
        number(words.next(), at)?,
        number::<usize>(words.next(), at)?,
    ];
    let mut mesh = Mesh::default();
    for _ in 0..count[0] {
        let (at, line) = lines.next().ok_or_else(end)?;
        let mut words = line.split_whitespace();
        let mut one = || number(words.next(), at);
        mesh.positions.push([one()?, one()?, one()?]);
    }
    for _ in 0..count[1] {
        let (at, line) = lines.next().ok_or_else(end)?;
        let mut words = line.split_whitespace();
        let n: usize = number(words.next(), at)?;
        let corners = words.take(n).map(|w| number(Some(w), at));
        let corners: Vec<u32> = corners.collect::<Result<_, _>>()?;
        if corners.len() < n {
            return Err(format!(
                "line {at}: a face has fewer corners than its count"
            ));
        }
        fan(&mut mesh, &corners);
    }
    Ok(mesh)
}

/// STL: in binary, 50 bytes a triangle after 84; else the lines `vertex` of a text.
fn stl(bytes: &[u8]) -> Result<Mesh, String> {
    let mut mesh = Mesh::default();
    let count = bytes.get(80..84).and_then(|b| b.try_into().ok());
    let count = count.map(|b| u32::from_le_bytes(b) as usize);
    let binary = count.filter(|n| n.checked_mul(50).is_some_and(|n| n + 84 == bytes.len()));
    if binary.is_some() {
        for triangle in bytes[84..].chunks_exact(50) {
            for corner in triangle[12..48].chunks_exact(12) {
                let axis = |k: usize| corner[4 * k..4 * k + 4].try_into();
                let axis = |k: usize| f32::from_le_bytes(axis(k).unwrap_or_default());
                mesh.positions.push([axis(0), axis(1), axis(2)]);
            }
        }
    } else {
        let text = text(bytes).map_err(|_| "it is cut short, or no STL".to_owned())?;
        if !text.trim_start().starts_with("solid") {
            return Err("it is cut short, or no STL".into());
        }
        for (i, line) in text.lines().enumerate() {
            let mut words = line.split_whitespace();
            if words.next() == Some("vertex") {
                let mut one = || number(words.next(), i + 1);
                mesh.positions.push([one()?, one()?, one()?]);
            }
        }
    }
    if mesh.positions.len() % 3 != 0 {
        return Err("a triangle lacks a corner".into());
    }
    let faces = 0..mesh.positions.len() as u32 / 3;
    mesh.faces = faces.map(|f| [3 * f, 3 * f + 1, 3 * f + 2]).collect();
    Ok(mesh)
}

/// With vertices in the same place as one, and without faces that become lines by that. A mesh whose faces name
/// vertices that are not there stays as it is.
fn welded(mesh: &Mesh) -> Mesh {
    let mut names: BTreeMap<[u32; 3], u32> = BTreeMap::new();
    let mut welded = Mesh {
        unit: mesh.unit,
        ..Mesh::default()
    };
    let mut name = Vec::with_capacity(mesh.positions.len());
    for (v, p) in mesh.positions.iter().enumerate() {
        // Nought is nought, whatever its sign.
        let key = p.map(|x| (x + 0.0).to_bits());
        let next = welded.positions.len() as u32;
        let own = *names.entry(key).or_insert(next);
        if own == next {
            welded.positions.push(*p);
            welded.colors.extend(mesh.colors.get(v));
        }
        name.push(own);
    }
    let renamed = |f: &[u32; 3]| f.iter().map(|v| name.get(*v as usize).copied()).collect();
    for face in &mesh.faces {
        let Some::<Vec<u32>>(f) = renamed(face) else {
            return mesh.clone();
        };
        if f[0] != f[1] && f[1] != f[2] && f[2] != f[0] {
            welded.faces.push([f[0], f[1], f[2]]);
        }
    }
    welded
}

#[cfg(test)]
#[path = "file_tests.rs"]
mod tests;
