//! The whole product on a body whose girths are a formula, small, through the engine.

use shape::{Cameras, Document, Photos};
use std::path::Path;
use std::sync::Mutex;
use std::sync::atomic::AtomicBool;
use tailor::engine::{self, Options, Outcome};
use tailor::graph::{Bound, Graph, Source};
use tailor::recipe::{Overrides, Pipeline, open};
use tailor::walk::{Done, Status, Watch};

/// A doll of 60 cm on a disk with a marker mat, twelve photos of a ninth of a megapixel, cut at half their size first.
const SMALL: &[&str] = &[
    "solid.stature_mm=600",
    "true_body.cell_mm=5",
    "ring.views=12",
    "ring.width=300",
    "ring.height=390",
    "ring.distance_mm=1100",
    "ring.camera_mm=560",
    "ring.look_mm=240",
    "ring.disk_mm=300",
    "sway.breast_mm=440",
    "photos.rays=1",
    "aligned.coarse_px=200",
];

fn small(more: &[&str]) -> Graph {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("pipelines/synth.toml");
    let sets = SMALL.iter().chain(more).map(|s| (*s).to_owned()).collect();
    let overrides = Overrides {
        variant: None,
        sets,
    };
    open(&path, &overrides, &tailor::catalog::CATALOG)
        .unwrap_or_else(|mistakes| panic!("{mistakes}"))
}

/// Which nodes were made.
#[derive(Default)]
struct Log(Mutex<Vec<String>>);
impl Watch for Log {
    fn done(&self, node: &str, done: &Done) {
        if done.status == Status::Executed {
            self.0.lock().unwrap().push(node.into());
        }
    }
}

fn run(graph: &Graph, cache: &Path, wanted: &[usize]) -> (Outcome, Vec<String>) {
    let (log, cancel) = (Log::default(), AtomicBool::new(false));
    let options = Options {
        cache: cache.into(),
        threads: None,
        keep_going: false,
    };
    let outcome = engine::run(graph, &[], wanted, &options, &log, &cancel).unwrap();
    assert_eq!(outcome.failure(graph), None);
    (outcome, log.0.into_inner().unwrap())
}

#[test]
fn a_body_given_by_formula_comes_back_from_its_photos() {
    let place = tempfile::tempdir().unwrap();
    let graph = small(&[]);
    let node = |name: &str| graph.node(name).unwrap();
    let (outcome, _) = run(&graph, place.path(), &graph.goal);
    let metrics = &outcome.nodes[node("score")].as_ref().unwrap().metrics;
    let metric = |name: &str| {
        let found = metrics.iter().find(|m| m.name == name);
        found.unwrap_or_else(|| panic!("no metric {name}")).value
    };
    assert_eq!(metric("cameras found"), 12.0);
    assert!(metric("cameras scale error").abs() < 0.3, "{metrics:?}");
    assert!(metric("cameras focal error").abs() < 0.3, "{metrics:?}");
    assert!(metric("masks mean IoU") > 0.96, "{metrics:?}");
    assert!(metric("surface mean distance") < 3.0, "{metrics:?}");
    // Silhouettes alone make no body smaller, and round parts only a little larger.
    for girth in ["WC", "HC"] {
        let error = metric(&format!("girths {girth} error"));
        assert!((-1.5..3.5).contains(&error), "{girth} {error} %");
    }
    // The table has the same.
    let table = outcome.artifact(&graph, node("score")).unwrap();
    let table = table.downcast::<Document>().unwrap();
    let json: serde_json::Value = serde_json::from_slice(&table.bytes).unwrap();
    let rows = json["table"].as_array().unwrap();
    let waist = rows.iter().find(|r| r["name"] == "WC").unwrap();
    let (measured, formula) = (&waist["measured_mm"], &waist["formula_mm"]);
    let share = measured.as_f64().unwrap() / formula.as_f64().unwrap();
    proof::near(100.0 * (share - 1.0), metric("girths WC error"), 0.01);

    // Again, nothing runs; a coarser hull takes no photo anew.
    let (_, made) = run(&graph, place.path(), &graph.goal);
    assert_eq!(made, Vec::<String>::new());
    let coarse = small(&["hull.voxel_mm=6"]);
    let (_, made) = run(&coarse, place.path(), &[coarse.node("hull").unwrap()]);
    assert_eq!(made, ["hull"]);
}

/// Greatest error of a camera's place on its ring, as a share of the ring's radius, after turning
/// and scaling; and that of the focal length.
fn off(found: &Cameras, truth: &Cameras) -> (f64, f64) {
    let turn = synth::turn_between(found, truth);
    let radius = |c: &Cameras| {
        let all = c.views.values().map(|v| v.camera.centre());
        all.map(|p| libm::hypot(p.x, p.y)).sum::<f64>() / c.views.len() as f64
    };
    let (own, real) = (radius(found), radius(truth));
    let place = found.views.join(&truth.views).map(|(_, a, b)| {
        let (a, b) = (turn * a.camera.centre() / own, b.camera.centre() / real);
        libm::hypot(a.x - b.x, a.y - b.y)
    });
    let focal = |c: &Cameras| c.views.values().next().unwrap().camera.lens.focal[0];
    let focal = focal(found) / focal(truth) - 1.0;
    (place.fold(0.0, f64::max), focal)
}

/// What differs between the synthetic turn and the product: photos are made, and nobody is named; nothing else.
const OTHERWISE: [&str; 2] = ["photos", "person"];

#[test]
fn the_synthetic_turn_goes_through_the_very_product() {
    let bound = |name: &str| {
        let pipeline = Pipeline::built_in(name, &tailor::catalog::CATALOG).unwrap();
        pipeline.graph(&Overrides::default()).unwrap()
    };
    let (product, synth) = (bound("body"), bound("synth"));
    let mut compared = 0;
    for node in &product.nodes {
        if OTHERWISE.contains(&node.name.as_str()) {
            continue;
        }
        let same = synth.node(&node.name);
        let same = &synth.nodes[same.unwrap_or_else(|| panic!("no node `{}`", node.name))];
        assert_eq!(same.stage.name(), node.stage.name(), "{}", node.name);
        assert_eq!(same.params.values, node.params.values, "{}", node.name);
        assert_eq!(
            sources(&synth, same),
            sources(&product, node),
            "{}",
            node.name
        );
        compared += 1;
    }
    assert!(compared >= 15, "only {compared} nodes were compared");
}

/// The names of what a node reads, port by port.
fn sources<'a>(graph: &'a Graph, node: &Bound) -> Vec<Option<&'a str>> {
    let name = |source: &Source| match source {
        Source::Node(at) => graph.nodes[*at].name.as_str(),
        Source::Input(at) => graph.inputs[*at].name.as_str(),
    };
    node.from.iter().map(|s| s.as_ref().map(name)).collect()
}

#[test]
fn cameras_come_from_features_alone_though_the_subject_sways() {
    let place = tempfile::tempdir().unwrap();
    // On a grown person: 8 mm at the breast.
    let graph = small(&[
        "photos.mat=false",
        "photos.finest_mm=2",
        "photos.contrast=0.9",
        "ring.views=18",
        "placed.disk=false",
        "sway.sway_mm=2.7",
    ]);
    let [found, truth, placed] = ["calibrated", "ring", "placed"].map(|n| graph.node(n).unwrap());
    let (outcome, _) = run(&graph, place.path(), &[found, truth, placed]);
    // Only masks show the stature that is given: until then nothing contradicts it.
    let placed = outcome.nodes[placed].as_ref().unwrap();
    assert_eq!(placed.warnings, Vec::<stage::Message>::new());
    let cameras = |node| {
        let any = outcome.artifact(&graph, node).unwrap();
        any.downcast::<Cameras>().unwrap()
    };
    let (found, truth) = (cameras(found), cameras(truth));
    assert_eq!(found.views.len(), 18);
    let (place, focal) = off(&found, &truth);
    assert!(place < 0.02, "{place} of the radius");
    assert!(focal.abs() < 0.05, "focal length {focal}");
}

#[test]
fn a_synthetic_turn_leaves_as_a_capture_that_is_read_back() {
    let place = tempfile::tempdir().unwrap();
    let graph = small(&["ring.views=3", "true_body.cell_mm=9"]);
    let node = graph.node("photos").unwrap();
    let (outcome, _) = run(&graph, place.path(), &[node]);
    let artifact = outcome.artifact(&graph, node).unwrap();
    let first = artifact.clone().downcast::<Photos>().unwrap();
    let folder = place.path().join("capture");
    let files = io::files(artifact, "capture", None).unwrap();
    tailor::delivery::write(&folder, &files).unwrap();

    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("pipelines/body.toml");
    let body = open(&path, &Overrides::default(), &tailor::catalog::CATALOG).unwrap();
    let node = body.node("photos").unwrap();
    let (log, cancel) = (Log::default(), AtomicBool::new(false));
    let options = Options {
        cache: place.path().join("cache"),
        threads: None,
        keep_going: false,
    };
    let folders = [("photos".to_owned(), folder)];
    let outcome = engine::run(&body, &folders, &[node], &options, &log, &cancel).unwrap();
    assert_eq!(outcome.failure(&body), None);
    let warnings = &outcome.nodes[node].as_ref().unwrap().warnings;
    assert_eq!(warnings, &Vec::<stage::Message>::new());
    let again = outcome.artifact(&body, node).unwrap();
    let again = again.downcast::<Photos>().unwrap();
    let bytes = |p: &Photos| -> Vec<_> { p.photos.iter().map(|p| p.file.clone()).collect() };
    assert_eq!(bytes(&again), bytes(&first));
    assert_eq!(
        again.plate.as_ref().unwrap().file,
        first.plate.as_ref().unwrap().file
    );
    let (a, b) = (&again.rig, &first.rig);
    assert_eq!((a.mat, a.focal_35mm), (b.mat, b.focal_35mm));
    proof::near(a.step.unwrap(), b.step.unwrap(), 1e-12);
    proof::near(a.stature_mm.unwrap(), b.stature_mm.unwrap(), 1e-9);
    proof::near(
        a.disk_diameter_mm.unwrap(),
        b.disk_diameter_mm.unwrap(),
        1e-9,
    );
}
