//! Sweeps: what ran, in which order, and what the table shows, on a chain src → mid → final.

use crate::place::Log;
use crate::toys::CATALOG;
use engine::Options;
use engine::graph::Graph;
use engine::recipe::{Overrides, open_text, read};
use engine::sweep::{self, End, Points, Row, Sweeping, axes, outlook};
use engine::walk::Status;
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicBool, Ordering};

/// src → mid → final.
pub(crate) const PIPELINE: &str = r#"goal = "final"
[input.src]
files = "*.txt"
[node.src]
stage = "toy.clean"
from = { files = "@src" }
[node.mid]
stage = "toy.mid"
from = { text = "src" }
[node.final]
stage = "toy.mid"
from = { text = "mid" }
[variant.double]
with.mid = { n = 2 }
[variant.triple]
with.mid = { n = 3 }
"#;

/// A folder with a source and a store.
struct Place(tempfile::TempDir);

impl Place {
    fn new() -> Place {
        let place = Place(proof::in_memory());
        std::fs::create_dir(place.0.path().join("src")).unwrap();
        std::fs::write(place.0.path().join("src/a.txt"), "hello").unwrap();
        place
    }

    /// Runs a sweep as the text declares it on two threads.
    fn sweep(&self, declared: &str) -> (Vec<Row>, Vec<(String, Status)>) {
        self.sweep_on(2, declared, usize::MAX)
    }

    /// Runs a sweep as the text declares it; stops after so many points.
    fn sweep_on(
        &self,
        threads: usize,
        declared: &str,
        stop_after: usize,
    ) -> (Vec<Row>, Vec<(String, Status)>) {
        let text = format!("{PIPELINE}{declared}");
        let recipe = read(&text).unwrap();
        let declared = &recipe.sweeps[0];
        let base = self.open(&text, &Overrides::default());
        let axes = axes::axes(declared, self.0.path()).unwrap();
        let mut variants: Vec<_> = declared
            .with
            .iter()
            .map(|v| Some(v.value.clone()))
            .collect();
        if variants.is_empty() {
            variants.push(None);
        }
        let points = Points::new(&base, variants, axes);
        let (log, cancel) = (Log::default(), AtomicBool::new(false));
        let tell: Vec<String> = declared.tell.iter().map(|t| t.value.clone()).collect();
        let options = Options {
            cache: self.0.path().join("cache"),
            threads: Some(threads),
            keep_going: true,
        };
        let sweeping = Sweeping {
            open: &|point| Ok(self.open(&text, &point.overrides(&Overrides::default()))),
            nodes: &[],
            folders: &[("src".to_owned(), self.0.path().join("src"))],
            options: &options,
            tell: &tell,
            errors: None,
            watch: &log,
            cancel: &cancel,
        };
        let mut count = 0;
        let rows = sweep::run(&sweeping, points.iter(), |_| {
            count += 1;
            if count == stop_after {
                cancel.store(true, Ordering::Relaxed);
            }
        });
        let before = outlook(&points, &base, &base.goal, &|_| None).results;
        let rows = rows.unwrap();
        let made: usize = rows.iter().map(|r| r.made).sum();
        assert!(made as u128 <= before, "no more is made than was predicted");
        (rows, log.0.into_inner().unwrap())
    }

    fn open(&self, text: &str, overrides: &Overrides) -> Graph {
        open_text("toy.toml", text, overrides, &CATALOG).unwrap()
    }
}

/// How often each node was made.
fn made(log: &[(String, Status)]) -> BTreeMap<&str, usize> {
    let mut made = BTreeMap::new();
    for (node, _) in log.iter().filter(|(_, status)| *status == Status::Executed) {
        *made.entry(node.as_str()).or_default() += 1;
    }
    made
}

const GRID: &str = "[sweep.s]\nabout = \"?\"\nover.final = { n = [5, 6, 7] }\nover.mid = { n = [1, 2] }\ntell = [\"final.tenfold\", \"mid.tenfold\"]\n";

#[test]
fn what_points_share_is_made_once_and_upstream_varies_slowest() {
    let place = Place::new();
    let (rows, log) = place.sweep_on(1, GRID, 99);
    assert_eq!(made(&log), [("src", 1), ("mid", 2), ("final", 6)].into());
    let metrics: Vec<Vec<f64>> = rows
        .iter()
        .map(|r| {
            r.metrics
                .iter()
                .map(|(_, m)| m.as_ref().unwrap().value)
                .collect()
        })
        .collect();
    let want: Vec<Vec<f64>> = [10.0, 20.0]
        .into_iter()
        .flat_map(|mid| [50.0, 60.0, 70.0].map(|last| vec![last, mid]))
        .collect();
    assert_eq!(metrics, want);
    // Depth first: on one thread the first point is done after three nodes, before anything of the second.
    let first: Vec<&str> = log[..3].iter().map(|(n, _)| n.as_str()).collect();
    assert_eq!(first, ["src", "mid", "final"]);
    let (_, again) = place.sweep(GRID);
    assert_eq!(made(&again), BTreeMap::new());
}

#[test]
fn a_stopped_sweep_goes_on_and_added_points_make_only_what_is_new() {
    let place = Place::new();
    let (rows, log) = place.sweep_on(1, GRID, 2);
    let first = made(&log).values().sum::<usize>();
    let ends: Vec<&End> = rows.iter().map(|r| &r.end).collect();
    // Rows come beside the walk: some more nodes may be made until the stop reaches it.
    assert!(ends.len() >= 2 && *ends[1] == End::Done, "{ends:?}");
    let stopped = ends.iter().filter(|end| ***end == End::Stopped).count();
    assert!(stopped <= 1, "{ends:?}");
    let (rows, log) = place.sweep(GRID);
    assert_eq!(rows.len(), 6);
    assert_eq!(first + made(&log).values().sum::<usize>(), 1 + 2 + 6);
    let (_, log) = place.sweep(&GRID.replace("[5, 6, 7]", "[4, 5, 6, 7]"));
    assert_eq!(made(&log), [("final", 2)].into());
}

#[test]
fn rows_are_those_of_one_thread_whatever_the_threads() {
    let reported = |threads: usize| {
        let place = Place::new();
        let grid = GRID.replace("[1, 2]", "[1, 13, 2]");
        let (rows, _) = place.sweep_on(threads, &grid, 99);
        let one = |r: &Row| {
            (
                r.point.clone(),
                r.end.clone(),
                r.metrics.clone(),
                r.made,
                r.found,
            )
        };
        rows.iter().map(one).collect::<Vec<_>>()
    };
    let one = reported(1);
    assert_eq!(one.iter().map(|r| r.3).sum::<usize>(), 9);
    for threads in [2, 8] {
        assert_eq!(reported(threads), one, "{threads}");
    }
}

#[test]
fn a_failing_point_is_reported_tried_once_and_does_not_stop_the_rest() {
    let place = Place::new();
    let (rows, log) = place.sweep(&GRID.replace("[1, 2]", "[1, 13, 2]"));
    let failed: Vec<bool> = rows.iter().map(|r| r.end != End::Done).collect();
    assert_eq!(
        failed,
        [false, false, false, true, true, true, false, false, false]
    );
    for row in &rows[3..6] {
        let want = End::Failed("mid".into(), "thirteen is not taken".into());
        assert_eq!(row.end, want);
    }
    let tried = log
        .iter()
        .filter(|(_, f)| matches!(f, Status::Failed(_)))
        .count();
    assert_eq!(tried, 1, "three points share the failure");
    let text = tables::text("?", &rows);
    assert!(text.contains("mid failed: thirteen is not taken"), "{text}");
    assert!(
        text.contains("9 points (3 without a result): 9 results made"),
        "{text}"
    );
    // A failure is of this run: it is tried again in the next.
    let (_, log) = place.sweep(&GRID.replace("[1, 2]", "[1, 13, 2]"));
    assert!(log.iter().any(|(_, f)| matches!(f, Status::Failed(_))));
}

#[test]
fn variants_cross_with_the_grid_and_zipped_params_go_side_by_side() {
    let place = Place::new();
    let (rows, log) = place.sweep(
        "[sweep.s]\nwith = [\"double\", \"triple\"]\nover.final = { n = { from = 1, to = 5, steps = 3 } }\ntell = \"mid.tenfold\"\n");
    let names: Vec<String> = rows.iter().map(|r| r.point.name("s")).collect();
    let want = [
        "s@double,1",
        "s@double,3",
        "s@double,5",
        "s@triple,1",
        "s@triple,3",
        "s@triple,5",
    ];
    assert_eq!(names, want);
    assert_eq!(made(&log), [("src", 1), ("mid", 2), ("final", 6)].into());
    let zipped = "[sweep.s]\nover.mid = { n = [1, 2, 3] }\nover.final = { n = [7, 8, 9] }\nzip = [\"mid.n\", \"final.n\"]\n";
    let (rows, _) = place.sweep(zipped);
    let names: Vec<String> = rows.iter().map(|r| r.point.name("s")).collect();
    assert_eq!(names, ["s@1,7", "s@2,8", "s@3,9"]);
    std::fs::write(place.0.path().join("p.csv"), "mid.n,final.n\n4,40\n5,50\n").unwrap();
    let (rows, _) = place.sweep("[sweep.s]\ncsv = \"p.csv\"\ntell = \"final.tenfold\"\n");
    let lines: Vec<String> = tables::csv(&rows).lines().map(str::to_owned).collect();
    assert!(
        lines[0].starts_with("mid.n,final.n,final.tenfold mm,made"),
        "{}",
        lines[0]
    );
    assert!(
        lines[1].starts_with("4,40,400,") && lines[2].starts_with("5,50,500,"),
        "{lines:?}"
    );
}
