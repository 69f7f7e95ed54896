//! Each format gives the same surface; an error names what is wrong with a broken file.

use super::*;

const POINTS: [&str; 4] = ["0 0 0", "1 0 0", "0 1 0", "0 0 1"];
const FACES: [[usize; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];

fn sound(name: &str, bytes: &[u8]) {
    let read = read(name, bytes).unwrap_or_else(|why| panic!("{name}: {why}"));
    let mesh = read.mesh;
    assert_eq!((mesh.positions.len(), mesh.faces.len()), (4, 4), "{name}");
    proof::near(mesh.volume(), 1.0 / 6.0, 1e-6);
}

#[test]
fn a_tetrahedron_is_the_same_in_every_format() {
    let (mut obj, mut off) = (String::new(), "OFF # a tetrahedron\n4 4 6\n".to_owned());
    let (mut ascii, mut binary) = ("solid x\n".to_owned(), vec![0u8; 80]);
    // Each face with corners of its own.
    let mut ply = "ply\nformat ascii 1.0\nelement vertex 12\n".to_owned();
    for axis in ["x", "y", "z"] {
        ply += &format!("property float {axis}\n");
    }
    ply += "element face 4\nproperty list uchar int vertex_indices\nend_header\n";
    let corners = FACES.iter().flatten();
    corners.for_each(|v| ply += &format!("{}\n", POINTS[*v]));
    (0..4).for_each(|f| ply += &format!("3 {} {} {}\n", 3 * f, 3 * f + 1, 3 * f + 2));
    sound("a.ply", ply.as_bytes());
    binary.extend(4u32.to_le_bytes());
    POINTS.iter().for_each(|p| obj += &format!("v {p} 1 1 1\n"));
    POINTS.iter().for_each(|p| off += &format!("{p}\n"));
    for f in FACES {
        let [a, b, c] = f.map(|v| v + 1);
        obj += &format!("f {a}/1/1 {b}//2 {}\n", c as i64 - 5);
        off += &format!("3 {} {} {}\n", f[0], f[1], f[2]);
        binary.extend([0u8; 12]);
        for v in f {
            ascii += &format!("  vertex {}\n", POINTS[v]);
            for word in POINTS[v].split(' ') {
                binary.extend(word.parse::<f32>().unwrap().to_le_bytes());
            }
        }
        binary.extend([0u8; 2]);
    }
    sound("A.OBJ", obj.as_bytes());
    sound("a.off", off.as_bytes());
    sound("a.stl", ascii.as_bytes());
    sound("a.stl", &binary);
    let short = read("a.stl", &binary[..binary.len() - 7]);
    assert!(short.is_err_and(|why| why.contains("cut short")));
    for wrong in ["v 0 0\n", "v 0 0 0\nf 1 2 3\n", "f 0 1 2\n"] {
        assert!(read("a.obj", wrong.as_bytes()).is_err(), "{wrong}");
    }
    assert!(read("a.off", b"OFF\n3 1 0\n0 0 0\n").is_err());
}

/// What the program writes itself, read back: in the numbers of the format.
#[test]
fn packages_of_its_own_are_read_back_with_their_units() {
    let tetrahedron = tetrahedron();
    let three_mf = read("a.3mf", &io::mesh_to_3mf(&tetrahedron).unwrap()).unwrap();
    assert_eq!(three_mf.unit, Some(Unit::Mm));
    assert_eq!(three_mf.mesh.positions, tetrahedron.positions);
    let glb = read("a.glb", &io::mesh_to_glb(&tetrahedron)).unwrap();
    assert_eq!(glb.unit, Some(Unit::M));
    // Metres with y up, welded again.
    assert_eq!((glb.mesh.positions.len(), glb.mesh.faces.len()), (4, 4));
    proof::near(glb.mesh.volume(), 1e-9 / 6.0, 1e-15);
}

fn tetrahedron() -> Mesh {
    let numbers = POINTS.map(|p| {
        p.split(' ')
            .map(|w| w.parse().unwrap())
            .collect::<Vec<f32>>()
    });
    Mesh {
        positions: numbers.iter().map(|n| [n[0], n[1], n[2]]).collect(),
        faces: FACES.map(|f| f.map(|v| v as u32)).to_vec(),
        ..Mesh::default()
    }
}

/// A 3MF whose models have these texts.
fn package(models: &[(&str, &str)]) -> Vec<u8> {
    let mut zip = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
    for (name, text) in models {
        zip.start_file(*name, zip::write::SimpleFileOptions::default())
            .unwrap();
        std::io::Write::write_all(&mut zip, text.as_bytes()).unwrap();
    }
    zip.finish().unwrap().into_inner()
}

const TRIANGLE: &str = "<mesh><vertices><vertex x='1' y='0' z='0'/><vertex x='0' y='2' z='0'/><vertex x='0' y='0' z='3'/></vertices><triangles><triangle v1='0' v2='1' v3='2'/></triangles></mesh>";

#[test]
fn objects_of_a_package_are_placed_by_their_matrices() {
    let part = format!("<model><resources><object id='7'>{TRIANGLE}</object></resources></model>");
    // A quarter turn about z and a shift along x; then a shift along y.
    let main = "<model unit='inch' xmlns:p='p'><resources><object id='1'><components><component p:path='/3D/part.model' objectid='7' transform='0 1 0 -1 0 0 0 0 1 10 0 0'/></components></object></resources><build><item objectid='1' transform='1 0 0 0 1 0 0 0 1 0 100 0'/></build></model>";
    let bytes = package(&[("3D/3dmodel.model", main), ("3D/part.model", &part)]);
    let read = read("a.3mf", &bytes).unwrap();
    assert_eq!(read.unit, Some(Unit::Inch));
    let wanted = [[10.0, 101.0, 0.0], [8.0, 100.0, 0.0], [10.0, 100.0, 3.0]];
    assert_eq!(read.mesh.positions, wanted);
}

#[test]
fn nodes_of_a_scene_are_placed_by_their_parents() {
    let glb = io::mesh_to_glb(&tetrahedron());
    let size = u32::from_le_bytes(glb[12..16].try_into().unwrap()) as usize;
    let mut value: serde_json::Value = serde_json::from_slice(&glb[20..20 + size]).unwrap();
    let node = value["scenes"][0]["nodes"][0].as_u64().unwrap();
    let count = value["nodes"].as_array().unwrap().len();
    value["nodes"]
        .as_array_mut()
        .unwrap()
        .push(serde_json::json!({
            "children": [node], "rotation": [0.0, 0.0, 0.5f32.sqrt(), 0.5f32.sqrt()], "scale": [2.0, 2.0, 2.0], "translation": [0.0, 5.0, 0.0]
        }));
    value["scenes"][0]["nodes"] = serde_json::json!([count]);
    let with = |value: &serde_json::Value| {
        let json = serde_json::to_vec(value).unwrap();
        let head = [&glb[..12], &(json.len() as u32).to_le_bytes(), b"JSON"];
        [&head.concat(), json.as_slice(), &glb[20 + size..]].concat()
    };
    let mesh = read("a.glb", &with(&value)).unwrap().mesh;
    proof::near(mesh.volume() * 1e9, 8.0 / 6.0, 1e-3);
    // Corners (0, 0, 0), (1, 0, 0), (0, 0, -1), (0, 1, 0) of a millimetre: x turns to y.
    let (low, high) = mesh.bounds().unwrap();
    proof::near(low.x, -0.002, 1e-6);
    proof::near(high.x, 0.0, 1e-6);
    proof::near(high.y, 5.002, 1e-6);
    proof::near(low.z, -0.002, 1e-6);
    // A node that contains itself ends.
    value["nodes"][count]["children"] = serde_json::json!([node, count]);
    assert!(read("a.glb", &with(&value)).is_err_and(|why| why.contains("tree")));
}

#[test]
fn wrong_packages_are_refused() {
    let circle = "<model><resources><object id='1'><components><component objectid='1'/></components></object></resources><build><item objectid='1'/></build></model>";
    let missing = "<model><build><item objectid='3'/></build></model>";
    let short = "<model><resources><object id='1'><mesh><vertices><vertex x='1' y='2'/></vertices></mesh></object></resources></model>";
    let cut = "<model><resources><object id=";
    for (text, why) in [
        (circle, "contains itself"),
        (missing, "is not there"),
        (short, "the number z"),
        (cut, "3dmodel.model"),
    ] {
        let error = read("a.3mf", &package(&[("3D/3dmodel.model", text)]))
            .err()
            .unwrap();
        assert!(error.contains(why), "{error}");
    }
    // Any byte may be another: an error, or another surface.
    let whole = [
        ("a.glb", io::mesh_to_glb(&tetrahedron())),
        ("a.3mf", package(&[("3D/3dmodel.model", circle)])),
    ];
    for (name, bytes) in &whole {
        for i in 0..bytes.len() {
            let mut other = bytes.clone();
            for flip in [1u8, 0x80, 0xff] {
                other[i] = bytes[i] ^ flip;
                let _ = read(name, &other);
            }
            let _ = read(name, &bytes[..i]);
        }
    }
}
