//! A store keeps its hands off what is not its own, and believes no file without checking it.

use super::place::Place;
use std::fs;
use std::os::unix::fs::symlink;

const GC: &str = "cache gc --max-size 0 --keep-runs 0";

/// The files of a shelf.
fn shelf(place: &Place, name: &str) -> Vec<std::path::PathBuf> {
    let inner = |folder| {
        let entries = fs::read_dir(folder).into_iter().flatten();
        entries.map(|e| e.unwrap().path())
    };
    let mut all: Vec<_> = inner(place.path(name)).flat_map(inner).collect();
    all.sort();
    all
}

#[test]
fn a_folder_that_is_somebody_elses_is_not_made_a_store() {
    let place = Place::new();
    place.write("p/tmp/notes.md", "x");
    place.write("q/letter.txt", "x");
    place.write("r/cas", "a file of that name");
    for (folder, strange) in [("p", "notes.md"), ("q", "letter.txt"), ("r", "r/cas")] {
        let printed = place.run(&format!("run small.toml --cache {folder}"));
        let printed = printed.code(2);
        assert!(printed.err.contains("is no cache"), "{}", printed.err);
        assert!(printed.err.contains(strange), "{}", printed.err);
        assert!(!place.path(folder).join("format").exists());
    }
    assert_eq!(
        fs::read_to_string(place.path("p/tmp/notes.md")).unwrap(),
        "x"
    );
    fs::create_dir(place.path("empty")).unwrap();
    place.write("empty/.gitignore", "*");
    place.run("run small.toml --cache empty").code(0);
}

#[test]
fn gc_removes_names_of_its_own_form_only() {
    let place = Place::new();
    place.run("run small.toml").code(0);
    let hash = "ab".repeat(32);
    let foreign = [
        "tmp/notes.md",
        "tmp/12-letter",
        "lease/notes",
        "quarantine/why.txt",
        "runs/mine.json",
        "cas/notes.md",
        "cas/ab/notes.md",
        "cas/diary/ab",
        "part/ab/notes.md",
        "ac/ab/notes.md",
        "pins/.hidden",
    ];
    foreign
        .iter()
        .for_each(|name| place.write(&format!("cache/{name}"), "x"));
    // Of our form: litter.
    let litter = [
        "tmp/4000000-0-1f".to_owned(),
        format!("quarantine/{hash}"),
        format!("cas/ab/{hash}"),
        format!("part/ab/{hash}"),
    ];
    litter
        .iter()
        .for_each(|name| place.write(&format!("cache/{name}"), "x"));
    place.run("cache verify").code(0);
    place.run(GC).code(0);
    for name in foreign {
        assert!(place.path(&format!("cache/{name}")).exists(), "{name}");
    }
    for name in litter {
        assert!(!place.path(&format!("cache/{name}")).exists(), "{name}");
    }
    assert!(
        shelf(&place, "cache/cas")
            .iter()
            .all(|p| !p.to_str().unwrap().ends_with(&hash))
    );
}

#[test]
fn nothing_is_removed_through_a_link() {
    let hash = format!("ab{}", "0".repeat(62));
    for folder in ["cas", "ac", "parts", "tmp", "lease", "quarantine", "runs"] {
        let place = Place::new();
        place.run("run small.toml").code(0);
        let victim = [
            format!("ab/{hash}"),
            "1-1-1".into(),
            "abc".into(),
            hash.clone(),
        ];
        victim
            .iter()
            .for_each(|name| place.write(&format!("victim/{name}"), "x"));
        let _ = fs::remove_dir_all(place.path("cache").join(folder));
        symlink("../victim", place.path("cache").join(folder)).unwrap();
        let printed = place.run(GC).code(2);
        assert!(printed.err.contains("is a link"), "{}", printed.err);
        for name in &victim {
            assert!(place.path("victim").join(name).exists(), "{folder}: {name}");
        }
    }
    // A link below a shelf, and a file that is one.
    let place = Place::new();
    place.run("run small.toml").code(0);
    place.write(&format!("victim/{hash}"), "x");
    let _ = fs::remove_dir_all(place.path("cache/cas/ab"));
    symlink("../../victim", place.path("cache/cas/ab")).unwrap();
    fs::create_dir_all(place.path("cache/quarantine")).unwrap();
    symlink(
        format!("../../victim/{hash}"),
        place.path("cache/quarantine").join(&hash),
    )
    .unwrap();
    place.run(GC).code(0);
    assert!(place.path("victim").join(&hash).exists());
}

#[test]
fn a_record_under_another_key_is_none() {
    let place = Place::new();
    place.run("run small.toml").code(0);
    let records = shelf(&place, "cache/ac");
    let bytes: Vec<_> = records.iter().map(|r| fs::read(r).unwrap()).collect();
    for (i, record) in records.iter().enumerate() {
        fs::write(record, &bytes[(i + 1) % bytes.len()]).unwrap();
    }
    let verified = place.run("cache verify --json").code(0).json();
    assert_eq!(verified["bad"], 4, "{verified}");
    fs::remove_file(place.path("cache/index")).unwrap();
    let run = place.run("run small.toml --json").code(0).json();
    for node in run["nodes"].as_array().unwrap() {
        assert_eq!(node["status"], "made", "{node}");
    }
    for (record, bytes) in records.iter().zip(&bytes) {
        let content = |b: &[u8]| {
            let body = &b[b.iter().position(|b| *b == b'\n').unwrap()..];
            serde_json::from_slice::<serde_json::Value>(body).unwrap()["content"].clone()
        };
        assert_eq!(content(&fs::read(record).unwrap()), content(bytes));
    }
}

#[test]
fn what_another_version_of_the_program_wrote_stays() {
    let place = Place::new();
    place.run("run small.toml").code(0);
    let record = &shelf(&place, "cache/ac")[0];
    let body = "{\"version\": 5, \"provenance\": [], \"of\": \"a later program\"}\n";
    let hash = blake3::hash(body.as_bytes()).to_hex();
    fs::write(record, format!("{hash}\n{body}")).unwrap();
    let verified = place.run("cache verify --json").code(0).json();
    assert_eq!(verified["bad"], 0, "{verified}");
    assert!(fs::read_to_string(record).unwrap().ends_with(body));
}

#[test]
fn a_changed_memo_of_sources_is_thrown_away() {
    let place = Place::new();
    place.write("load.toml", "goal = \"photos\"\n[input.files]\nfiles = \"*.jpg\"\n[node.photos]\nstage = \"capture.load\"\nfrom = { files = \"@files\" }\n");
    place.photos("turn", 3);
    // What was changed a moment ago is hashed anyhow.
    std::thread::sleep(std::time::Duration::from_millis(2100));
    let command = "run load.toml --input files=turn";
    place.run(command).code(0);
    let memo = place.path("cache/files.json");
    let text = fs::read_to_string(&memo).unwrap();
    let at = text.find("content\":\"").unwrap() + 10;
    let other = if &text[at..=at] == "0" { "1" } else { "0" };
    fs::write(&memo, format!("{}{other}{}", &text[..at], &text[at + 1..])).unwrap();
    let run = place.run(&format!("{command} --json")).code(0).json();
    assert_eq!(run["nodes"][0]["status"], "found", "{run}");
    assert_eq!(fs::read_to_string(&memo).unwrap().len(), text.len());
}

#[test]
fn a_blob_cut_short_is_made_again() {
    let place = Place::new();
    place.run("run small.toml").code(0);
    for blob in shelf(&place, "cache/cas") {
        let file = fs::File::options().write(true).open(blob).unwrap();
        file.set_len(5).unwrap();
    }
    place
        .run("run small.toml --set body.cell_mm=35 --out out")
        .code(0);
    // The body that nobody read was cut short too.
    let bad = place.run("cache verify --json").code(0).json()["bad"].clone();
    assert_eq!(bad, 1);
    place.sound();
}
