//! A folder of a user's, and the program run in it.

use crate::{book, small};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::LazyLock;

/// Cheap synthetic stages: four nodes, no input.
pub(crate) const SMALL: &str = "about = \"a doll\"\ngoal = [\"sway\", \"body\"]\n\
    [node.solid]\nstage = \"synth.solid\"\n\
    [node.body]\nstage = \"synth.body\"\nfrom = [\"solid\"]\nwith = { cell_mm = 40.0 }\n\
    [node.ring]\nstage = \"synth.ring\"\n\
    [node.sway]\nstage = \"synth.sway\"\nfrom = { cameras = \"ring\" }\n";

/// A folder with `small.toml`, and a cache in it, or that which tests share.
pub(crate) struct Place(tempfile::TempDir, Option<&'static Path>);

/// A cache of this process's tests, for those that ask the same of photos of the samples: that of the book's commands.
static SHARED: LazyLock<PathBuf> = LazyLock::new(|| book::FOLDER.join("cache"));

/// What the program printed.
pub(crate) struct Printed {
    pub(crate) code: Option<i32>,
    pub(crate) out: String,
    pub(crate) err: String,
}

impl Printed {
    /// Holds it to an exit code.
    #[track_caller]
    pub(crate) fn code(self, code: i32) -> Printed {
        let Printed { out, err, .. } = &self;
        assert_eq!(self.code, Some(code), "{out}{err}");
        assert!(!err.contains("panicked"), "{err}");
        self
    }

    /// The answer in JSON.
    #[track_caller]
    pub(crate) fn json(&self) -> Value {
        let parsed = serde_json::from_str(&self.out);
        parsed.unwrap_or_else(|error| panic!("{error}: {}", self.out))
    }
}

impl Place {
    pub(crate) fn new() -> Place {
        let place = Place(proof::in_memory(), None);
        place.write("small.toml", SMALL);
        place
    }

    /// As [`Place::new`], with the cache that tests share: for answers that hang on no earlier run.
    pub(crate) fn sharing() -> Place {
        let Place(folder, _) = Place::new();
        Place(folder, Some(&SHARED))
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub(crate) fn write(&self, name: &str, bytes: impl AsRef<[u8]>) {
        let path = self.path(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, bytes).unwrap();
    }

    /// A folder with so many photos of the sample, small.
    pub(crate) fn photos(&self, folder: &str, count: usize) {
        for i in 0..count {
            let name = format!("{i:04}.jpg");
            self.write(&format!("{folder}/{name}"), small::photo(&name));
        }
    }

    fn command(&self, args: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_tailor"));
        command.args(args.split_whitespace());
        command
            .current_dir(self.0.path())
            .env("XDG_STATE_HOME", self.path("state"))
            .env("LC_ALL", "C")
            .env_remove("TAILOR_CACHE");
        if let Some(cache) = self.1 {
            command.env("TAILOR_CACHE", cache);
        }
        command
    }

    pub(crate) fn run(&self, args: &str) -> Printed {
        let out = self.command(args).output().unwrap();
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        Printed {
            code: out.status.code(),
            out: text(&out.stdout),
            err: text(&out.stderr),
        }
    }

    /// Under a limit on the size of files, in place of a full disk. \[KiB\]
    pub(crate) fn run_limited(&self, kib: usize, args: &str) -> Printed {
        let exe = env!("CARGO_BIN_EXE_tailor");
        self.bash(&format!("trap '' XFSZ; ulimit -f {kib}; exec {exe} {args}"))
    }

    pub(crate) fn bash(&self, line: &str) -> Printed {
        let mut bash = Command::new("bash");
        bash.env("XDG_STATE_HOME", self.path("state"));
        bash.env("LC_ALL", "C");
        if let Some(cache) = self.1 {
            bash.env("TAILOR_CACHE", cache);
        }
        let out = bash.args(["-c", line]).current_dir(self.0.path());
        let out = out.output().unwrap();
        Printed {
            code: out.status.code(),
            out: String::from_utf8_lossy(&out.stdout).into_owned(),
            err: String::from_utf8_lossy(&out.stderr).into_owned(),
        }
    }

    /// With one of its outputs into a device that takes nothing.
    pub(crate) fn run_into_full(&self, output: &str, args: &str) -> Printed {
        self.bash(&format!(
            "exec {} {args} {output}>/dev/full",
            env!("CARGO_BIN_EXE_tailor")
        ))
    }

    pub(crate) fn start(&self, args: &str) -> Child {
        let mut command = self.command(args);
        let command = command.stdout(Stdio::null()).stderr(Stdio::piped());
        command.spawn().unwrap()
    }

    /// The event logs of all runs, one JSON object a line.
    pub(crate) fn events(&self) -> Vec<Value> {
        let runs = std::fs::read_dir(self.path("cache/runs"));
        let mut logs: Vec<PathBuf> = runs
            .into_iter()
            .flatten()
            .map(|e| e.unwrap().path())
            .filter(|p| p.extension().is_some_and(|e| e == "jsonl"))
            .collect();
        logs.sort();
        let text: String = logs
            .iter()
            .filter_map(|log| std::fs::read_to_string(log).ok())
            .collect();
        let whole = text.lines().filter_map(|l| serde_json::from_str(l).ok());
        whole.collect()
    }

    /// Waits for an event of a node.
    pub(crate) fn wait_for(&self, node: &str, event: &str) {
        let there = |e: &Value| e["node"] == node && e["event"] == event;
        while !self.events().iter().any(there) {
            std::thread::sleep(std::time::Duration::from_millis(2));
        }
    }

    /// Events of a node.
    pub(crate) fn has(&self, node: &str, event: &str, status: &str) -> bool {
        let fits = |e: &Value| e["node"] == node && e["event"] == event && e["status"] == status;
        self.events().iter().any(fits)
    }

    /// Whether the whole store is sound.
    #[track_caller]
    pub(crate) fn sound(&self) {
        let answer = self.run("cache verify --json").code(0).json();
        assert_eq!(answer["bad"], 0, "{answer}");
    }
}

/// Sends a signal such as `INT`.
pub(crate) fn signal(child: &Child, name: &str) {
    // A builtin of the shell: the program of that name is not everywhere.
    let line = format!("kill -{name} {}", child.id());
    let kill = Command::new("bash").args(["-c", &line]).status();
    assert!(kill.unwrap().success());
}
