//! When work is done and when not: what ran, on a chain clean → mid → final.

use shape::Document;
use stage::{AnyStage, Ctx, Files, Stage, Stop, erase};
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;
use std::sync::{Arc, Mutex};
use tailor::engine::{self, Options};
use tailor::graph::Graph;
use tailor::recipe::{Overrides, open_text};
use tailor::store::{Store, keeper};
use tailor::walk::{Done, Fate, Watch};

stage::inputs! {
    /// Files.
    pub struct FromFiles {
        /// Files.
        files: Arc<Files>,
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
    /// A number.
    pub struct Number {
        /// A number.
        n: i64 = 1,
    }
}

fn document(text: String) -> Document {
    Document {
        media: "text/plain".into(),
        bytes: text.into_bytes(),
    }
}

/// Takes comments (lines with #) out of all files.
struct Clean;
impl Stage for Clean {
    const NAME: &'static str = "toy.clean";
    const VERSION: u32 = 1;
    const ABOUT: &'static str = "Takes comments out.";
    type Params = ();
    type Input = FromFiles;
    type Output = Document;
    fn run(_: &(), input: FromFiles, _: &Ctx<'_>) -> Result<Document, Stop> {
        let mut text = String::new();
        for entry in &input.files.entries {
            let file = String::from_utf8(input.files.read(entry)?)?;
            text.extend(file.lines().filter(|l| !l.starts_with('#')));
        }
        Ok(document(text))
    }
}

/// Adds a number; fails at 13; takes a while, so that two workers could meet.
struct Mid;
impl Stage for Mid {
    const NAME: &'static str = "toy.mid";
    const VERSION: u32 = 1;
    const ABOUT: &'static str = "Adds a number.";
    type Params = Number;
    type Input = FromDocument;
    type Output = Document;
    fn run(p: &Number, input: FromDocument, _: &Ctx<'_>) -> Result<Document, Stop> {
        std::thread::sleep(std::time::Duration::from_millis(30));
        if p.n == 13 {
            return Err(std::io::Error::other("thirteen is not taken").into());
        }
        Ok(document(format!(
            "{} {}",
            String::from_utf8_lossy(&input.text.bytes),
            p.n
        )))
    }
}

fn find(name: &str) -> Option<&'static dyn AnyStage> {
    const STAGES: &[&dyn AnyStage] = &[&erase::<Clean>(), &erase::<Mid>()];
    STAGES.iter().copied().find(|s| s.name() == name)
}

fn chain(n: i64) -> Graph {
    let text = format!(
        "goal = [\"final\", \"other\"]\n[input.src]\nfiles = \"*.txt\"\n\
         [node.clean]\nstage = \"toy.clean\"\nfrom = {{ files = \"@src\" }}\n\
         [node.mid]\nstage = \"toy.mid\"\nfrom = {{ text = \"clean\" }}\nwith = {{ n = {n} }}\n\
         [node.final]\nstage = \"toy.mid\"\nfrom = {{ text = \"mid\" }}\nwith = {{ n = 7 }}\n\
         [node.other]\nstage = \"toy.mid\"\nfrom = {{ text = \"clean\" }}\nwith = {{ n = 8 }}\n"
    );
    open_text("toy.toml", &text, &Overrides::default(), &find).unwrap()
}

/// What was made, in order of names; every node is told once.
#[derive(Default)]
struct Log(Mutex<Vec<(String, Fate)>>);
impl Watch for Log {
    fn done(&self, node: &str, done: &Done) {
        self.0
            .lock()
            .unwrap()
            .push((node.into(), done.fate.clone()));
    }
}

struct Place(tempfile::TempDir);

impl Place {
    fn new(text: &str) -> Place {
        let place = Place(tempfile::tempdir().unwrap());
        std::fs::create_dir(place.src()).unwrap();
        place.write(text);
        place
    }
    fn src(&self) -> PathBuf {
        self.0.path().join("src")
    }
    fn cache(&self) -> PathBuf {
        self.0.path().join("cache")
    }
    fn write(&self, text: &str) {
        std::fs::write(self.src().join("a.txt"), text).unwrap();
    }
    fn run_in(&self, graph: &Graph, cache: &Path, threads: usize) -> Vec<String> {
        let (log, cancel) = (Log::default(), AtomicBool::new(false));
        let options = Options {
            cache: cache.into(),
            threads: Some(threads),
            keep_going: true,
        };
        let folders = [("src".to_owned(), self.src())];
        let outcome = engine::run(graph, &folders, &graph.goal, &options, &log, &cancel).unwrap();
        assert_eq!(outcome.nodes.iter().flatten().count(), graph.nodes.len());
        let mut told = log.0.into_inner().unwrap();
        told.sort_by(|a, b| a.0.cmp(&b.0));
        assert!(
            told.windows(2).all(|w| w[0].0 != w[1].0),
            "a node ran twice: {told:?}"
        );
        told.into_iter()
            .filter(|(_, fate)| *fate == Fate::Made)
            .map(|(name, _)| name)
            .collect()
    }
    fn run(&self, n: i64) -> Vec<String> {
        self.run_in(&chain(n), &self.cache(), 2)
    }
    fn blobs(&self) -> Vec<PathBuf> {
        let inner = |d: PathBuf| std::fs::read_dir(d).unwrap().map(|e| e.unwrap().path());
        let mut all: Vec<_> = inner(self.cache().join("cas")).flat_map(inner).collect();
        all.sort();
        all
    }
}

const ALL: [&str; 4] = ["clean", "final", "mid", "other"];

#[test]
fn all_runs_once_then_nothing() {
    let place = Place::new("hello\n");
    assert_eq!(place.run(1), ALL);
    assert_eq!(place.run(1), Vec::<String>::new());
}

#[test]
fn a_touched_file_reruns_nothing_and_a_comment_reruns_one() {
    let place = Place::new("hello\n");
    place.run(1);
    place.write("hello\n");
    assert_eq!(place.run(1), Vec::<String>::new());
    place.write("# a comment\nhello\n");
    assert_eq!(place.run(1), ["clean"], "equal output stops there");
    place.write("hello\n");
    assert_eq!(place.run(1), Vec::<String>::new(), "revert is a hit");
}

#[test]
fn a_param_reruns_what_lies_downstream_and_back_is_a_hit() {
    let place = Place::new("hello\n");
    place.run(1);
    assert_eq!(place.run(2), ["final", "mid"]);
    assert_eq!(place.run(1), Vec::<String>::new());
}

#[test]
fn a_flipped_byte_is_found_put_aside_and_rebuilt() {
    let place = Place::new("hello\n");
    place.run(1);
    for blob in place.blobs() {
        let mut bytes = std::fs::read(&blob).unwrap();
        let last = bytes.len() - 1;
        bytes[last] ^= 1;
        std::fs::write(&blob, bytes).unwrap();
        assert_eq!(place.run(1).len(), 1, "one is rebuilt");
        assert_eq!(place.run(1), Vec::<String>::new());
    }
    assert!(place.cache().join("quarantine").is_dir());
    assert_eq!(keeper::verify(&Store::open(&place.cache()).unwrap()), 0);
}

#[test]
fn a_lost_blob_or_a_garbled_record_is_a_miss() {
    let place = Place::new("hello\n");
    place.run(1);
    std::fs::remove_file(&place.blobs()[0]).unwrap();
    assert_eq!(place.run(1).len(), 1);
    let inner = |d: PathBuf| std::fs::read_dir(d).unwrap().map(|e| e.unwrap().path());
    let records: Vec<_> = inner(place.cache().join("ac")).flat_map(inner).collect();
    for (i, record) in records.iter().enumerate() {
        let bytes = std::fs::read(record).unwrap();
        std::fs::write(
            record,
            if i % 2 == 0 {
                &bytes[..bytes.len() / 2]
            } else {
                b""
            },
        )
        .unwrap();
    }
    assert_eq!(place.run(1), ALL);
}

#[test]
fn a_moved_store_still_hits() {
    let place = Place::new("hello\n");
    place.run(1);
    let moved = place.0.path().join("elsewhere");
    std::fs::rename(place.cache(), &moved).unwrap();
    assert_eq!(place.run_in(&chain(1), &moved, 1), Vec::<String>::new());
}

#[test]
fn a_failure_is_not_cached_and_others_go_on() {
    let place = Place::new("hello\n");
    for _ in 0..2 {
        let made = place.run(13);
        assert!(!made.contains(&"mid".to_owned()) && !made.contains(&"final".to_owned()));
    }
    assert_eq!(place.run(1), ["final", "mid"]);
}

#[test]
fn a_store_of_another_layout_is_refused() {
    let place = Place::new("hello\n");
    place.run(1);
    std::fs::write(place.cache().join("format"), "tailor store 99\n").unwrap();
    let Err(error) = Store::open(&place.cache()) else {
        panic!("it was opened")
    };
    assert!(
        error
            .to_string()
            .contains("another layout (tailor store 99)"),
        "{error}"
    );
}

#[test]
fn any_number_of_threads_gives_equal_contents() {
    let place = Place::new("hello\n");
    let contents = |threads: usize| {
        let cache = place.0.path().join(format!("cache{threads}"));
        place.run_in(&chain(3), &cache, threads);
        let store = Store::open(&cache).unwrap();
        keeper::list(&store)
            .into_iter()
            .map(|k| (k.key, k.content))
            .collect::<Vec<_>>()
    };
    assert_eq!(contents(1), contents(4));
}
