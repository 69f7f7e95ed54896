//! Features of necks as a table: `neck_features LIST`, a file with one `NAME PATH` a line, each path a
//! closed surface as raw numbers (counts of vertices and faces as u32, then f32 and u32 triples, millimetres,
//! upright, little-endian). `models/fit_neck.py` writes such files and reads this table.

use measure::{NeckFeatures, body, neck_features, neck_level, plane_at};
use shape::Mesh;
use std::time::Instant;

fn main() {
    let list = std::env::args().nth(1).expect("a list of surfaces");
    let list = std::fs::read_to_string(list).expect("the list can be read");
    for line in list.lines() {
        let (name, path) = line.split_once(' ').expect("a name and a path");
        let mesh = read(&std::fs::read(path).expect("a surface can be read"));
        let ground = mesh.bounds().map_or(0.0, |b| b.0.z);
        let body = body(&mesh, ground);
        let start = Instant::now();
        let neck = body.as_ref().and_then(|b| neck_features(&mesh, b));
        let took = start.elapsed().as_secs_f64();
        eprintln!("{name}: {} faces, {took:.3} s", mesh.faces.len());
        println!("{name} {}", neck.map_or("refused".into(), |f| row(&f)));
    }
}

fn row(f: &NeckFeatures) -> String {
    let told = neck_level(f);
    let placed = plane_at(f, told.share);
    let mut row: Vec<(&str, f64)> = f.list().to_vec();
    let [x, y, z] = f.origin_mm();
    row.extend([("d", f.diameter_mm()), ("x", x), ("y", y), ("z", z)]);
    row.extend([("told", told.share), ("sigma", told.sigma)]);
    if let Ok(p) = placed {
        let ([x, y, z], [i, j, k]) = (p.plane.point_mm, p.plane.normal);
        row.extend([("placed", p.share), ("tape", p.tape_mm)]);
        row.extend([
            ("px", x),
            ("py", y),
            ("pz", z),
            ("nx", i),
            ("ny", j),
            ("nz", k),
        ]);
    }
    let cells = row.iter().map(|(name, value)| format!("{name}={value:.6}"));
    cells.collect::<Vec<_>>().join(" ")
}

fn read(bytes: &[u8]) -> Mesh {
    let words: Vec<[u8; 4]> = bytes
        .chunks_exact(4)
        .map(|c| [c[0], c[1], c[2], c[3]])
        .collect();
    let [vertices, faces] = [0, 1].map(|k| u32::from_le_bytes(words[k]) as usize);
    let (places, corners) = words[2..].split_at(3 * vertices);
    let triples = |w: &[[u8; 4]]| -> Vec<[[u8; 4]; 3]> {
        w.chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect()
    };
    let positions = triples(places)
        .into_iter()
        .map(|p| p.map(f32::from_le_bytes));
    let corners = triples(corners)
        .into_iter()
        .map(|p| p.map(u32::from_le_bytes));
    Mesh {
        positions: positions.collect(),
        faces: corners.take(faces).collect(),
        colors: Vec::new(),
    }
}
