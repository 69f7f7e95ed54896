//! The engine's own cost, beside ninja and make on the same graph: `cargo bench --bench engine`.
//!
//! WIDTH chains of ten stages that copy what they read. Each time is that of a whole process; the
//! least of several, since others use the machine too. `ninja` or `make` is left out where absent.

use shape::Document;
use stage::{Ctx, Files, Stage, Stop, erase};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Instant;
use tailor::engine::{self, Catalog, Options};
use tailor::recipe::{Overrides, open_text};
use tailor::store::{Prefetch, Store};
use tailor::walk::{Status, Watch};

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
    rooms: &[&[&erase::<Load>(), &erase::<Copy>()]],
    pipelines: &[],
    kinds: &[],
    importers: &[],
};

const LENGTH: usize = 10;

/// How often what is short is timed, and what is longer.
const MANY: usize = 40;
const FEW: usize = 5;

/// The same graph for all three.
fn write_graph(folder: &Path, width: usize) {
    let (mut goal, mut toml) = (Vec::new(), String::new());
    let mut ninja = String::from("rule cat\n  command = cat $in > $out\n");
    let (mut make, mut all) = (String::new(), String::from("all:"));
    for w in 0..width {
        std::fs::write(folder.join(format!("{w}.txt")), format!("source {w}\n")).unwrap();
        let _ = write!(toml, "[input.s{w}]\nfiles = \"{w}.txt\"\n");
        let (mut before, mut from) = (format!("{w}.txt"), format!("file = \"@s{w}\""));
        for l in 0..LENGTH {
            let (name, verb) = (format!("w{w}l{l}"), if l == 0 { "load" } else { "copy" });
            let _ = write!(
                toml,
                "[node.{name}]\nstage = \"bench.{verb}\"\nfrom = {{ {from} }}\n"
            );
            if l > 0 {
                let _ = writeln!(toml, "with = {{ n = {l} }}");
            }
            let _ = writeln!(ninja, "build {name}: cat {before}");
            let _ = write!(make, "{name}: {before}\n\tcat $< > $@\n");
            from = format!("text = \"{name}\"");
            before = name;
        }
        let _ = write!(all, " {before}");
        goal.push(before);
    }
    let write = |name: &str, text: String| std::fs::write(folder.join(name), text).unwrap();
    write("tailor.toml", format!("goal = {goal:?}\n{toml}"));
    write("build.ninja", ninja);
    write("Makefile", format!("{all}\n{make}"));
}

struct Nobody;
impl Watch for Nobody {}

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
        let outcome = engine::run_in(store, &graph, &folders, goal, &options, &Nobody, &cancel);
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

/// Runs a command; how long it took, and what it said. \[s\]
fn time(command: &mut Command) -> (f64, String) {
    let start = Instant::now();
    let out = command.stderr(Stdio::inherit()).output().unwrap();
    let seconds = start.elapsed().as_secs_f64();
    assert!(out.status.success(), "{command:?}");
    (seconds, String::from_utf8_lossy(&out.stdout).into_owned())
}

/// The least time of several. \[s\]
fn least(times: usize, mut once: impl FnMut() -> f64) -> f64 {
    (0..times).map(|_| once()).fold(f64::INFINITY, f64::min)
}

fn bench(width: usize) {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    write_graph(folder, width);
    let nodes = width * LENGTH;
    let ours = |verb: &str| {
        let mut command = Command::new(std::env::current_exe().unwrap());
        let (seconds, said) = time(command.args(["--child", verb]).arg(folder));
        let mut words = said.split_whitespace().map(|w| w.parse::<usize>().unwrap());
        (seconds, words.next().unwrap(), words.next().unwrap())
    };
    let change = |n: usize| std::fs::write(folder.join("0.txt"), format!("change {n}\n")).unwrap();
    let (cold, made, _) = ours("run");
    assert_eq!(made, nodes);
    std::thread::sleep(std::time::Duration::from_millis(2100));
    // Once to verify what was just made and to hash what was just written, then for the clock.
    ours("run");
    let mut peak = 0;
    let idle = least(MANY, || {
        let (seconds, made, kib) = ours("run");
        assert_eq!(made, 0);
        peak = peak.max(kib);
        seconds
    });
    let plan = least(MANY, || ours("plan").0);
    let mut n = 0;
    let one = least(FEW, || {
        n += 1;
        change(n);
        let (seconds, made, _) = ours("run");
        assert_eq!(made, LENGTH);
        seconds
    });
    let row = |tool: &str, [cold, idle, one]: [f64; 3], more: String| {
        let stage = cold * 1e3 / nodes as f64;
        let (idle, one) = (idle * 1e3, one * 1e3);
        println!(
            "| {tool} | {nodes} | {cold:.2} s | {stage:.2} ms | {idle:.1} ms | {one:.1} ms | {more} |"
        );
    };
    let memory = peak as f64 / 1024.0;
    let more = format!("{:.1} ms | {memory:.0} MB", plan * 1e3);
    row("tailor", [cold, idle, one], more);
    for tool in ["ninja", "make"] {
        if Command::new(tool).arg("--version").output().is_err() {
            println!("| {tool} | {nodes} | absent | | | | | |");
            continue;
        }
        let outputs = (0..width).flat_map(|w| (0..LENGTH).map(move |l| format!("w{w}l{l}")));
        outputs.for_each(|o| _ = std::fs::remove_file(folder.join(o)));
        let run = || time(Command::new(tool).args(["-j2"]).current_dir(folder)).0;
        let cold = run();
        let idle = least(MANY, run);
        let one = least(FEW, || {
            n += 1;
            change(n);
            run()
        });
        row(tool, [cold, idle, one], " | ".into());
    }
}

fn main() {
    let args: Vec<String> = std::env::args().collect();
    if let Some(at) = args.iter().position(|a| a == "--child") {
        return child(&args[at + 1], &PathBuf::from(&args[at + 2]));
    }
    println!(
        "| tool | nodes | cold | a stage | nothing to do | one source changed | plan | memory |\n\
         |---|---|---|---|---|---|---|---|"
    );
    let widths = args.iter().filter_map(|a| a.parse::<usize>().ok());
    let widths: Vec<usize> = widths.collect();
    let widths = if widths.is_empty() {
        vec![100, 1000]
    } else {
        widths
    };
    widths.into_iter().for_each(bench);
}
