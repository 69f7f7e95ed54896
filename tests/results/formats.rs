//! docs/formats.md, checked by a reader that knows nothing else: python/read_store.py against `tailor show`.

use std::path::Path;
use std::process::Command;

const PIPELINE: &str = "goal = [\"masks\", \"page\"]\n\
    [node.solid]\nstage = \"synth.solid\"\nwith = { stature_mm = 600.0 }\n\
    [node.body]\nstage = \"synth.body\"\nfrom = [\"solid\"]\nwith = { cell_mm = 12.0 }\n\
    [node.cameras]\nstage = \"synth.ring\"\nwith = { views = 8, width = 240, height = 312, distance_mm = 1100.0, camera_mm = 560.0, look_mm = 240.0, disk_mm = 300.0 }\n\
    [node.masks]\nstage = \"synth.masks\"\nfrom = { mesh = \"body\", cameras = \"cameras\" }\n\
    [node.page]\nstage = \"pose.mat\"\nwith = { print = \"svg\" }\n";

fn tailor(place: &Path, words: &[&str]) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_tailor"));
    command.current_dir(place).args(words);
    let out = command
        .args(["--cache", "cache", "--quiet"])
        .output()
        .unwrap();
    let wrong = String::from_utf8_lossy(&out.stderr);
    assert!(out.status.success(), "{words:?}: {wrong}");
}

/// What the reader in Python makes of a node, in the folder `py-NODE`.
fn python(place: &Path, node: &str) {
    let reader = Path::new(env!("CARGO_MANIFEST_DIR")).join("python/read_store.py");
    let mut command = Command::new("python3");
    command
        .current_dir(place)
        .arg(reader)
        .args(["cache", node, "-o"]);
    let out = command.arg(format!("py-{node}")).output().unwrap();
    let wrong = String::from_utf8_lossy(&out.stderr);
    assert!(out.status.success(), "{node}: {wrong}");
}

fn floats(bytes: &[u8]) -> Vec<f32> {
    let four = bytes.chunks_exact(4);
    four.map(|b| f32::from_le_bytes(b.try_into().unwrap()))
        .collect()
}

#[test]
fn a_reader_in_python_reads_what_the_program_shows() {
    let there = Command::new("python3").arg("--version").output();
    if !there.is_ok_and(|out| out.status.success()) {
        eprintln!("NOT TESTED: python3 is missing, so docs/formats.md is not checked here");
        return;
    }
    let place = tempfile::tempdir().unwrap();
    let at = |name: &str| std::fs::read(place.path().join(name)).unwrap();
    std::fs::write(place.path().join("p.toml"), PIPELINE).unwrap();
    tailor(place.path(), &["run", "p.toml", "masks", "page", "body"]);
    for (node, file) in [
        ("body", "body.ply"),
        ("cameras", "cameras.json"),
        ("page", "page.svg"),
        ("masks", "masks"),
    ] {
        tailor(
            place.path(),
            &["show", node, "--pipeline", "p.toml", "-o", file],
        );
        python(place.path(), node);
    }
    let mesh = shape::mesh_from_ply(&at("body.ply")).unwrap();
    assert!(mesh.positions.len() > 100);
    assert_eq!(floats(&at("py-body/positions")), mesh.positions.concat());
    let faces: Vec<u8> = mesh
        .faces
        .concat()
        .iter()
        .flat_map(|i| i.to_le_bytes())
        .collect();
    assert_eq!(at("py-body/faces"), faces);
    assert_eq!(at("py-page/bytes"), at("page.svg"));
    let mut masks = 0;
    for entry in std::fs::read_dir(place.path().join("masks")).unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        let shown = shape::gray_from_file(&at(&format!("masks/{name}"))).unwrap();
        let read = at(&format!("py-masks/{}", name.replace(".png", ".pgm")));
        let head = format!("P5 {} {} 255\n", shown.width, shown.height);
        assert_eq!(read, [head.as_bytes(), &shown.data].concat(), "{name}");
        masks += 1;
    }
    let json = |name: &str| -> serde_json::Value { serde_json::from_slice(&at(name)).unwrap() };
    let (shown, read) = (json("cameras.json"), json("py-cameras/cameras.json"));
    let (shown, read) = (
        shown["views"].as_array().unwrap(),
        read[0].as_array().unwrap(),
    );
    assert!(masks > 3 && shown.len() == masks && read.len() == masks);
    for (shown, read) in shown.iter().zip(read) {
        let view = &read[1];
        assert_eq!(view[0], shown["image"]);
        assert_eq!(view[1][2], shown["K"][0][0]);
        // Nine numbers of the rotation column by column, then three of the translation.
        assert_eq!((&view[3], &view[11]), (&shown["R"][1][0], &shown["t"][0]));
    }
}
