//! The engine's own cost, beside ninja and make on the same graph: `cargo bench --bench engine`.
//!
//! WIDTH chains of ten stages that copy what they read. Each time is that of a whole process; the least of several
//! rounds, in which the tools take turns, since other people use the machine too. `ninja` or `make` is left out where absent.
//! `-- 100 1000 10000 --json FILE` writes what it measured, from which the table in docs/lab/engine.md is made; TMPDIR
//! names the disk.

mod beside;
mod graph;
mod rows;

use rows::{Row, Table};
use shape::Document;
use stage::{Ctx, Files, Stage, Stop, erase};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Instant;
use tailor::engine::{self, Catalog, Options};
use tailor::recipe::{Overrides, open_text};
use tailor::store::{Prefetch, Store};
use tailor::walk::Status;

stage::inputs! {
    /// A file.
    pub struct FromFile {
        /// A file.
        file: Arc<Files>,
    }
}
stage::inputs! {
    /// A document.
    pub struct FromDocument {
        /// A document.
        text: Arc<Document>,
    }
}

stage::params! {
    /// Which copy it is.
    pub struct Which {
        /// Which copy it is: without it, a copy of a copy would be found, not made.
        n: i64 = 0,
    }
}

struct Load;
impl Stage for Load {
    const NAME: &'static str = "bench.load";
    const VERSION: u32 = 1;
    const ABOUT: &'static str = "Reads a file.";
    type Params = ();
    type Input = FromFile;
    type Output = Document;
    fn run(_: &(), input: FromFile, _: &Ctx<'_>) -> Result<Document, Stop> {
        let bytes = input.file.read(&input.file.entries[0])?;
        let media = "text/plain".into();
        Ok(Document { media, bytes })
    }
}

struct Copy;
impl Stage for Copy {
    const NAME: &'static str = "bench.copy";
    const VERSION: u32 = 1;
    const ABOUT: &'static str = "Copies.";
    type Params = Which;
    type Input = FromDocument;
    type Output = Document;
    fn run(_: &Which, input: FromDocument, _: &Ctx<'_>) -> Result<Document, Stop> {
        Ok((*input.text).clone())
    }
}

static CATALOG: Catalog = Catalog {
    program: "bench",
    stages: &[&[&erase::<Load>(), &erase::<Copy>()]],
    pipelines: &[],
    kinds: &[],
    importers: &[],
};

const LENGTH: usize = 10;

/// How many rounds a graph of so many nodes gets: what is short is timed more often.
fn rounds(nodes: usize) -> usize {
    (400_000 / nodes).clamp(10, 200)
}

/// Above so many nodes ninja and make are given the state of a first run, which would take them minutes.
const RUN_FIRST: usize = 10_000;

/// What the child process does: `run` or `plan` in a folder. Prints how many were made and its
/// greatest memory in KiB.
fn child(verb: &str, folder: &Path) {
    // As the front door does it.
    let cache = folder.join("cache");
    let path = folder.join("tailor.toml");
    let ahead = Prefetch::of(&cache, std::fs::metadata(&path).unwrap().len());
    let text = std::fs::read_to_string(path).unwrap();
    let graph = open_text("tailor.toml", &text, &Overrides::default(), &CATALOG);
    let graph = graph.unwrap_or_else(|mistakes| panic!("{mistakes}"));
    drop(text);
    let inputs = graph.inputs.iter();
    let folders: Vec<_> = inputs
        .map(|i| (i.name.clone(), folder.to_owned()))
        .collect();
    let store = Store::open_after(&cache, ahead).unwrap();
    let made = if verb == "plan" {
        let files = engine::inputs(&graph, &folders, &store).unwrap();
        let plan = tailor::plan::plan(&graph, &files, &graph.goal, &store);
        std::mem::forget((files, store));
        plan.len()
    } else {
        let (threads, keep_going) = (None, false);
        let options = Options {
            cache,
            threads,
            keep_going,
        };
        let (goal, cancel) = (&graph.goal, AtomicBool::new(false));
        let outcome = engine::run_in(store, &graph, &folders, goal, &options, &(), &cancel);
        let outcome = outcome.unwrap_or_else(|error| panic!("{error}"));
        let made = |d: &&tailor::walk::Done| d.status == Status::Executed;
        let made = outcome.nodes.iter().flatten().filter(made).count();
        // As a front door would: nobody waits for memory to be given back.
        std::mem::forget(outcome);
        made
    };
    std::mem::forget(graph);
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let peak = status.lines().find_map(|l| l.strip_prefix("VmHWM:"));
    println!(
        "{made} {}",
        peak.unwrap_or("0 kB").trim().trim_end_matches(" kB")
    );
}

/// Runs a command; how long it took, and what it printed. \[s\]
fn time(command: &mut Command) -> (f64, String) {
    let start = Instant::now();
    let out = command.stderr(Stdio::inherit()).output().unwrap();
    let seconds = start.elapsed().as_secs_f64();
    assert!(out.status.success(), "{command:?}");
    (seconds, String::from_utf8_lossy(&out.stdout).into_owned())
}

/// Our own process in a folder: how long it took \[s\], how many were made, its greatest memory \[KiB\].
fn ours(verb: &str, folder: &Path) -> (f64, usize, usize) {
    let mut command = Command::new(std::env::current_exe().unwrap());
    let (seconds, printed) = time(command.args(["--child", verb]).arg(folder));
    let mut words = printed.split_whitespace().map(|w| w.parse().unwrap());
    (seconds, words.next().unwrap(), words.next().unwrap())
}

/// All tools on a graph, each in a folder of its own.
fn bench(width: usize, table: &mut Table) {
    let place = tempfile::tempdir().unwrap();
    let nodes = width * LENGTH;
    let mut rows = Vec::new();
    for tool in ["tailor", "ninja", "make"] {
        let folder = place.path().join(tool);
        if tool != "tailor" && Command::new(tool).arg("--version").output().is_err() {
            println!("{tool} is absent");
            continue;
        }
        std::fs::create_dir(&folder).unwrap();
        graph::write(&folder, width);
        let first = first(tool, &folder, width);
        rows.push((Row::new(tool, nodes, first), folder));
    }
    // What changed within a second of the index being written is looked at once more.
    std::thread::sleep(std::time::Duration::from_millis(2100));
    ours("run", &place.path().join("tailor"));
    for _ in 0..rounds(nodes) {
        for (row, folder) in &mut rows {
            let (seconds, kib) = again(&row.tool, folder, 0);
            row.nothing(seconds);
            if row.tool == "tailor" {
                row.memory(kib);
                row.plan(ours("plan", folder).0);
            }
        }
    }
    for n in 0..rounds(nodes) / 8 + 2 {
        for (row, folder) in &mut rows {
            std::fs::write(folder.join("0.txt"), format!("change {n}\n")).unwrap();
            row.one(again(&row.tool, folder, LENGTH).0);
        }
    }
    for (row, _) in rows {
        row.print();
        table.rows.push(row);
    }
}

/// A first run, or what one would leave. How long it took. \[s\]
fn first(tool: &str, folder: &Path, width: usize) -> Option<f64> {
    let nodes = width * LENGTH;
    let took = match tool {
        "tailor" => {
            let (seconds, made, _) = ours("run", folder);
            assert_eq!(made, nodes);
            return Some(seconds);
        }
        _ if nodes > RUN_FIRST => {
            beside::pretend(folder, width);
            None
        }
        _ => Some(beside::run(tool, folder).0),
    };
    beside::assert_done(tool, folder);
    took
}

/// One more run: how long it took \[s\], and our greatest memory \[KiB\].
fn again(tool: &str, folder: &Path, made: usize) -> (f64, usize) {
    match tool {
        "tailor" => {
            let (seconds, really, kib) = ours("run", folder);
            assert_eq!(really, made);
            (seconds, kib)
        }
        _ => (beside::run(tool, folder).0, 0),
    }
}

fn main() {
    let args: Vec<String> = std::env::args().collect();
    if let Some(at) = args.iter().position(|a| a == "--child") {
        return child(&args[at + 1], &PathBuf::from(&args[at + 2]));
    }
    let json = args.iter().position(|a| a == "--json");
    let widths = args.iter().filter_map(|a| a.parse::<usize>().ok());
    let mut widths: Vec<usize> = widths.collect();
    if widths.is_empty() {
        widths = vec![100, 1000];
    }
    let mut table = Table::new();
    widths.into_iter().for_each(|w| bench(w, &mut table));
    if let Some(at) = json {
        table.write(Path::new(&args[at + 1]));
    }
}
