//! What the columns of a sweep may be: everything of a girth, of a node, of a truth; and what is no table.

use super::methods::Place;
use serde_json::Value;

/// Girths of a body given by formula, without photos: a second for a point.
const GIRTHS: &str = r#"goal = "girths"
[node.solid]
stage = "synth.solid"
[node.body]
stage = "synth.body"
from = ["solid"]
with = { cell_mm = 14.0 }
[node.ring]
stage = "synth.ring"
[node.features]
stage = "measure.body"
from = { mesh = "body", cameras = "ring" }

[node.landmarks]
stage = "measure.landmarks"
from = { mesh = "body", features = "features" }
[node.girths]
stage = "measure.girths"
from = { mesh = "body", features = "features", landmarks = "landmarks", cameras = "ring" }
[variant.tall]
with.solid = { stature_mm = 1900.0 }
[variant.small]
with.solid = { stature_mm = 1600.0 }
[sweep.figures]
over.solid = { figure = ["body", "cylinder"] }
tell = ["girths.WC", "girths.WC.contour", "girths.WC.interval.lo", "girths.WC.interval.hi", "girths.WC.width", "girths.WC.sigma.surface", "girths.WC.sigma.level", "girths.WC.refused", "girths.TC_L.refused", "girths.stature", "girths.seconds", "girths.processor", "girths.memory", "girths.bytes"]
"#;

/// What comes of a command, out of what it printed.
fn json(printed: &str) -> Value {
    serde_json::from_str(&printed[printed.find("\n{").map_or(0, |at| at + 1)..])
        .unwrap_or_else(|e| panic!("{e}: {printed}"))
}

/// A number of a point.
fn number(sweep: &Value, point: usize, name: &str) -> Option<f64> {
    let metrics = sweep["points"][point]["metrics"].as_array().unwrap();
    let metric = metrics.iter().find(|m| m["name"] == name);
    metric.unwrap_or_else(|| panic!("no {name}"))["value"].as_f64()
}

#[test]
fn a_girth_has_its_interval_its_parts_and_whether_it_was_refused() {
    let place = Place::new();
    place.write("girths.toml", GIRTHS);
    let printed = place.tailor("sweep girths.toml figures --out out", 0);
    assert!(
        printed.contains("at 1 of 2 points: the"),
        "a number that half of the points have: {printed}"
    );
    let sweep: Value = serde_json::from_str(&place.read("out/sweep.json")).unwrap();
    let body = |name: &str| number(&sweep, 0, name).unwrap_or_else(|| panic!("no {name}"));
    let (low, tape, high) = (
        body("girths.WC.interval.lo"),
        body("girths.WC"),
        body("girths.WC.interval.hi"),
    );
    assert!(
        60.0 < low && low < tape && tape < high && high < 90.0,
        "{low} {tape} {high}"
    );
    proof::near(body("girths.WC.width"), high - low, 1e-9);
    assert!(
        body("girths.WC.contour") >= tape,
        "a tape goes the shorter way"
    );
    let parts = ["girths.WC.sigma.surface", "girths.WC.sigma.level"];
    for part in parts {
        assert!((0.001..3.0).contains(&body(part)), "{part} {}", body(part));
    }
    assert!((170.0..180.0).contains(&body("girths.stature")));
    // A cylinder has no waist: refused, and so in no mean.
    for (name, at_body, at_cylinder) in [
        ("girths.WC.refused", 0.0, Some(1.0)),
        ("girths.TC_L.refused", 0.0, Some(1.0)),
    ] {
        assert_eq!(body(name), at_body, "{name}");
        assert_eq!(number(&sweep, 1, name), at_cylinder, "{name}");
    }
    assert_eq!(number(&sweep, 1, "girths.WC"), None);
    let csv = place.read("out/sweep.csv");
    let head = csv.lines().next().unwrap();
    assert!(
        head.starts_with("solid.figure,girths.WC cm tape,girths.WC.contour cm,"),
        "{head}"
    );
    assert!(
        csv.lines().nth(2).unwrap().starts_with("cylinder,,,,"),
        "{csv}"
    );
}

#[test]
fn a_node_has_time_processor_memory_and_size_found_or_made() {
    let place = Place::new();
    place.write("girths.toml", GIRTHS);
    let words = "sweep girths.toml --sweep solid.stout=0.9 --tell girths.seconds,girths.processor,girths.memory,girths.bytes --json";
    let made = json(&place.tailor(words, 0));
    let found = json(&place.tailor(words, 0));
    assert_eq!(
        (&made["points"][0]["made"], &found["points"][0]["made"]),
        (&6.into(), &0.into())
    );
    assert_eq!(made["points"][0]["metrics"], found["points"][0]["metrics"]);
    let of = |name: &str| number(&found, 0, name);
    assert!(of("girths.seconds") > Some(0.0) && of("girths.bytes") > Some(100.0));
    if cfg!(target_os = "linux") {
        let (processor, memory) = (
            of("girths.processor").unwrap(),
            of("girths.memory").unwrap(),
        );
        assert!((0.0..60.0).contains(&processor), "{processor}");
        assert!((1e6..1e11).contains(&memory), "{memory}");
    }
    // It is no metric of the result itself.
    let run = place.tailor("run girths.toml --set solid.stout=0.9 --json", 0);
    assert!(!run.contains("engine processor"), "{run}");
}

#[test]
fn errors_are_beside_and_a_truth_that_is_none_is_refused() {
    let place = Place::new();
    place.write("girths.toml", GIRTHS);
    let truth = concat!(env!("CARGO_MANIFEST_DIR"), "/samples/person/truth");
    // Girths alone: without a surface nothing is aligned.
    std::fs::create_dir(place.path("truth")).unwrap();
    let girths = std::fs::read_to_string(format!("{truth}/measurements.json")).unwrap();
    place.write("truth/measurements.json", &girths);
    let sweep = "sweep girths.toml --sweep solid.stout=0.8,0.9 --tell girths.WC,error.WC,error.HC";
    let printed = place.tailor(&format!("{sweep} --truth truth --out out"), 0);
    assert!(printed.contains("error.WC mm tape"), "{printed}");
    // A girth is drawn with its own interval, which is no column unless asked for.
    let drawn = place.read("out/plots/girths.WC-over-solid.stout.csv");
    let ends = drawn.lines().filter(|l| l.starts_with(",0.")).map(|l| {
        let cells: Vec<f64> = l.split(',').skip(2).map(|c| c.parse().unwrap()).collect();
        cells[1] < cells[0] && cells[0] < cells[2]
    });
    assert_eq!(ends.collect::<Vec<_>>(), [true, true], "{drawn}");
    assert!(!place.read("out/sweep.csv").contains("interval"));
    assert!(
        printed.contains("none of 4 errors is within its limits: is truth the truth of this body?"),
        "{printed}"
    );
    let printed = place.tailor(&format!("{sweep} --truth nowhere"), 2);
    assert!(
        printed.contains("--truth nowhere: there is no such folder"),
        "{printed}"
    );
    let printed = place.tailor(&format!("{sweep} --truth studies"), 1);
    assert!(
        printed.contains("studies has no truth: none of cameras.json, measurements.json, mesh.ply"),
        "{printed}"
    );
}

#[test]
fn axes_that_exclude_each_other_are_refused_before_anything_runs() {
    let place = Place::new();
    place.write("girths.toml", GIRTHS);
    let shared = GIRTHS
        .replacen("goal", "params = { cell_mm = 14.0 }\ngoal", 1)
        .replace(
            "with = { cell_mm = 14.0 }",
            "with = { cell_mm = \"$cell_mm\" }",
        )
        + "[node.finer]\nstage = \"synth.body\"\nfrom = [\"solid\"]\nwith = { cell_mm = \"$cell_mm\" }\n";
    place.write(
        "shared.toml",
        &shared.replace("goal = \"girths\"", "goal = [\"girths\", \"finer\"]"),
    );
    for (words, answer) in [
        (
            "sweep girths.toml --sweep body.cell_mm=20,30 --nodes solid",
            "`body.cell_mm` changes nothing that is wanted",
        ),
        (
            "sweep shared.toml --sweep params.cell_mm=20,30 --sweep body.cell_mm=15,25 --nodes body",
            "`params.cell_mm` changes nothing where `body.cell_mm` varies, which takes its place",
        ),
        (
            "sweep girths.toml --sweep solid.stout=0.8,0.9 --sweep solid.stout=1.1",
            "`solid.stout` is in two --sweep",
        ),
    ] {
        let printed = place.tailor(words, 2);
        assert!(printed.contains(answer), "{words}: {printed}");
    }
    let both = "[sweep.both]\nover.solid = { stature_mm = [1700.0, 1800.0] }\nwith = [\"tall\", \"small\"]\n";
    place.write("both.toml", &format!("{GIRTHS}{both}"));
    let printed = place.tailor("sweep both.toml both", 2);
    assert!(
        printed.contains("the variants `tall` and `small` make the same of every point"),
        "{printed}"
    );
    assert_eq!(tailor::engine::runs(&place.path("cache")).count(), 0);
    // Together they are no mistake where both reach something.
    place.tailor(
        "sweep shared.toml --sweep params.cell_mm=30,35 --sweep body.cell_mm=20,25 --nodes body,finer",
        0,
    );
}

#[test]
fn each_point_leads_to_its_pictures_its_records_and_its_results() {
    let place = Place::new();
    let sweep = "sweep studies/hulls.toml hulls --out out";
    let printed = place.tailor(&format!("{sweep} --show hull,masks,ring:svg"), 0);
    assert!(printed.contains("12 points"), "{printed}");
    let page = place.read("out/sweep.html");
    // A dot leads to a group, a group to its points, a point to what is behind it.
    assert!(page.contains("<a href=\"#points-0\"><circle"), "{page}");
    assert!(page.contains("<a href=\"#all-11\">3</a>"), "{page}");
    let links: Vec<&str> = page
        .split("<a href=\"")
        .skip(1)
        .map(|rest| &rest[..rest.find('"').unwrap()])
        .collect();
    let below: Vec<&&str> = links.iter().filter(|l| l.starts_with("points/")).collect();
    // Hull, masks and a drawing of each of twelve points.
    assert_eq!(below.len(), 3 * 12);
    for link in below {
        assert!(place.path(&format!("out/{link}")).is_file(), "{link}");
    }
    let files = std::fs::read_dir(place.path("out/points")).unwrap().count();
    assert!(
        (12..3 * 12).contains(&files),
        "equal results are one file: {files}"
    );
    let kept: Vec<&&str> = links.iter().filter(|l| l.starts_with("file://")).collect();
    assert!(kept.len() >= 2 * 6 * 12, "{}", kept.len());
    let record = kept.iter().find(|l| l.contains("/ac/")).unwrap();
    let record = std::fs::read_to_string(&record["file://".len()..]).unwrap();
    assert!(record.contains("\"provenance\""), "{record}");
    for (more, answer) in [
        ("--show huls", "did you mean `hull`"),
        ("--show hull:plx", "did you mean `ply`"),
    ] {
        let printed = place.tailor(&format!("{sweep} {more}"), 2);
        assert!(printed.contains(answer), "{more}: {printed}");
    }
    let printed = place.tailor("sweep studies/hulls.toml hulls --show hull", 2);
    assert!(printed.contains("--out"), "{printed}");
}
