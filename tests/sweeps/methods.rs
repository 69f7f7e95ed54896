//! A bench for methods: replicates, comparisons of them, searches and studies by the program itself.

use serde_json::Value;

/// A hull of a cylinder out of silhouettes whose borders err: seconds for a point.
const HULLS: &str = r#"goal = "hull"
[node.solid]
stage = "synth.solid"
with = { figure = "cylinder", stature_mm = 300.0, wide_mm = 90.0, deep_mm = 70.0 }
[node.body]
stage = "synth.body"
from = ["solid"]
with = { cell_mm = 15.0 }
[node.ring]
stage = "synth.ring"
with = { views = 6, width = 48, height = 64, distance_mm = 900.0, camera_mm = 300.0, look_mm = 150.0, disk_mm = 150.0 }
[node.masks]
stage = "synth.masks"
from = { mesh = "body", cameras = "ring" }
with = { rays = 1 }
[node.seen]
stage = "synth.jitter"
from = ["masks"]
with = { border_px = 0.2, length_px = 8.0 }
[node.hull]
stage = "hull.carve"
from = { masks = "seen", cameras = "ring" }
with = { voxel_mm = 12.0 }
[variant.worse]
with.seen = { border_px = 2.0 }
[sweep.hulls]
about = "What do errors of silhouettes do to a hull?"
over.hull = { voxel_mm = [12.0, 16.0] }
with = ["as_it_is", "worse"]
replicate = 3
tell = "hull.volume"
[variant.as_it_is]
with.seen = { border_px = 0.2 }
[search.wide]
over.solid = { wide_mm = { from = 60.0, to = 100.0 } }
most = "hull.volume"
budget = 3
[search.fine]
over.hull = { voxel_mm = [0.25, 12.0] }
most = "hull.volume"
method = "random"
budget = 4
[search.close]
over.solid = { wide_mm = { from = 60.0, to = 100.0 } }
most = "hull.volume"
method = "narrowing"
budget = 4
replicate = 2
"#;

/// A folder of a user's with a study in it, and the program run there.
pub(crate) struct Place(tempfile::TempDir);

impl Place {
    pub(crate) fn new() -> Place {
        let place = Place(tempfile::tempdir().unwrap());
        std::fs::create_dir(place.0.path().join("studies")).unwrap();
        place.write("studies/hulls.toml", HULLS);
        place
    }

    pub(crate) fn path(&self, name: &str) -> std::path::PathBuf {
        self.0.path().join(name)
    }

    pub(crate) fn write(&self, name: &str, text: &str) {
        std::fs::write(self.0.path().join(name), text).unwrap();
    }

    pub(crate) fn read(&self, name: &str) -> String {
        std::fs::read_to_string(self.0.path().join(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
    }

    #[track_caller]
    pub(crate) fn tailor(&self, words: &str, code: i32) -> String {
        let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_tailor"));
        let command = command.args(words.split(' ')).current_dir(self.0.path());
        let ran = command.env("TAILOR_CACHE", "cache").output().unwrap();
        let text = String::from_utf8([ran.stdout, ran.stderr].concat()).unwrap();
        assert_eq!(ran.status.code(), Some(code), "{words}: {text}");
        text
    }
}

#[test]
fn replicates_are_tabled_compared_and_kept_as_files() {
    let place = Place::new();
    let reported = place.tailor("sweep studies/hulls.toml hulls --out out", 0);
    assert!(
        reported.contains(" ± ") && reported.contains("worse less as_it_is"),
        "{reported}"
    );
    assert!(
        reported.contains("too few"),
        "three pairs are too few for anything: {reported}"
    );
    let sweep: Value = serde_json::from_str(&place.read("out/sweep.json")).unwrap();
    assert_eq!(sweep["points"].as_array().unwrap().len(), 12);
    assert_eq!(sweep["replicates"][0]["metrics"][0]["n"], 3);
    let csv = place.read("out/replicates.csv");
    assert!(
        csv.starts_with(
            "variant,hull.voxel_mm,metric,unit,n,refused,failed,mean,sd,low95,high95\n"
        ),
        "{csv}"
    );
    assert_eq!(csv.lines().count(), 5);
    assert!(
        place
            .read("out/paired.csv")
            .contains("as_it_is,worse,12.0,hull.volume,")
    );
    let plot = place.read("out/plots/hull.volume-over-hull.voxel_mm.svg");
    assert!(
        plot.starts_with("<svg xmlns") && plot.matches("<circle").count() == 4,
        "{plot}"
    );
    assert!(
        place
            .read("out/plots/hull.volume-over-hull.voxel_mm.csv")
            .contains("variant = worse,16.0,")
    );
}

#[test]
fn a_replicate_is_found_by_the_point_alone_and_files_are_the_same_again() {
    let place = Place::new();
    place.tailor("sweep studies/hulls.toml hulls --out out", 0);
    let sweep: Value = serde_json::from_str(&place.read("out/sweep.json")).unwrap();
    // The first replicate is the point by itself: found, with equal bytes.
    let single = place.tailor(
        "sweep studies/hulls.toml --sweep hull.voxel_mm=12,16 --tell hull.volume --json",
        0,
    );
    let single: Value = serde_json::from_str(&single[single.find('{').unwrap()..]).unwrap();
    let value = |sweep: &Value, at: usize| sweep["points"][at]["metrics"][0]["value"].clone();
    assert_eq!(value(&single, 0), value(&sweep, 0));
    assert!(
        single["points"]
            .as_array()
            .unwrap()
            .iter()
            .all(|p| p["made"] == 0),
        "{single}"
    );
    // Again: the same bytes of what hangs on results alone.
    place.tailor("sweep studies/hulls.toml hulls --out again", 0);
    for file in [
        "replicates.csv",
        "paired.csv",
        "plots/hull.volume-over-hull.voxel_mm.svg",
    ] {
        assert_eq!(
            place.read(&format!("again/{file}")),
            place.read(&format!("out/{file}")),
            "{file}"
        );
    }
}

#[test]
fn compare_tests_variants_and_folders_pair_by_pair() {
    let place = Place::new();
    let pairs =
        "compare studies/hulls.toml as-is seen.border_px=2.0 --replicate 6 --tell hull.volume";
    let reported = place.tailor(&format!("{pairs} --json --out pairs"), 0);
    let reported: Value = serde_json::from_str(&reported).unwrap();
    let pair = &reported["paired"][0]["pairs"][0];
    assert_eq!(
        (pair["n"].as_u64(), pair["exact"].as_bool()),
        (Some(6), Some(true))
    );
    assert!(
        pair["effect"].as_f64().unwrap() < 0.0,
        "errors cut the hull: {pair}"
    );
    assert_eq!(pair["p"], 2.0 / 64.0, "{pair}");
    assert_eq!(pair["differ"], true);
    assert!(
        place
            .read("pairs/compare.html")
            .contains("seen.border_px=2.0 less as-is")
    );
    place.tailor(
        "sweep studies/hulls.toml --replicate 2 --tell hull.volume --out a",
        0,
    );
    place.tailor(
        "sweep studies/hulls.toml --replicate 3 --variant worse --tell hull.volume --out b",
        0,
    );
    let reported = place.tailor("compare a b", 0);
    assert!(
        reported.contains("b less a") && reported.contains("hull.volume"),
        "{reported}"
    );
    let printed = place.tailor("compare a b --replicate 3", 2);
    assert!(printed.contains("name their pipeline first"), "{printed}");
    let printed = place.tailor("sweep studies/hulls.toml --nodes solid --replicate 3", 2);
    assert!(
        printed.contains("all replicates would be the same")
            && printed.contains("synth.jitter.seed"),
        "{printed}"
    );
    let printed = place.tailor(
        "sweep studies/hulls.toml --sweep seen.seed=1,2 --replicate 3",
        2,
    );
    assert!(
        printed.contains("varies by itself and by `replicate`"),
        "{printed}"
    );
}

#[test]
fn a_study_keeps_its_table_and_tells_what_moved() {
    let place = Place::new();
    let printed = place.tailor("study run all --out lab --check", 2);
    assert!(printed.contains("no earlier data"), "{printed}");
    let reported = place.tailor("study run all --out lab --quiet", 0);
    assert_eq!(reported, "1 study: nothing moved\n");
    let (page, data) = (place.read("lab/hulls.md"), place.read("lab/hulls.json"));
    assert!(
        page.starts_with("# What do errors of silhouettes do to a hull?\n")
            && page.contains("| worse | 12.0 | "),
        "{page}"
    );
    assert!(
        !data.contains("seconds"),
        "what hangs on the machine is none of it"
    );
    assert_eq!(
        place.tailor("study run hulls --out lab --check --quiet", 0),
        "1 study: nothing moved\n"
    );
    assert_eq!(place.read("lab/hulls.json"), data);
    place.write(
        "studies/hulls.toml",
        &HULLS.replace("stature_mm = 300.0", "stature_mm = 310.0"),
    );
    let reported = place.tailor("study run all --out lab --check --quiet", 1);
    assert!(
        reported.contains("hulls: as_it_is hull.voxel_mm=12.0 hull.volume: ")
            && reported.contains("4 numbers moved"),
        "{reported}"
    );
    assert_eq!(place.read("lab/hulls.json"), data, "--check writes nothing");
    let listed = place.tailor("study ls", 0);
    assert_eq!(
        listed,
        "hulls  What do errors of silhouettes do to a hull?\n"
    );
    let printed = place.tailor("study run hull", 2);
    assert!(printed.contains("did you mean `hulls`"), "{printed}");
    place.write("studies/other.toml", HULLS);
    let printed = place.tailor("study run other --out lab", 2);
    assert!(printed.contains("[sweep.other]"), "{printed}");
}
