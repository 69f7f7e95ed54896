//! Every decoder on bytes that are almost right: an answer or an error, never a panic.
//!
//! Seconds each time; `TAILOR_FUZZ=1000 cargo test --release --test product decoders` takes a thousand times
//! as many, and `TAILOR_FUZZ_SEED` other ones. What broke something is added to `corpus/`.

mod mutate;

use mutate::mutated;
use proof::Dice;
use stage::{AnyArtifact, AnyStage, Ctx, FileEntry, Files, Hash, Host};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use tailor::store::{Store, retention};

/// The files of a folder of the corpus, by their names.
fn corpus(folder: &str) -> Vec<(String, Vec<u8>)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/decoders/corpus");
    let entries = std::fs::read_dir(root.join(folder)).unwrap();
    let mut files: Vec<(String, Vec<u8>)> = entries
        .map(|e| e.unwrap())
        .map(|e| {
            (
                e.file_name().into_string().unwrap(),
                std::fs::read(e.path()).unwrap(),
            )
        })
        .collect();
    files.sort();
    assert!(!files.is_empty(), "{folder}");
    files
}

fn number(name: &str, usual: u64) -> u64 {
    std::env::var(name).map_or(usual, |n| n.parse().unwrap())
}

/// Holds a decoder to not panicking, so many times a file; `decode` also gets the file's name.
fn hold(what: &str, seeds: &[(String, Vec<u8>)], times: u64, decode: impl Fn(&str, &[u8])) {
    let bytes_of_all: Vec<&Vec<u8>> = seeds.iter().map(|(_, bytes)| bytes).collect();
    for (i, (name, seed)) in seeds.iter().enumerate() {
        decode(name, seed);
        let mut dice = Dice(number("TAILOR_FUZZ_SEED", 1) << 20 | i as u64);
        for round in 0..times * number("TAILOR_FUZZ", 1) {
            let other = bytes_of_all[dice.bits() as usize % bytes_of_all.len()];
            let bytes = mutated(seed, other, &mut dice);
            if catch_unwind(AssertUnwindSafe(|| decode(name, &bytes))).is_err() {
                let kept = std::env::temp_dir().join(format!("broken-{name}"));
                std::fs::write(&kept, &bytes).unwrap();
                panic!(
                    "{what}: round {round} of {name} panics; kept as {}",
                    kept.display()
                );
            }
        }
    }
}

#[test]
fn artifacts() {
    let stages: Vec<&dyn AnyStage> = tailor::catalog::stages().collect();
    hold("artifacts", &corpus("artifact"), 300, |_, bytes| {
        for stage in &stages {
            let _ = stage.read(bytes);
        }
    });
}

#[test]
fn surfaces_and_girths() {
    let mesh = shape::Mesh {
        positions: vec![[0.0; 3], [9.0, 0.0, 0.0], [0.0, 9.0, 0.0], [0.0, 0.0, 9.0]],
        faces: vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]],
        ..shape::Mesh::default()
    };
    let binary = shape::mesh_to_ply(&mesh);
    let ascii = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
        element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    let seeds = [
        ("binary.ply".into(), binary),
        ("ascii.ply".into(), ascii.into()),
    ];
    hold("PLY", &seeds, 3000, |_, bytes| {
        drop(shape::mesh_from_ply(bytes))
    });
    let place = tempfile::tempdir().unwrap();
    for (name, bytes) in corpus("tables") {
        std::fs::write(place.path().join(name), bytes).unwrap();
    }
    hold("results", &corpus("tables"), 300, |name, bytes| {
        let whole = std::fs::read(place.path().join(name)).unwrap();
        std::fs::write(place.path().join(name), bytes).unwrap();
        let _ = tailor::compare::Side::from_folder("a", place.path());
        let _ = tailor::score::score(place.path(), place.path());
        std::fs::write(place.path().join(name), whole).unwrap();
    });
}

#[test]
fn pipelines() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut seeds = corpus("pipeline");
    for name in ["body", "synth", "paper"] {
        let path = root.join(format!("pipelines/{name}.toml"));
        seeds.push((format!("{name}.toml"), std::fs::read(path).unwrap()));
    }
    hold("pipelines", &seeds, 300, |name, bytes| {
        let text = String::from_utf8_lossy(bytes);
        let overrides = tailor::recipe::Overrides::default();
        if let Err(mistakes) =
            tailor::recipe::open_text(name, &text, &overrides, &tailor::catalog::CATALOG)
        {
            let _ = (mistakes.to_string(), mistakes.json());
        }
    });
}

struct Nobody;
impl Host for Nobody {}

/// Runs a stage on the files of a folder, photos beside them if they are given.
fn run(stage: &str, folder: &Path, photos: Option<&AnyArtifact>) -> Option<AnyArtifact> {
    let stage = tailor::catalog::find(stage).unwrap();
    let mut names: Vec<PathBuf> = std::fs::read_dir(folder)
        .unwrap()
        .map(|e| e.unwrap().path())
        .collect();
    names.sort();
    let entry = |path: &PathBuf| {
        let bytes = std::fs::read(path).unwrap();
        FileEntry {
            name: path.file_name().unwrap().to_str().unwrap().into(),
            content: stage::hash(&bytes),
            size: bytes.len() as u64,
        }
    };
    let files = Files {
        root: folder.into(),
        entries: names.iter().map(entry).collect(),
    };
    let mut inputs = vec![Some(AnyArtifact::new(files))];
    inputs.extend(photos.cloned().map(Some));
    let params = stage
        .check(&Default::default())
        .unwrap_or_else(|_| panic!("defaults"));
    let key = Hash::from_bytes([0; 32]);
    let made = stage.run(&params, inputs, &Ctx::new(&Nobody, key, key));
    made.ok().map(|made| made.artifact)
}

/// A folder with three photos.
fn photos() -> tempfile::TempDir {
    let place = tempfile::tempdir().unwrap();
    let images = corpus("image");
    let mut jpegs = images.iter().filter(|(name, _)| name.ends_with(".jpg"));
    for name in ["0000.jpg", "0001.jpg", "0002.jpg"] {
        std::fs::write(place.path().join(name), &jpegs.next().unwrap().1).unwrap();
    }
    place
}

#[test]
fn photos_and_captures() {
    let place = photos();
    let capture = "[camera]\nfocal_px = 300.0\n[mat]\ntag_size_mm = 60.0\nring_radius_mm = 187.0\ncount = 12\nids = [0, 11]\n";
    let mut seeds = corpus("image");
    seeds.push(("capture.toml".into(), capture.into()));
    let sample = Path::new(env!("CARGO_MANIFEST_DIR")).join("samples/mannequin/capture.toml");
    seeds.push(("capture.toml".into(), std::fs::read(sample).unwrap()));
    hold("photos", &seeds, 100, |name, bytes| {
        let path = place.path().join(name);
        std::fs::write(&path, bytes).unwrap();
        let _ = run("capture.load", place.path(), None);
        std::fs::remove_file(path).unwrap();
    });
}

#[test]
fn cameras_and_masks_of_other_programs() {
    let turn = photos();
    let photos = run("capture.load", turn.path(), None).expect("three photos");
    for model in ["colmap-text", "colmap-binary", "json", "middlebury"] {
        let (seeds, place) = (corpus(model), tempfile::tempdir().unwrap());
        for (name, bytes) in &seeds {
            std::fs::write(place.path().join(name), bytes).unwrap();
        }
        hold(model, &seeds, 300, |name, bytes| {
            let whole = std::fs::read(place.path().join(name)).unwrap();
            std::fs::write(place.path().join(name), bytes).unwrap();
            let _ = run("pose.import", place.path(), Some(&photos));
            std::fs::write(place.path().join(name), whole).unwrap();
        });
    }
    let place = tempfile::tempdir().unwrap();
    let masks: Vec<_> = corpus("image")
        .into_iter()
        .filter(|(n, _)| n != "heic.heic")
        .collect();
    hold("masks", &masks, 100, |_, bytes| {
        for name in ["0000.png", "0001.png", "0002.png"] {
            std::fs::write(place.path().join(name), bytes).unwrap();
        }
        let _ = run("silhouette.import", place.path(), Some(&photos));
    });
}

/// All results, the last few runs.
const FEW: retention::Budget = retention::Budget {
    most: u64::MAX,
    keep_runs: 1,
    keep_records: 2,
};

/// Everything that a store reads: made by a run, then almost right.
#[test]
fn files_of_a_store() {
    let place = proof::in_memory();
    let (cache, turn) = (place.path().join("cache"), photos());
    let pipeline = "goal = \"photos\"\n[input.f]\nfiles = \"*.jpg\"\n[node.photos]\nstage = \"capture.load\"\nfrom = { files = \"@f\" }\n";
    let graph = tailor::recipe::open_text(
        "p",
        pipeline,
        &Default::default(),
        &tailor::catalog::CATALOG,
    )
    .unwrap();
    let options = tailor::engine::Options {
        cache: cache.clone(),
        threads: Some(1),
        keep_going: false,
    };
    struct Deaf;
    impl tailor::walk::Watch for Deaf {}
    let folders = [("f".to_owned(), turn.path().to_owned())];
    let go = Default::default();
    let run = || tailor::engine::run(&graph, &folders, &graph.goal, &options, &Deaf, &go);
    let key = run().unwrap().nodes[0].as_ref().unwrap().key.unwrap();
    Store::open(&cache)
        .unwrap()
        .remember(key, b"a part of something")
        .unwrap();
    let hex = key.to_hex();
    let names = [
        format!("ac/{}/{hex}", &hex[..2]),
        format!("parts/{}/{hex}", &hex[..2]),
    ];
    let mut files: Vec<PathBuf> = names.iter().map(|name| cache.join(name)).collect();
    files.extend(["index", "files.json", "last-run", "noted"].map(|name| cache.join(name)));
    let runs = std::fs::read_dir(cache.join("runs")).unwrap();
    files.extend(runs.map(|e| e.unwrap().path()));
    files.retain(|path| path.exists());
    assert!(files.len() >= 6, "{files:?}");
    let read = |path: PathBuf| (std::fs::read(&path).unwrap(), path);
    let files: Vec<(Vec<u8>, PathBuf)> = files.into_iter().map(read).collect();
    for (bytes, path) in files {
        let seed = [(String::from("file"), bytes)];
        let rounds = std::cell::Cell::new(0);
        hold(&path.display().to_string(), &seed, 60, |_, bytes| {
            std::fs::write(&path, bytes).unwrap();
            let store = Store::open(&cache).unwrap();
            // Each round leaves the record of a run, and the next ones read them all.
            rounds.set(rounds.get() + 1);
            if rounds.get() % 50 == 0 {
                retention::gc(&store, &FEW, false).unwrap();
            }
            let _ = (store.found(key), store.record(key), store.recall(key));
            drop(store);
            tailor::engine::runs(&cache).for_each(drop);
            run().unwrap();
        });
    }
}
