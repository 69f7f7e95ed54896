//! Meshes as binary STL, for printers and slicers. The format has no unit: the header names it.

use crate::write_error::WriteError;
use shape::{Mesh, Unit};

/// A mesh as binary STL, z up: millimetres where lengths are known; else the header calls them relative.
///
/// # Errors
///
/// More faces than the format can count.
pub fn mesh_to_stl(mesh: &Mesh) -> Result<Vec<u8>, WriteError> {
    let head = match mesh.unit {
        Unit::Metric => "tailor, unit mm, z up",
        Unit::Relative => "tailor, unit relative: 1000 is the radius of the camera ring, z up",
    };
    let mut bytes = vec![b' '; 80];
    bytes[..head.len()].copy_from_slice(head.as_bytes());
    bytes.extend(u32::try_from(mesh.faces.len())?.to_le_bytes());
    for (f, face) in mesh.faces.iter().enumerate() {
        let normal = mesh.area_vector(f);
        let unit = normal.try_normalize(0.0).unwrap_or_default();
        let normal: [f32; 3] = unit.map(|x| x as f32).into();
        let corners = face.map(|v| mesh.positions[v as usize]);
        for x in [normal, corners[0], corners[1], corners[2]]
            .iter()
            .flatten()
        {
            bytes.extend(x.to_le_bytes());
        }
        bytes.extend([0, 0]);
    }
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_triangle_has_fifty_bytes_its_normal_first() {
        let mesh = Mesh {
            positions: vec![[0.0; 3], [2.0, 0.0, 0.0], [0.0, 3.0, 0.0]],
            faces: vec![[0, 1, 2]],
            ..Mesh::default()
        };
        let stl = mesh_to_stl(&mesh).unwrap();
        assert_eq!(stl.len(), 84 + 50);
        // Readers take a file that begins so for text.
        assert!(!stl.starts_with(b"solid") && stl[..80].windows(7).any(|w| w == b"unit mm"));
        let number = |at: usize| f32::from_le_bytes(stl[at..at + 4].try_into().unwrap());
        assert_eq!([number(84), number(88), number(92)], [0.0, 0.0, 1.0]);
        assert_eq!([number(108), number(124)], [2.0, 3.0]);
        let relative = Mesh {
            unit: Unit::Relative,
            ..mesh
        };
        let head = mesh_to_stl(&relative).unwrap()[..80].to_vec();
        let head = String::from_utf8(head).unwrap();
        assert!(
            head.contains("unit relative") && !head.contains("mm"),
            "{head}"
        );
    }
}
