//! Slurm's own daemons on loopback, and a pipeline of small programs to be made on them.

use super::place::Place;
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::{Duration, Instant};

/// A site, until it is dropped, with a store on it.
pub(crate) struct Site {
    pub(crate) place: Place,
}

/// The first of two ports for the daemons of a site: of this process, and of this site alone.
fn free_ports() -> u32 {
    static SITES: AtomicU32 = AtomicU32::new(0);
    let site = SITES.fetch_add(1, Ordering::Relaxed);
    20_000 + (std::process::id() % 1_000 * 8 + site) * 2
}

fn script() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cluster/slurm.sh")
}

/// base → x: what all points share, and a program a point that fails at 13.
const PIPELINE: &str = r#"goal = "x"
[node.base]
stage = "exec"
out = "document"
with = { b = 0 }
command = ["sh", "-c", "sleep 0.3; echo base $2 > $1/a.txt", "sh", "{out}", "{with.b}"]
[node.x]
stage = "exec"
out = "document"
from = { base = "base" }
with = { n = 0, s = 0 }
command = ["sh", "-c", "sleep $3; test $2 != 13 && cat $4 > $1/a.txt && echo $2 >> $1/a.txt", "sh", "{out}", "{with.n}", "{with.s}", "{from.base}"]
"#;

impl Site {
    /// With so large arrays at most.
    pub(crate) fn new(largest_array: usize) -> Site {
        let place = Place::new();
        std::fs::write(place.path("x.toml"), PIPELINE).unwrap();
        let site = Site { place };
        let port = free_ports();
        let started = Command::new(script())
            .arg("start")
            .arg(site.place.path("slurm"))
            .arg(port.to_string())
            .env("MAX_ARRAY_SIZE", largest_array.to_string())
            .stdin(Stdio::null())
            .status();
        assert!(started.unwrap().success(), "Slurm did not start");
        site
    }

    /// A command that asks this site.
    pub(crate) fn on(&self, mut command: Command) -> Command {
        let conf = self.place.path("slurm").join("slurm.conf");
        command.env("SLURM_CONF", conf);
        command
    }

    /// The program on this site.
    pub(crate) fn tailor(&self, arguments: &[&str]) -> Command {
        self.on(self.place.tailor(arguments))
    }

    /// Its exit code, whatever it is, and both outputs.
    pub(crate) fn output(&self, arguments: &[&str]) -> (Option<i32>, String) {
        let ran = self.tailor(arguments).output().unwrap();
        let text = [ran.stdout, ran.stderr].concat();
        (
            ran.status.code(),
            String::from_utf8_lossy(&text).into_owned(),
        )
    }

    /// The plan of a sweep over `x.n` with other params set.
    pub(crate) fn plan(&self, over: &str, sets: &[&str]) -> String {
        let answer = self.sweep(over, sets, &["--strands", "--allow-exec"]);
        answer["plan"]
            .as_str()
            .unwrap_or_else(|| panic!("{answer}"))
            .to_owned()
    }

    /// The table of that sweep: points that are done, results made now.
    pub(crate) fn table(&self, over: &str, sets: &[&str]) -> (usize, u64) {
        let answer = self.sweep(over, sets, &[]);
        let points = answer["points"]
            .as_array()
            .unwrap_or_else(|| panic!("{answer}"));
        let done = points.iter().filter(|p| p["done"] == true).count();
        (
            done,
            points.iter().map(|p| p["made"].as_u64().unwrap()).sum(),
        )
    }

    fn sweep(&self, over: &str, sets: &[&str], more: &[&str]) -> Value {
        let file = self.place.path("x.toml").display().to_string();
        let over = format!("--sweep=x.n={over}");
        let sets: Vec<String> = sets.iter().map(|set| format!("--set={set}")).collect();
        let mut words = vec!["sweep", &file, &over, "--yes"];
        words.extend(sets.iter().map(String::as_str));
        words.extend(more);
        self.place.json(&words)
    }

    pub(crate) fn submit(&self, plan: &str) -> String {
        let logs = self.logs().display().to_string();
        let (code, text) = self.output(&["submit", plan, "--engine", "slurm", "--logs", &logs]);
        assert_eq!(code, Some(0), "{text}");
        text
    }

    /// Where elements print to.
    fn logs(&self) -> PathBuf {
        self.place.path("logs")
    }

    pub(crate) fn ask(&self, program: &str, words: &[&str]) -> String {
        let mut command = Command::new(program);
        command.args(words);
        let ran = self.on(command).output().unwrap();
        assert!(
            ran.status.success(),
            "{program}: {}",
            String::from_utf8_lossy(&ran.stderr)
        );
        String::from_utf8_lossy(&ran.stdout).into_owned()
    }

    /// The numbers of all jobs that were ever sent.
    pub(crate) fn jobs(&self) -> Vec<String> {
        let jobs_text = self.ask("squeue", &["-h", "-r", "--states=all", "-o", "%F"]);
        let mut jobs: Vec<String> = jobs_text.lines().map(|l| l.trim().to_owned()).collect();
        jobs.sort();
        jobs.dedup();
        jobs
    }

    /// Waits until something holds; how long it took.
    #[track_caller]
    pub(crate) fn wait(&self, what: &str, holds: impl Fn() -> bool) -> Duration {
        let start = Instant::now();
        while !holds() {
            let queue = || self.ask("squeue", &["-r", "--states=all"]);
            assert!(
                start.elapsed() < LONGEST,
                "{what} did not come: {}",
                queue()
            );
            std::thread::sleep(Duration::from_millis(100));
        }
        start.elapsed()
    }

    /// Waits until nothing runs or waits any more.
    #[track_caller]
    pub(crate) fn settle(&self) -> Duration {
        self.wait("the end", || self.ask("squeue", &["-h"]).trim().is_empty())
    }
}

const LONGEST: Duration = Duration::from_secs(300);

impl Drop for Site {
    fn drop(&mut self) {
        if std::thread::panicking() {
            for entry in std::fs::read_dir(self.logs())
                .into_iter()
                .flatten()
                .flatten()
            {
                let text = std::fs::read_to_string(entry.path()).unwrap_or_default();
                println!("{}: {text}", entry.path().display());
            }
        }
        let _ = Command::new(script())
            .arg("stop")
            .arg(self.place.path("slurm"))
            .status();
    }
}
