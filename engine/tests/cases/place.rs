//! A folder with a source and a store, and what a run in it made.

use crate::toys;
use engine::graph::Graph;
use engine::recipe::{Overrides, open_text};
use engine::store::Store;
use engine::walk::{Done, Status, Watch};
use engine::{self, Options, Outcome};
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::AtomicBool;

/// A pipeline of toys that reads `@src`.
pub(crate) fn graph(goal: &[&str], nodes: &str) -> Graph {
    let text = format!("goal = {goal:?}\n[input.src]\nfiles = \"*.txt\"\n{nodes}");
    open_text("toy.toml", &text, &Overrides::default(), &toys::CATALOG).unwrap()
}

/// clean → mid → final, and other beside mid.
pub(crate) fn chain(n: i64) -> Graph {
    let nodes = format!(
        "[node.clean]\nstage = \"toy.clean\"\nfrom = {{ files = \"@src\" }}\n\
         [node.mid]\nstage = \"toy.mid\"\nfrom = {{ text = \"clean\" }}\nwith = {{ n = {n}, sleep_ms = 20 }}\n\
         [node.final]\nstage = \"toy.mid\"\nfrom = {{ text = \"mid\" }}\nwith = {{ n = 7 }}\n\
         [node.other]\nstage = \"toy.mid\"\nfrom = {{ text = \"clean\" }}\nwith = {{ n = 8, sleep_ms = 20 }}\n"
    );
    graph(&["final", "other"], &nodes)
}

/// Every node of [`chain`].
pub(crate) const ALL: [&str; 4] = ["clean", "final", "mid", "other"];

/// Nothing made.
pub(crate) const NONE: [&str; 0] = [];

/// What became of the nodes, as they were reported.
#[derive(Default)]
pub(crate) struct Log(pub(crate) Mutex<Vec<(String, Status)>>);
impl Watch for Log {
    fn done(&self, node: &str, done: &Done) {
        let mut log = self.0.lock().unwrap();
        log.push((node.into(), done.status.clone()));
    }
}

/// A folder with a source and a store.
pub(crate) struct Place(tempfile::TempDir);

impl Place {
    pub(crate) fn new(text: &str) -> Place {
        let place = Place(proof::in_memory());
        std::fs::create_dir(place.src()).unwrap();
        place.write(text);
        place
    }
    pub(crate) fn path(&self) -> &Path {
        self.0.path()
    }
    pub(crate) fn src(&self) -> PathBuf {
        self.path().join("src")
    }
    pub(crate) fn cache(&self) -> PathBuf {
        self.path().join("cache")
    }
    pub(crate) fn store(&self) -> Store {
        Store::open(&self.cache()).unwrap()
    }
    pub(crate) fn write(&self, text: &str) {
        std::fs::write(self.src().join("a.txt"), text).unwrap();
    }
    pub(crate) fn outcome(
        &self,
        graph: &Graph,
        cache: &Path,
        threads: usize,
        watch: &dyn Watch,
    ) -> Outcome {
        let (cancel, threads) = (AtomicBool::new(false), Some(threads));
        let (cache, keep_going) = (cache.into(), true);
        let options = Options {
            cache,
            threads,
            keep_going,
        };
        let folders = [("src".to_owned(), self.src())];
        engine::run(graph, &folders, &graph.goal, &options, watch, &cancel).unwrap()
    }
    /// The names of what was made, sorted. Every node is reported, and once; what was found is reported
    /// once more if its result is lost and must be made for a reader.
    pub(crate) fn run_in(&self, graph: &Graph, cache: &Path, threads: usize) -> Vec<String> {
        let log = Log::default();
        let outcome = self.outcome(graph, cache, threads, &log);
        let reported = log.0.into_inner().unwrap();
        let nodes = graph.nodes.iter().zip(&outcome.nodes);
        for (node, _) in nodes.filter(|(_, done)| done.is_some()) {
            let of_node = reported.iter().filter(|t| t.0 == node.name);
            let statuses: Vec<&Status> = of_node.map(|t| &t.1).collect();
            let again = statuses == [&Status::Hit, &Status::Executed];
            assert!(statuses.len() == 1 || again, "{}: {statuses:?}", node.name);
        }
        let made = reported
            .into_iter()
            .filter(|(_, status)| *status == Status::Executed);
        let mut made: Vec<String> = made.map(|(name, _)| name).collect();
        made.sort();
        made
    }
    /// What a run of [`chain`] makes.
    pub(crate) fn run(&self, n: i64) -> Vec<String> {
        self.run_in(&chain(n), &self.cache(), 2)
    }
    /// The files of a shelf of the store.
    pub(crate) fn shelf(&self, name: &str) -> Vec<PathBuf> {
        let inner = |d: PathBuf| {
            std::fs::read_dir(d)
                .into_iter()
                .flatten()
                .map(|e| e.unwrap().path())
        };
        let mut all: Vec<_> = inner(self.cache().join(name)).flat_map(inner).collect();
        all.sort();
        all
    }
    /// The blob of a node of [`chain`].
    pub(crate) fn blob(&self, n: i64, node: &str) -> PathBuf {
        let graph = chain(n);
        let outcome = self.outcome(&graph, &self.cache(), 1, &Log::default());
        let content = outcome.nodes[graph.node(node).unwrap()]
            .as_ref()
            .unwrap()
            .content
            .unwrap();
        let hex = content.to_hex();
        self.cache().join("cas").join(&hex[..2]).join(hex.as_str())
    }
}
