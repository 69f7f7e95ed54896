//! What the engine adds to programs: `cargo bench -p engine --bench programs`.
//!
//! One node that runs `sh`, made anew each time, beside the same command started alone and in a bare bubblewrap of the
//! same namespaces, all three in turns; and a sweep of 200 points beside `xargs -P2`, without and with that sandbox. The
//! least and the middle of some: the machine's other work is in all.

// The tests use more of it.
#[allow(dead_code)]
#[path = "../tests/programs/application.rs"]
mod application;

use application::{CATALOG, Place};
use engine::recipe::{Overrides, Pipeline};
use engine::sweep::{self, Points, Sweeping, axes};
use programs::{Sandbox, sandbox};
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

const TIMES: usize = 60;
const POINTS: usize = 200;

/// The least, and the middle. \[ms\]
fn reported(mut times: Vec<Duration>) -> [f64; 2] {
    times.sort_unstable();
    [times[0], times[times.len() / 2]].map(|t| t.as_secs_f64() * 1e3)
}

fn text(more: &str) -> String {
    format!(
        "goal = \"x\"\n[node.x]\nstage = \"exec\"\nout = \"text\"\nwith = {{ n = 0 }}\n\
         command = [\"sh\", \"-c\", 'echo $2 > $1', \"sh\", \"{{out}}\", \"{{with.n}}\"]\n{more}"
    )
}

/// The namespaces of a node, and one folder to write to.
const BARE: &str = "--unshare-user --unshare-pid --unshare-ipc --unshare-uts --unshare-net --unshare-cgroup-try \
     --cap-drop ALL --new-session --die-with-parent --ro-bind / / --proc /proc --dev /dev";

/// The command alone, after some words.
fn alone(place: &Place, before: &[String], n: usize) -> Duration {
    let out = place.path("alone.txt");
    let words = ["sh", "-c", "echo $2 > $1", "sh"].map(str::to_owned);
    let mut words = before.iter().chain(&words);
    let start = Instant::now();
    let mut command = Command::new(words.next().unwrap());
    command.args(words).arg(&out).arg(n.to_string());
    let ended = command.stdin(Stdio::null()).output().unwrap();
    assert!(ended.status.success(), "{ended:?}");
    start.elapsed()
}

/// The words of a bare bubblewrap, if there is one.
fn bare(folder: &Path) -> Vec<String> {
    let Sandbox::Bubblewrap(bubblewrap) = sandbox() else {
        return vec![];
    };
    let folder = folder.display();
    let words = format!(
        "{} {BARE} --bind {folder} {folder} --",
        bubblewrap.display()
    );
    words.split_whitespace().map(str::to_owned).collect()
}

/// The command alone, in a bare bubblewrap, and as a node, from opening the pipeline to its record; in turns. \[ms\]
fn single(place: &Place) -> [[f64; 2]; 3] {
    let pipeline = Pipeline::of_text("x.toml", &text(""), &CATALOG).unwrap();
    let bare = bare(&place.path(""));
    let node = |n: usize| {
        let start = Instant::now();
        let overrides = Overrides {
            variant: None,
            sets: vec![format!("x.n={n}")],
        };
        let graph = pipeline.graph(&overrides).unwrap();
        place.allow(&graph);
        let outcome = place.run(&graph, &(), &false.into()).unwrap();
        assert!(application::is_made(&outcome, &graph, "x"));
        start.elapsed()
    };
    let mut times = [vec![], vec![], vec![]];
    for n in 0..TIMES {
        times[0].push(alone(place, &[], n));
        times[1].push(alone(place, &bare, n));
        times[2].push(node(n));
    }
    times.map(reported)
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
        watch: &(),
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
    let [alone, boxed, node] = single(&place);
    for (i, what) in ["least", "middle"].into_iter().enumerate() {
        let (alone, boxed, node) = (alone[i], boxed[i], node[i]);
        let (more, ratio) = (node - alone, node / boxed);
        println!(
            "{what}: one command alone {alone:.1} ms, in a bare bubblewrap {boxed:.1} ms, as a node {node:.1} ms: \
             {more:.1} ms above the command, {ratio:.2} times the bubblewrap"
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
    if let Sandbox::Bubblewrap(_) = sandbox() {
        let theirs = xargs(&place, "boxed", &|folder| bare(folder).join(" "));
        println!(
            "xargs -P2 in such a bubblewrap {theirs:.0} ms: {:.1} times",
            ours / theirs
        );
    }
}
