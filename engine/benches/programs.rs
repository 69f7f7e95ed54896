//! What the engine adds to programs: `cargo bench -p engine --bench programs`.
//!
//! One node that runs `sh`, made anew each time, beside the same command started alone; and a sweep of
//! 200 points beside `xargs -P2`, without and with the same sandbox. The least and the middle of some: the machine's other work is in both.

// The tests use more of it.
#[allow(dead_code)]
#[path = "../tests/programs/trade.rs"]
mod trade;

use engine::foreign::{Sandbox, sandbox};
use engine::recipe::{Overrides, Pipeline};
use engine::sweep::{self, Points, Sweeping, axes};
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};
use trade::{CATALOG, Nobody, Place};

const TIMES: usize = 60;
const POINTS: usize = 200;

/// The least, and the middle. \[ms\]
fn told(mut times: Vec<Duration>) -> [f64; 2] {
    times.sort_unstable();
    [times[0], times[times.len() / 2]].map(|t| t.as_secs_f64() * 1e3)
}

fn text(more: &str) -> String {
    format!(
        "goal = \"x\"\n[node.x]\nstage = \"exec\"\nout = \"text\"\nwith = {{ n = 0 }}\n\
         command = [\"sh\", \"-c\", 'echo $2 > $1', \"sh\", \"{{out}}\", \"{{with.n}}\"]\n{more}"
    )
}

/// The command alone. \[ms\]
fn alone(place: &Place) -> [f64; 2] {
    let out = place.path("alone.txt");
    let one = |n: usize| {
        let start = Instant::now();
        let mut command = Command::new("sh");
        command
            .args(["-c", "echo $2 > $1", "sh"])
            .arg(&out)
            .arg(n.to_string());
        assert!(
            command
                .stdin(Stdio::null())
                .output()
                .unwrap()
                .status
                .success()
        );
        start.elapsed()
    };
    told((0..TIMES).map(one).collect())
}

/// The node, from opening the pipeline to its record. \[ms\]
fn node(place: &Place) -> [f64; 2] {
    let pipeline = Pipeline::of_text("x.toml", &text(""), &CATALOG).unwrap();
    let one = |n: usize| {
        let start = Instant::now();
        let overrides = Overrides {
            variant: None,
            sets: vec![format!("x.n={n}")],
        };
        let graph = pipeline.graph(&overrides).unwrap();
        place.allow(&graph);
        let outcome = place.run(&graph, &Nobody, &false.into()).unwrap();
        assert!(trade::is_made(&outcome, &graph, "x"));
        start.elapsed()
    };
    told((0..TIMES).map(one).collect())
}

/// All points of a sweep in a new store. \[ms\]
fn points(place: &Place) -> f64 {
    let sweep = format!(
        "[sweep.all]\nover.x = {{ n = {{ from = 1, to = {POINTS}, steps = {POINTS} }} }}\n"
    );
    let pipeline = Pipeline::of_text("x.toml", &text(&sweep), &CATALOG).unwrap();
    let base = pipeline.graph(&Overrides::default()).unwrap();
    place.allow(&base);
    let start = Instant::now();
    let axes = axes::axes(&pipeline.recipe().sweeps[0], "x".as_ref()).unwrap();
    let points = Points::new(&base, vec![None], axes);
    let sweeping = Sweeping {
        open: &|point| {
            let overrides = point.overrides(&Overrides::default());
            pipeline.graph(&overrides).map_err(|m| m.to_string())
        },
        nodes: &[],
        folders: &[],
        options: &place.options(),
        tell: &[],
        errors: None,
        watch: &Nobody,
        cancel: &false.into(),
    };
    let rows = sweep::run(&sweeping, points.iter(), |_| {}).unwrap();
    assert!(rows.len() == POINTS && rows.iter().all(|row| row.made == 1));
    start.elapsed().as_secs_f64() * 1e3
}

/// As many commands by `xargs -P2`, each after some words. \[ms\]
fn xargs(place: &Place, name: &str, before: &dyn Fn(&Path) -> String) -> f64 {
    let folder = place.path(name);
    std::fs::create_dir(&folder).unwrap();
    let start = Instant::now();
    let line = format!(
        "seq {POINTS} | xargs -P2 -I {{}} {} sh -c 'echo $1 > {}/$1' sh {{}}",
        before(&folder),
        folder.display()
    );
    assert!(
        Command::new("sh")
            .args(["-c", &line])
            .status()
            .unwrap()
            .success()
    );
    start.elapsed().as_secs_f64() * 1e3
}

fn main() {
    match sandbox() {
        Sandbox::Bubblewrap(path) => println!("in bubblewrap ({})", path.display()),
        other => println!("{}", other.lacks().unwrap_or_default()),
    }
    let place = Place::new();
    let (alone, node) = (alone(&place), node(&place));
    for (what, alone, node) in [("least", alone[0], node[0]), ("middle", alone[1], node[1])] {
        let more = node - alone;
        println!(
            "{what}: one command alone {alone:.1} ms, as a node {node:.1} ms: {more:.1} ms beside it"
        );
    }
    let (ours, theirs) = (
        points(&Place::new()),
        xargs(&place, "xargs", &|_| "".into()),
    );
    println!(
        "{POINTS} points {ours:.0} ms, xargs -P2 {theirs:.0} ms: {:.1} times",
        ours / theirs
    );
    if let Sandbox::Bubblewrap(path) = sandbox() {
        let boxed = |folder: &Path| {
            let (bwrap, folder) = (path.display(), folder.display());
            format!(
                "{bwrap} --unshare-user --unshare-pid --unshare-ipc --unshare-uts --unshare-net --cap-drop ALL \
                 --new-session --die-with-parent --ro-bind / / --proc /proc --dev /dev \
                 --bind {folder} {folder} --"
            )
        };
        let theirs = xargs(&place, "boxed", &boxed);
        println!(
            "xargs -P2 in such a bubblewrap {theirs:.0} ms: {:.1} times",
            ours / theirs
        );
    }
}
