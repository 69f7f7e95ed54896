//! A folder with a store, and the program run in it.

use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// A store, and the pipeline that makes a body by formula: one solid, one surface a size of cells.
pub(crate) struct Place(tempfile::TempDir);

impl Place {
    pub(crate) fn new() -> Place {
        Place(proof::in_memory())
    }
    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }
    pub(crate) fn cache(&self) -> PathBuf {
        self.path("cache")
    }
    /// The program, in the repository, on this store.
    pub(crate) fn tailor(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_tailor"));
        command.current_dir(env!("CARGO_MANIFEST_DIR"));
        command.args(arguments).arg("--cache").arg(self.cache());
        command.env("XDG_STATE_HOME", self.path("state"));
        command
    }
    pub(crate) fn run(&self, arguments: &[&str]) -> Output {
        self.tailor(arguments).output().unwrap()
    }
    pub(crate) fn json(&self, arguments: &[&str]) -> Value {
        let ran = self.tailor(arguments).arg("--json").output().unwrap();
        let stderr = String::from_utf8_lossy(&ran.stderr);
        serde_json::from_slice(&ran.stdout)
            .unwrap_or_else(|e| panic!("{arguments:?}: {e}: {stderr}"))
    }
    /// The name of the plan of the sweep over these sizes of cells, and how many strands it has.
    pub(crate) fn plan(&self, cells: &str) -> (String, usize) {
        let answer = self.json(&[&SWEEP[..], &[&over(cells), "--strands"]].concat());
        let name = answer["plan"]
            .as_str()
            .unwrap_or_else(|| panic!("{answer}"));
        (
            name.to_owned(),
            answer["strands"].as_u64().unwrap() as usize,
        )
    }
    /// How many results were made and found by the sweep itself, here and now.
    pub(crate) fn swept(&self, cells: &str) -> (u64, u64) {
        let answer = self.json(&[&SWEEP[..], &[&over(cells)]].concat());
        let points = answer["points"].as_array().unwrap();
        assert!(points.iter().all(|p| p["done"] == true), "{answer}");
        let sum = |name: &str| points.iter().map(|p| p[name].as_u64().unwrap()).sum();
        (sum("made"), sum("found"))
    }
    /// The names of all results in the store: equal contents have equal names.
    pub(crate) fn contents(&self) -> Vec<String> {
        inside(&self.cache().join("cas"))
    }
    /// How often each node was made, by the event logs of all processes.
    pub(crate) fn made(&self) -> usize {
        let logs = files(&self.cache().join("runs"));
        let logs = logs
            .iter()
            .filter(|f| f.extension().is_some_and(|e| e == "jsonl"));
        let text: String = logs.map(|f| std::fs::read_to_string(f).unwrap()).collect();
        let made = |line: &&str| line.contains("\"event\":\"done\"") && line.contains("\"made\"");
        text.lines().filter(made).count()
    }
}

/// A sweep whose points share one result and have one of their own.
pub(crate) const SWEEP: [&str; 4] = ["sweep", "pipelines/synth.toml", "--nodes", "true_body"];

fn over(cells: &str) -> String {
    format!("--sweep=true_body.cell_mm={cells}")
}

fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten();
    entries.map(|e| e.unwrap().path()).collect()
}

fn inside(shelf: &Path) -> Vec<String> {
    let names = files(shelf).into_iter().flat_map(|inner| files(&inner));
    let mut names: Vec<String> = names
        .map(|f| f.file_name().unwrap().to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}
