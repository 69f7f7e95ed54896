//! Scans as strangers hand them over: each gives its girths, or a clear word and no number.

use super::place::Place;
use super::things::{
    ball, body, changed, dog, half, meshed, one_arm, open_half, pair, seat, together,
};
use serde_json::Value;
use shape::{Mesh, mesh_to_ply};
use std::collections::BTreeMap;

/// Measures a file; its exit code, and what is printed, in one line.
fn measured(place: &Place, file: &str, bytes: &[u8]) -> (Option<i32>, String) {
    place.write(file, bytes);
    let answer = place.run(&format!("measure {file} --out out-{file}"));
    let text = format!("{}{}", answer.out, answer.err);
    let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(!text.contains("panicked"), "{file}: {text}");
    (answer.code, text)
}

/// What came of a scan.
fn result(place: &Place, file: &str) -> Value {
    let path = place.path(&format!("out-{file}/girths.json"));
    let bytes = std::fs::read(path).unwrap_or_else(|e| panic!("{file}: {e}"));
    serde_json::from_slice(&bytes).unwrap()
}

/// Tapes by name. \[cm\]
fn tapes(result: &Value) -> BTreeMap<String, f64> {
    let all = result["girths"].as_array().unwrap().iter();
    let one = |g: &Value| {
        (
            g["name"].as_str().unwrap().to_owned(),
            g["tape_cm"].as_f64().unwrap(),
        )
    };
    all.map(one).collect()
}

/// Measures what is no whole upright body: no girth and no height, and of these words one.
#[track_caller]
fn refused(place: &Place, name: &str, mesh: &Mesh, words: &[&str]) {
    let file = format!("{name}.ply");
    let (code, text) = measured(place, &file, &mesh_to_ply(mesh));
    assert!(words.iter().any(|w| text.contains(w)), "{name}: {text}");
    if code == Some(0) {
        let result = result(place, &file);
        assert_eq!(tapes(&result), BTreeMap::new(), "{name}");
        assert!(result["stature_cm"].is_null(), "{name}");
    }
}

#[test]
fn what_is_no_body_gives_no_girth_and_a_word() {
    let place = Place::new();
    let legs = "more than two legs";
    refused(&place, "chair", &seat(true), &[legs]);
    refused(
        &place,
        "stool",
        &seat(false),
        &[legs, "no two legs", "upright"],
    );
    refused(&place, "dog", &dog(), &[legs, "upright", "no two legs"]);
    refused(
        &place,
        "ball",
        &ball([400.0, 400.0, 400.0]),
        &["no two legs"],
    );
    refused(
        &place,
        "post",
        &ball([120.0, 120.0, 850.0]),
        &["no two legs", "upright"],
    );
}

#[test]
fn two_people_are_not_measured_as_one() {
    let place = Place::new();
    let one = meshed(&body());
    let other = changed(&one, |[x, y, z]| [x + 1500.0, y, z]);
    let apart = together(&[one, other]);
    refused(&place, "two", &apart, &["two large pieces"]);
    refused(&place, "pair", &pair(), &["more than two legs"]);
}

#[test]
fn a_part_of_a_body_gives_no_girth_and_a_word() {
    let place = Place::new();
    let whole = meshed(&body());
    let cut = [
        "one plane",
        "no two legs",
        "upright",
        "no feet",
        "tall",
        "high",
    ];
    for (name, axis, at) in [("left", 0, 0.0), ("front", 1, 0.0), ("waist", 2, 1020.0)] {
        for above in [false, true] {
            let own = format!("{name}-{above}");
            refused(&place, &own, &half(&whole, axis, at, above), &cut);
            refused(
                &place,
                &format!("open-{own}"),
                &open_half(&whole, axis, at, above),
                &cut,
            );
        }
    }
}

#[test]
fn numbers_that_are_none_or_far_away_are_refused_in_words() {
    let place = Place::new();
    let whole = meshed(&body());
    let with = |p: [f32; 3]| {
        let mut mesh = whole.clone();
        mesh.positions[7] = p;
        mesh
    };
    refused(&place, "nan", &with([f32::NAN; 3]), &["no number"]);
    refused(&place, "far", &with([1e30, 0.0, 0.0]), &["high"]);
    refused(
        &place,
        "spike",
        &with([9000.0, 0.0, 800.0]),
        &["upright", "high"],
    );
    let flat = changed(&whole, |[x, y, _]| [x, y, 0.0]);
    refused(
        &place,
        "flat",
        &flat,
        &["high", "upright", "one plane", "no two legs"],
    );
    let point = changed(&whole, |_| [1.0; 3]);
    refused(&place, "point", &point, &["high"]);
    let none = Mesh {
        faces: vec![],
        ..whole.clone()
    };
    refused(&place, "cloud", &none, &["cloud of points"]);
    let mut one = whole;
    one.faces.truncate(1);
    refused(&place, "one", &one, &["high", "no two legs", "upright"]);
}

#[test]
fn too_many_faces_are_refused_by_the_heads_of_files() {
    let place = Place::new();
    let head = "ply\nformat binary_little_endian 1.0\nelement vertex 5000000\nproperty float x\nproperty float y\nproperty float z\n\
        element face 10000000\nproperty list uchar int vertex_indices\nend_header\n";
    for (file, bytes) in [
        ("many.ply", head.as_bytes()),
        ("many.off", b"OFF\n5000000 10000000 0\n"),
    ] {
        let (code, text) = measured(&place, file, bytes);
        let refused = text.contains("10000000 faces, more than 4 million");
        assert!(code == Some(1) && refused, "{text}");
    }
}

#[test]
fn a_body_with_one_arm_is_upright_and_measured() {
    let place = Place::new();
    let (code, text) = measured(&place, "arm.ply", &mesh_to_ply(&one_arm()));
    assert!(code == Some(0) && text.contains("with z up"), "{text}");
    let result = result(&place, "arm.ply");
    assert!(
        result["stature_cm"]
            .as_f64()
            .is_some_and(|cm| (cm - 170.0).abs() < 2.0)
    );
    let got = tapes(&result);
    assert!(
        got.contains_key("HC") && got.contains_key("WC") && !got.contains_key("AC_L"),
        "{got:?}"
    );
}

/// A body in another unit, on its feet, its head, its back or its side, in another format, its faces turned.
#[test]
fn units_axes_formats_and_faces_change_nothing() {
    let place = Place::new();
    let whole = meshed(&body());
    measured(&place, "own.ply", &mesh_to_ply(&whole));
    let own = tapes(&result(&place, "own.ply"));
    assert!(own.len() > 10, "{own:?}");
    let pose: [fn([f32; 3]) -> [f32; 3]; 6] = [
        |p| p,
        |[x, y, z]| [x, z, -y],
        |[x, y, z]| [x, -z, y],
        |[x, y, z]| [z, y, -x],
        |[x, y, z]| [-z, y, x],
        |[x, y, z]| [x, -y, -z],
    ];
    // A unit is recognised by the height, an axis by the shape, faces by their volume: each in turn, not all with all.
    let units = [("mm", 1.0), ("cm", 10.0), ("m", 1000.0), ("in", 25.4)];
    for (k, pose) in pose.into_iter().enumerate() {
        let (unit, mm) = units[k % 4];
        let mesh = changed(&whole, |p| pose(p).map(|x| x / mm));
        let file = format!("{unit}-{k}.{}", ["ply", "obj", "stl"][k % 3]);
        let mesh = if k % 2 == 0 { mesh } else { inverted(mesh, k) };
        let bytes = match k % 3 {
            0 => mesh_to_ply(&mesh),
            1 => obj(&mesh),
            _ => io::mesh_to_stl(&mesh).unwrap(),
        };
        let (_, text) = measured(&place, &file, &bytes);
        let unit = format!("taken as {unit} with");
        assert!(text.contains(&unit), "{file}: {text}");
        let got = tapes(&result(&place, &file));
        for (name, tape) in &own {
            let off = got.get(name).map(|t| (t / tape - 1.0).abs());
            assert!(
                off.is_some_and(|off| off < 0.01),
                "{file}: {name} {:?} for {tape}",
                got.get(name)
            );
        }
    }
}

/// Soles that no scanner saw, and a hole at the buttocks.
#[test]
fn open_soles_and_a_hole_are_closed_and_change_little() {
    let place = Place::new();
    let whole = meshed(&body());
    measured(&place, "own.ply", &mesh_to_ply(&whole));
    let of = result(&place, "own.ply");
    let (own, girths) = (tapes(&of), of["girths"].as_array().unwrap());
    let hip = girths.iter().find(|g| g["name"] == "HC").unwrap();
    let hip = hip["plane"]["point_mm"][2].as_f64().unwrap();
    let low = whole.bounds().unwrap().0.z;
    let gone = |v: &u32| {
        let p = whole.point(*v);
        let behind = p.y > 0.0 && p.x.abs() < 40.0 && (p.z - low - hip).abs() < 40.0;
        p.z < low + 12.0 || behind
    };
    let faces = whole.faces.iter().filter(|f| !f.iter().any(gone));
    let open = Mesh {
        faces: faces.copied().collect(),
        ..whole.clone()
    };
    let (code, text) = measured(&place, "open.ply", &mesh_to_ply(&open));
    assert!(code == Some(0) && text.contains("flat covers: 3"), "{text}");
    let got = tapes(&result(&place, "open.ply"));
    for (name, tape) in &own {
        let off = got.get(name).map(|t| (t / tape - 1.0).abs());
        assert!(
            off.is_some_and(|off| off < 0.02),
            "{name} {:?} for {tape}",
            got.get(name)
        );
    }
}

/// With all faces turned, or those below the waist.
fn inverted(mut mesh: Mesh, all: usize) -> Mesh {
    let (low, high) = mesh.bounds().unwrap();
    let middle = (low + (high - low) / 2.0).coords;
    let long = (high - low).imax();
    let of = |f: &[u32; 3]| {
        f.iter()
            .all(|v| f64::from(mesh.positions[*v as usize][long]) < middle[long])
    };
    let some: Vec<bool> = mesh.faces.iter().map(of).collect();
    let wanted = |f: usize| all == 3 || some[f];
    for (f, face) in mesh.faces.iter_mut().enumerate() {
        if wanted(f) {
            face.swap(1, 2);
        }
    }
    mesh
}

fn obj(mesh: &Mesh) -> Vec<u8> {
    let vertices = mesh
        .positions
        .iter()
        .map(|[x, y, z]| format!("v {x} {y} {z}\n"));
    let faces = mesh.faces.iter().map(|f| f.map(|v| v + 1));
    let faces = faces.map(|[a, b, c]| format!("f {a} {b} {c}\n"));
    vertices.chain(faces).collect::<String>().into_bytes()
}
