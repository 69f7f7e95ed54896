//! What nobody else may see: what is forgotten is gone, what is private was never there.

use crate::place::{Place, SMALL};
use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};

const TURN: &str = "goal = \"tags\"\n[input.photos]\nfiles = \"*.jpg\"\n\
    [node.photos]\nstage = \"capture.load\"\nfrom = { files = \"@photos\" }\n\
    [node.tags]\nstage = \"pose.tags\"\nfrom = [\"photos\"]\n";

/// Every file and folder below one.
fn all(folder: &Path) -> Vec<PathBuf> {
    let mut found = vec![folder.to_owned()];
    let mut at = 0;
    while at < found.len() {
        for entry in fs::read_dir(&found[at]).into_iter().flatten() {
            found.push(entry.unwrap().path());
        }
        at += 1;
    }
    found
}

/// Whether a file of the cache holds these bytes.
fn holds(place: &Place, bytes: &[u8]) -> bool {
    let has = |path: &PathBuf| {
        let file = fs::read(path).unwrap_or_default();
        file.windows(bytes.len()).any(|w| w == bytes)
    };
    all(&place.path("cache")).iter().any(has)
}

#[test]
fn what_is_forgotten_is_gone_and_the_rest_stays() {
    let place = Place::new();
    place.write("turn.toml", TURN);
    for (folder, count) in [("anna", 3), ("bert", 4), ("anna-too", 3)] {
        place.photos(folder, count);
        place
            .run(&format!("run turn.toml --input photos={folder}"))
            .code(0);
        place
            .run(&format!("run turn.toml --input photos={folder}"))
            .code(0);
    }
    place.run("run small.toml").code(0);
    place.run("cache pin talk").code(0);
    let photo = fs::read(place.path("anna/0000.jpg")).unwrap();
    let inner = &photo[2000..2400];
    assert!(holds(&place, inner) && holds(&place, b"/anna\""));
    // The same photos lie elsewhere: told, and gone all the same.
    let said = place.run("cache forget anna --json").code(0).json();
    assert_eq!(
        (&said["runs"], &said["results"]),
        (&2.into(), &2.into()),
        "{said}"
    );
    let shared = said["shared"].as_array().unwrap();
    let told = |f: &serde_json::Value| f.as_str().unwrap().ends_with("/anna-too");
    assert!(shared.iter().any(told), "{said}");
    assert!(!holds(&place, b"/anna\"") && !holds(&place, b"/anna/"));
    place.run("cache forget anna-too").code(0);
    place.run("cache forget bert").code(0);
    assert!(!holds(&place, inner));
    for name in [&b"/anna"[..], b"/bert"] {
        assert!(!holds(&place, name), "{}", String::from_utf8_lossy(name));
    }
    let run = place.run("run small.toml --json").code(0).json();
    for node in run["nodes"].as_array().unwrap() {
        assert_eq!(node["status"], "found", "{node}");
    }
    assert!(place.run("cache pins").code(0).out.starts_with("talk"));
    place.sound();
    // A folder that is gone is forgotten as well.
    place.run("run turn.toml --input photos=bert").code(0);
    fs::remove_dir_all(place.path("bert")).unwrap();
    place.run("cache forget bert").code(0);
    assert!(!holds(&place, b"/bert"));
}

#[test]
fn a_private_run_leaves_its_results_and_nothing_else() {
    let place = Place::new();
    fs::create_dir(place.path("tmp")).unwrap();
    // Of a process that was killed.
    place.write("tmp/private-cache-4000000-x/cas/ab", "x");
    place.write("tmp/private-cache-notes", "mine");
    let private = |args: &str| {
        let line = format!("TMPDIR=tmp exec {} {args}", env!("CARGO_BIN_EXE_tailor"));
        place.bash(&line)
    };
    private("run small.toml --private --out out").code(0);
    assert!(place.path("out/body.ply").exists());
    assert!(!place.path("cache").exists());
    let left: Vec<_> = fs::read_dir(place.path("tmp")).unwrap().collect();
    assert_eq!(left.len(), 1, "{left:?}");
    place.write("torn.toml", SMALL.replace("synth.solid", "synth.sollid"));
    private("run torn.toml --private").code(2);
    assert_eq!(fs::read_dir(place.path("tmp")).unwrap().count(), 1);
}

#[test]
fn all_that_the_cache_holds_is_for_its_owner_only() {
    let place = Place::new();
    place.write("turn.toml", TURN);
    place.photos("turn", 3);
    place
        .run("run turn.toml --input photos=turn --out out")
        .code(0);
    for path in all(&place.path("cache"))
        .into_iter()
        .chain(all(&place.path("out")))
    {
        let mode = fs::metadata(&path).unwrap().permissions().mode();
        assert_eq!(mode & 0o077, 0, "{}: {mode:o}", path.display());
    }
}

#[test]
fn who_is_measured_is_in_no_key_but_of_what_asks_for_it() {
    let place = Place::new();
    let asks = "goal = [\"tags\", \"person\"]\n[input.photos]\nfiles = [\"*.jpg\", \"capture.toml\"]\n\
        [node.photos]\nstage = \"capture.load\"\nfrom = { files = \"@photos\" }\n\
        [node.tags]\nstage = \"pose.tags\"\nfrom = [\"photos\"]\n\
        [node.person]\nstage = \"capture.person\"\nfrom = { files = \"@photos\" }\n";
    place.write("turn.toml", asks);
    place.photos("anna", 3);
    let became = |more: &str| {
        let line = format!("run turn.toml --input photos=anna --json {more}");
        let run = place.run(&line).code(0).json();
        ["photos", "tags", "person"].map(|name| {
            let nodes = run["nodes"].as_array().unwrap();
            let node = nodes.iter().find(|n| n["node"] == name).unwrap();
            node["status"].as_str().unwrap().to_owned()
        })
    };
    assert_eq!(became(""), ["made", "made", "made"]);
    let sex = "--set person.facts.subject.sex=female";
    assert_eq!(became(sex), ["found", "found", "made"]);
    // The file itself is read again; what it says of a person stays out of the photos.
    place.write("anna/capture.toml", "[subject]\nage_years = 9.5\n");
    assert_eq!(became(""), ["made", "found", "made"]);
    place.write("anna/capture.toml", "[subject]\nage_years = 10.5\n");
    assert_eq!(became(""), ["made", "found", "made"]);
    place.write("anna/capture.toml", "[subject]\nage_years = 1050\n");
    let said = place.run("run turn.toml --input photos=anna").code(1).err;
    assert!(
        said.contains("`subject.age_years` wants a number from 0 to 130"),
        "{said}"
    );
}
