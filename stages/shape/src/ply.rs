//! The one file that knows ply-rs: meshes to and from PLY, in millimetres.

use crate::{Mesh, Unit};
use ply_rs::parser::Parser;
use ply_rs::ply::{
    Addable, ElementDef, Encoding, Ply, PropertyAccess, PropertyAccessResult, PropertyDef,
    PropertyType, ScalarType,
};
use ply_rs::writer::Writer;
use std::io::Cursor;

/// A file that holds no mesh of ours.
#[derive(Debug, thiserror::Error)]
#[error("not a PLY mesh: {0}")]
pub struct PlyError(String);

/// A vertex or a face, whichever the header names.
#[derive(Debug, Default, Clone)]
struct Element {
    at: [f64; 3],
    color: [u8; 3],
    corners: Vec<i32>,
}

impl Element {
    fn set_number(&mut self, name: &str, value: f64) -> PropertyAccessResult {
        match ["x", "y", "z"].iter().position(|axis| *axis == name) {
            Some(i) => self.at[i] = value,
            None => return PropertyAccessResult::Ignored,
        }
        PropertyAccessResult::Set
    }
}

impl PropertyAccess for Element {
    fn new() -> Self {
        Self::default()
    }
    fn set_float(&mut self, name: &str, value: f32) -> PropertyAccessResult {
        self.set_number(name, f64::from(value))
    }
    fn set_double(&mut self, name: &str, value: f64) -> PropertyAccessResult {
        self.set_number(name, value)
    }
    fn set_uchar(&mut self, name: &str, value: u8) -> PropertyAccessResult {
        match ["red", "green", "blue"].iter().position(|c| *c == name) {
            Some(i) => self.color[i] = value,
            None => return PropertyAccessResult::Ignored,
        }
        PropertyAccessResult::Set
    }
    fn set_list_int(&mut self, name: &str, value: Vec<i32>) -> PropertyAccessResult {
        if !["vertex_indices", "vertex_index"].contains(&name) {
            return PropertyAccessResult::Ignored;
        }
        self.corners = value;
        PropertyAccessResult::Set
    }
    fn set_list_uint(&mut self, name: &str, value: Vec<u32>) -> PropertyAccessResult {
        self.set_list_int(name, value.into_iter().map(|v| v as i32).collect())
    }
    fn get_float(&self, name: &str) -> Option<f32> {
        let i = ["x", "y", "z"].iter().position(|axis| *axis == name)?;
        Some(self.at[i] as f32)
    }
    fn get_uchar(&self, name: &str) -> Option<u8> {
        let i = ["red", "green", "blue"].iter().position(|c| *c == name)?;
        Some(self.color[i])
    }
    fn get_list_int(&self, _: &str) -> Option<&[i32]> {
        Some(&self.corners)
    }
}

/// The comment of a file where nothing of known length was given.
const RELATIVE: &str = "unit relative: 1000 is the radius of the camera ring";

/// The mesh as a binary little-endian PLY file with a comment `unit mm`, or that lengths are relative.
pub fn mesh_to_ply(mesh: &Mesh) -> Vec<u8> {
    let mut ply = Ply::<Element>::new();
    ply.header.encoding = Encoding::BinaryLittleEndian;
    let unit = match mesh.unit {
        Unit::Metric => "unit mm",
        Unit::Relative => RELATIVE,
    };
    ply.header.comments.push(unit.into());
    let scalar = |name: &str, scalar| PropertyDef::new(name.into(), PropertyType::Scalar(scalar));
    let mut vertex = ElementDef::new("vertex".into());
    ["x", "y", "z"]
        .iter()
        .for_each(|n| vertex.properties.add(scalar(n, ScalarType::Float)));
    if !mesh.colors.is_empty() {
        let names = ["red", "green", "blue"];
        names
            .iter()
            .for_each(|n| vertex.properties.add(scalar(n, ScalarType::UChar)));
    }
    let mut face = ElementDef::new("face".into());
    let list = PropertyType::List(ScalarType::UChar, ScalarType::Int);
    face.properties
        .add(PropertyDef::new("vertex_indices".into(), list));
    ply.header.elements.add(vertex);
    ply.header.elements.add(face);
    let color = |i: usize| mesh.colors.get(i).copied().unwrap_or_default();
    let vertices = mesh.positions.iter().enumerate().map(|(i, p)| Element {
        at: p.map(f64::from),
        color: color(i),
        corners: vec![],
    });
    let faces = mesh.faces.iter().map(|f| Element {
        corners: f.iter().map(|v| *v as i32).collect(),
        ..Element::default()
    });
    ply.payload.insert("vertex".into(), vertices.collect());
    ply.payload.insert("face".into(), faces.collect());
    let mut bytes = Vec::new();
    Writer::new()
        .write_ply(&mut bytes, &mut ply)
        .expect("bug: a mesh that PLY cannot hold");
    bytes
}

/// A mesh from a PLY file. Polygons become fans of triangles. Lengths are millimetres unless a comment declares
/// them relative.
///
/// # Errors
///
/// The bytes are no PLY that holds a mesh, or the mesh is not sound.
pub fn mesh_from_ply(bytes: &[u8]) -> Result<Mesh, PlyError> {
    let error = |e: String| PlyError(e);
    let mut from = Cursor::new(bytes);
    let mut ply = Parser::<Element>::new()
        .read_ply(&mut from)
        // Its further lines are the parser's own state.
        .map_err(|e| error(e.to_string().lines().next().unwrap_or_default().to_owned()))?;
    let colored = ply
        .header
        .elements
        .get("vertex")
        .is_some_and(|v| v.properties.contains_key("red"));
    let mut take = |name: &str| {
        ply.payload
            .swap_remove(name)
            .ok_or_else(|| error(format!("it has no element `{name}`")))
    };
    let unit = match ply.header.comments.iter().any(|c| c.trim() == RELATIVE) {
        true => Unit::Relative,
        false => Unit::Metric,
    };
    let (vertices, polygons) = (take("vertex")?, take("face")?);
    let positions = vertices.iter().map(|v| v.at.map(|x| x as f32)).collect();
    let colors = if colored {
        vertices.iter().map(|v| v.color).collect()
    } else {
        vec![]
    };
    let mut mesh = Mesh {
        positions,
        faces: vec![],
        colors,
        unit,
    };
    for polygon in &polygons {
        for pair in polygon.corners.windows(2).skip(1) {
            mesh.faces
                .push([polygon.corners[0], pair[0], pair[1]].map(|v| v as u32));
        }
    }
    mesh.validate().map_err(|fault| error(fault.to_string()))?;
    Ok(mesh)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mesh_comes_back_from_its_file() {
        let positions = vec![
            [0.0; 3],
            [1.5, 0.0, 0.0],
            [0.0, 1.0, 0.25],
            [0.0, 0.0, -1.0],
        ];
        let faces = vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
        let mut mesh = Mesh {
            positions,
            faces,
            ..Mesh::default()
        };
        assert_eq!(mesh_from_ply(&mesh_to_ply(&mesh)).unwrap(), mesh);
        mesh.colors = vec![[1, 2, 3], [4, 5, 6], [255, 0, 9], [0, 0, 0]];
        assert_eq!(mesh_from_ply(&mesh_to_ply(&mesh)).unwrap(), mesh);
        mesh.unit = Unit::Relative;
        let file = mesh_to_ply(&mesh);
        assert!(!String::from_utf8_lossy(&file).contains("unit mm"));
        assert_eq!(mesh_from_ply(&file).unwrap(), mesh);
    }

    #[test]
    fn a_truncated_file_is_an_error() {
        let mesh = Mesh {
            positions: vec![[0.0; 3]; 3],
            faces: vec![[0, 1, 2]],
            ..Mesh::default()
        };
        let bytes = mesh_to_ply(&mesh);
        assert!((0..bytes.len()).all(|end| mesh_from_ply(&bytes[..end]).is_err()));
    }
}
