//! A first answer comes while the whole is made, its page has a note when the whole does not come, and it is no run.

use super::place::{Place, Printed, signal};
use crate::small;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

/// The sample, with its plate and what is known of it but its name.
fn sample() -> Place {
    let place = Place::new();
    place.photos("turn/images", 18);
    place.write("turn/images/plate.jpg", small::photo("plate.jpg"));
    let facts = std::fs::read_to_string(small::sample().join("capture.toml")).unwrap();
    let facts = facts.replace("name = \"mannequin\"\n", "");
    place.write("turn/capture.toml", facts);
    place
}

/// The cache of a first answer on the sample and what was printed, once for all tests.
static FIRST: LazyLock<(PathBuf, Printed)> = LazyLock::new(|| {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("front-first");
    match std::fs::remove_dir_all(&folder) {
        Err(e) if e.kind() != std::io::ErrorKind::NotFound => panic!("{e}: {folder:?}"),
        _ => (),
    }
    let place = sample();
    let printed = place.run(&format!("measure turn --out out {}", quick()));
    let printed = printed.code(0);
    copy(&place.path("cache"), &folder);
    (folder, printed)
});

/// What a first answer alone takes.
pub(crate) fn quick() -> String {
    format!("--fast {COARSE}")
}

/// What was printed when nothing was there yet.
pub(crate) fn printed() -> &'static Printed {
    &FIRST.1
}

/// The sample in a place whose cache holds the results of [`FIRST`], and of no run a record.
pub(crate) fn begun() -> Place {
    let place = sample();
    std::fs::create_dir(place.path("cache")).unwrap();
    for name in ["format", "origin", "ac", "cas"] {
        copy(&FIRST.0.join(name), &place.path("cache").join(name));
    }
    place
}

/// A file, or a folder with all in it.
fn copy(from: &Path, to: &Path) {
    if from.is_file() {
        std::fs::copy(from, to).unwrap();
        return;
    }
    std::fs::create_dir(to).unwrap();
    for entry in std::fs::read_dir(from).unwrap() {
        let entry = entry.unwrap();
        copy(&entry.path(), &to.join(entry.file_name()));
    }
}

/// Half of the photos, and coarse surfaces after few rounds: a whole measuring within seconds.
const COARSE: &str = "--set photos.of=2 --set photos.keep=1 --set aligned.coarse_px=200 --set labels.rounds=1 \
    --set params.cell_mm=6 --set compensated_coarse.level=2 --set compensated_coarse.rounds=2 --set coarse.level=2 --set coarse.edge_px=8 \
    --set coarse.rounds=1 --set compensated.level=2 --set compensated.rounds=2 --set deformation.level=2 --set deformation.rounds=2 \
    --set middle.level=2 --set middle.edge_px=8 --set middle.rounds=1 --set body.level=2 --set body.edge_px=8 --set body.rounds=1 \
    --set textured.atlas_px=256 --set textured.rounds=0";

/// Nearly as coarse, the hull and all that comes of it made anew.
fn anew() -> String {
    COARSE.replace("params.cell_mm=6", "params.cell_mm=7")
}

/// Hip and waist with their intervals, as a first answer has them. \[cm\]
fn first_girths(printed: &str) -> Vec<[f64; 3]> {
    let from = printed.find(FIRST_ANSWER).expect("no first answer");
    let line = printed[from..].split("first report:").next().unwrap();
    let words = line.split(|c: char| !(c.is_ascii_digit() || c == '.'));
    let numbers: Vec<f64> = words.filter_map(|w| w.parse().ok()).collect();
    let (all, rest) = numbers.as_chunks::<3>();
    assert!(rest.is_empty(), "{line}");
    all.to_vec()
}

/// How the line of a first answer begins.
const FIRST_ANSWER: &str = "first answer, refined below: ";

/// The logs and records of runs.
fn records(place: &Place) -> Vec<String> {
    let runs = std::fs::read_dir(place.path("cache/runs")).unwrap();
    let names = runs.map(|e| e.unwrap().file_name().into_string().unwrap());
    let mut names: Vec<String> = names.collect();
    names.sort();
    names
}

#[test]
fn what_reads_the_last_run_agrees_with_what_measure_wrote() {
    let (place, anew) = (begun(), anew());
    let printed = place.run(&format!("measure turn --out out {anew}"));
    let printed = printed.code(0);
    // Its intervals have what comes of the whole.
    let girths = std::fs::read_to_string(place.path("out/girths.json")).unwrap();
    let girths: serde_json::Value = serde_json::from_str(&girths).unwrap();
    let tape = |name: &str| {
        let mut all = girths["girths"].as_array().unwrap().iter();
        all.find(|g| g["name"] == name).unwrap()["tape_cm"]
            .as_f64()
            .unwrap()
    };
    let first = first_girths(&printed.err);
    assert_eq!(first.len(), 2, "{}", printed.err);
    for (name, [_, low, high]) in ["HC", "WC"].into_iter().zip(first) {
        assert!(
            (low..=high).contains(&tape(name)),
            "{name}: {}",
            printed.err
        );
    }
    let one = records(&place);
    assert!(one.len() == 2 && one[1].ends_with(".jsonl"), "{one:?}");
    let runs = place.run("cache runs --json").code(0).json();
    assert_eq!(runs.as_array().unwrap().len(), 1, "{runs}");
    let agrees = || {
        for (shown, file) in [
            ("girths --as csv", "girths.csv"),
            ("girths", "girths.json"),
            ("girths --as csv --input photos=turn", "girths.csv"),
            ("landmarks", "landmarks.json"),
            ("cameras", "cameras.json"),
            ("report", "report.html"),
            ("body", "body.ply"),
            ("hull", "hull.ply"),
            ("textured", "body.glb"),
        ] {
            place.run(&format!("show {shown} -o shown")).code(0);
            let [shown_now, written] = ["shown".into(), format!("out/{file}")]
                .map(|file: String| std::fs::read(place.path(&file)).unwrap());
            assert!(shown_now == written, "show {shown} is not out/{file}");
        }
        let against = place.run("compare last out").code(0).out;
        assert!(against.contains("the same bytes as last"), "{against}");
    };
    agrees();
    // What `measure` of the same would do is nothing.
    let plan = place.run(&format!("plan measure turn {anew}")).code(0).out;
    assert!(
        !plan.contains(" run ") && plan.ends_with("all cached\n"),
        "{plan}"
    );
    let why = place.run(&format!("why measure turn girths {anew}"));
    assert_eq!(why.code(0).out, "girths: cached, as in the last run\n");
    // What is swept is worth less than the last run.
    place.run("cache gc --max-size 1k").code(0);
    agrees();
    place.run("cache pin keep").code(0);
    place.run("run small.toml").code(0);
    place.run("cache gc --max-size 1k").code(0);
    let against = place.run("compare keep out").code(0).out;
    assert!(against.contains("the same bytes as keep"), "{against}");
    let again = format!("measure turn --out out {anew} --json");
    let again = place.run(&again).code(0).json();
    for node in again["nodes"].as_array().unwrap() {
        assert_eq!(node["status"], "found", "{}", node["node"]);
    }
    place.sound();
    // All that came of the capture goes, what came on the way, too.
    place.run("cache forget turn").code(0);
    let left = place.run("cache ls --json").code(0).json();
    let of_bodies = |stage: &str| !stage.starts_with("synth.");
    for result in left.as_array().unwrap() {
        let stage = result["stage"].as_str().unwrap();
        assert!(!of_bodies(stage), "{stage}");
    }
}

#[test]
fn a_weight_a_name_and_a_day_that_come_later_make_only_girths_and_what_follows_again() {
    let place = begun();
    let line = format!("turn --fast {COARSE} --weight 9 --name Anna --date 2026-05-01");
    let plan = place.run(&format!("plan measure {line} --json"));
    let plan = plan.code(0).json();
    let run = place.run(&format!("measure {line} --out out --json"));
    let run = run.code(0).json();
    let anew = |from: &serde_json::Value, key: &str, found: &str| -> Vec<String> {
        let nodes = from["nodes"].as_array().unwrap().iter();
        let anew = nodes.filter(|n| n[key] != found);
        anew.map(|n| n["node"].as_str().unwrap().to_owned())
            .collect()
    };
    for all in [
        anew(&plan, "state", "cached"),
        anew(&run, "status", "found"),
    ] {
        assert_eq!(all, ["person", "girths", "report"]);
    }
    let girths = std::fs::read_to_string(place.path("out/girths.json")).unwrap();
    assert!(girths.contains("\"weight_kg\": 9.0"), "{girths}");
}

#[test]
fn a_first_answer_whose_whole_is_stopped_has_a_note() {
    let place = begun();
    // The whole must still be under way when its first answer is there: its surface is fine, and takes many rounds.
    let long = anew().replace("body.level=2", "body.level=0");
    let long = long.replace("body.edge_px=8", "body.edge_px=2");
    let long = long.replace("body.rounds=1", "body.rounds=100");
    let mut child = place.start(&format!("measure turn --out out {long}"));
    let mut printed = BufReader::new(child.stderr.take().unwrap())
        .lines()
        .map(Result::unwrap);
    let mut before = printed
        .by_ref()
        .take_while(|l| !l.starts_with("first report:"));
    assert!(
        before.any(|l| l.starts_with(FIRST_ANSWER)),
        "no first answer"
    );
    before.for_each(drop);
    let page = || std::fs::read_to_string(place.path("out/report.html")).unwrap();
    assert!(page().contains("the full one follows"));
    signal(&child, "INT");
    let left: Vec<String> = printed.collect();
    assert_eq!(child.wait().unwrap().code(), Some(130), "{left:?}");
    assert!(page().contains("the full one failed or was stopped"));
    assert!(!place.path("out/girths.csv").exists());
    // Nor is it taken for a result of the run that was stopped.
    let one = records(&place);
    assert!(one.len() == 2 && one[1].ends_with(".jsonl"), "{one:?}");
    let shown = place.run("show girths --as csv").code(2).err;
    assert!(shown.contains("no result of `girths`"), "{shown}");
}
