//! Surfaces of unknown scale as files: what they say of their unit.

/// What PLY and OBJ say where lengths are known.
const KNOWN: &str = "unit mm";

/// What they say where nothing of known length was given.
const UNKNOWN: &str = "unit relative: 1000 is the radius of the camera ring";

/// The file of a surface (PLY, OBJ) whose lengths are relative: its first lines say so. Other files stay as
/// they are.
pub(crate) fn marked(file: Vec<u8>) -> Vec<u8> {
    let head = &file[..file.len().min(200)];
    let text = head.starts_with(b"ply") || head.starts_with(b"#");
    let at = head
        .windows(KNOWN.len())
        .position(|w| w == KNOWN.as_bytes());
    match at.filter(|_| text) {
        None => file,
        Some(at) => {
            let (before, after) = (&file[..at], &file[at + KNOWN.len()..]);
            [before, UNKNOWN.as_bytes(), after].concat()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_surface_of_unknown_scale_names_no_millimetres_and_is_read_as_before() {
        let (positions, faces) = proof::block([500.0; 3]);
        let mesh = shape::Mesh {
            positions,
            faces,
            colors: vec![],
        };
        let ply = marked(shape::mesh_to_ply(&mesh));
        assert!(String::from_utf8_lossy(&ply).contains("comment unit relative"));
        let back = shape::mesh_from_ply(&ply).unwrap();
        assert_eq!(back.positions, mesh.positions);
        let obj = io::mesh_to_obj(&mesh).remove(0).1;
        assert!(marked(obj).starts_with(b"# unit relative"));
        let glb = io::mesh_to_glb(&mesh);
        assert_eq!(marked(glb.clone()), glb);
    }
}
