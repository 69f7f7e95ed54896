//! Meshes as OBJ with MTL, for programs that read no GLB: in millimetres or relative, z up, as inside.

use shape::{Mesh, Textured, Unit, rgb_to_jpeg};
use std::collections::BTreeMap;
use std::fmt::Write;

/// Names and bytes of the files: `body.obj`, `body.mtl`, and `body.jpg` where there is an atlas.
type Files = Vec<(String, Vec<u8>)>;

/// A mesh without an atlas, with the colours of its vertices if it has some (behind the
/// coordinates, 0..=1, as MeshLab and Blender read them).
pub fn mesh_to_obj(mesh: &Mesh) -> Files {
    let mut obj = head(mesh);
    for face in &mesh.faces {
        let [a, b, c] = face.map(|v| v + 1);
        let _ = writeln!(obj, "f {a} {b} {c}");
    }
    files(obj, "newmtl body\nKd 0.80 0.74 0.68\nKs 0 0 0\nillum 1\n")
}

/// A mesh with its atlas.
pub fn textured_to_obj(body: &Textured) -> Files {
    let mut obj = head(&body.mesh);
    let mut known: BTreeMap<[u32; 2], usize> = BTreeMap::new();
    let mut faces = String::new();
    for (face, corners) in body.mesh.faces.iter().zip(&body.corners) {
        faces.push('f');
        for (v, uv) in face.iter().zip(corners) {
            let next = known.len() + 1;
            let at = *known.entry(uv.map(f32::to_bits)).or_insert(next);
            if at == next {
                // OBJ counts from the lower left corner.
                let _ = writeln!(obj, "vt {} {}", uv[0], 1.0 - uv[1]);
            }
            let _ = write!(faces, " {}/{at}", v + 1);
        }
        faces.push('\n');
    }
    let mtl = "newmtl body\nKd 1 1 1\nKs 0 0 0\nillum 1\nmap_Kd body.jpg\n";
    let mut files = files(obj + &faces, mtl);
    files.push(("body.jpg".into(), rgb_to_jpeg(&body.atlas, 90)));
    files
}

fn head(mesh: &Mesh) -> String {
    let unit = match mesh.unit {
        Unit::Metric => "mm",
        Unit::Relative => "relative: 1000 is the radius of the camera ring",
    };
    let mut obj = format!("# unit {unit}, z up\nmtllib body.mtl\no body\nusemtl body\n");
    for (v, [x, y, z]) in mesh.positions.iter().enumerate() {
        let _ = write!(obj, "v {x} {y} {z}");
        if let Some(color) = mesh.colors.get(v) {
            let [r, g, b] = color.map(|c| f32::from(c) / 255.0);
            let _ = write!(obj, " {r:.4} {g:.4} {b:.4}");
        }
        obj.push('\n');
    }
    obj
}

fn files(obj: String, mtl: &str) -> Files {
    vec![
        ("body.obj".into(), obj.into_bytes()),
        ("body.mtl".into(), mtl.into()),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use shape::Rgb;

    fn square() -> Mesh {
        Mesh {
            positions: vec![[0.0; 3], [1.5, 0.0, 0.0], [1.5, 2.0, 0.0], [0.0, 2.0, 0.25]],
            faces: vec![[0, 1, 2], [0, 2, 3]],
            colors: vec![[255, 0, 51]; 4],
            ..Mesh::default()
        }
    }

    /// The lines of the OBJ that begin with a word, without it.
    fn lines(files: &Files, word: &str) -> Vec<String> {
        let text = String::from_utf8(files[0].1.clone()).unwrap();
        let rest = |l: &str| l.strip_prefix(&format!("{word} ")).map(str::to_owned);
        text.lines().filter_map(rest).collect()
    }

    #[test]
    fn a_plain_mesh_keeps_points_faces_and_colours() {
        let files = mesh_to_obj(&square());
        assert_eq!(lines(&files, "v")[3], "0 2 0.25 1.0000 0.0000 0.2000");
        assert_eq!(lines(&files, "f"), ["1 2 3", "1 3 4"]);
        assert_eq!(lines(&files, "mtllib"), [files[1].0.clone()]);
    }

    #[test]
    fn a_textured_mesh_names_its_atlas_and_shares_what_is_equal() {
        let at = [[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.25]];
        let body = Textured {
            corners: vec![[at[0], at[1], at[2]], [at[0], at[2], at[3]]],
            mesh: square(),
            atlas: Rgb::filled(4, 4, [9; 3]),
        };
        let files = textured_to_obj(&body);
        assert_eq!(lines(&files, "vt"), ["0 0", "1 0", "1 1", "0 0.75"]);
        assert_eq!(lines(&files, "f"), ["1/1 2/2 3/3", "1/1 3/3 4/4"]);
        let mtl = String::from_utf8(files[1].1.clone()).unwrap();
        assert!(mtl.contains(&format!("map_Kd {}\n", files[2].0)));
        assert_eq!(files[2].1[..2], [0xff, 0xd8]);
    }
}
