//! Replicates: which seeds they reach, what they share, what is refused before anything runs.

use crate::place::Log;
use crate::toys::CATALOG;
use engine::Options;
use engine::graph::Graph;
use engine::recipe::{Overrides, open_text};
use engine::sweep::{self, Axis, End, Points, Replicates, Row, Sweeping, axes};
use std::path::Path;
use std::sync::atomic::AtomicBool;
use tables::{Reported, spread};

const PIPELINE: &str = r#"goal = "last"
[input.src]
files = "*.txt"
[node.src]
stage = "toy.clean"
from = { files = "@src" }
[node.noise]
stage = "toy.noise"
from = { text = "src" }
with = { seed = 2 }
[node.last]
stage = "toy.mid"
from = { text = "noise" }
[node.aside]
stage = "toy.noise"
from = { text = "src" }
[variant.more]
with.last = { n = 2 }
[variant.still]
from.last = { text = "src" }
"#;

fn open(variant: Option<&str>, sets: &[String]) -> Graph {
    let overrides = Overrides {
        variant: variant.map(str::to_owned),
        sets: sets.to_vec(),
    };
    open_text("toy.toml", PIPELINE, &overrides, &CATALOG).unwrap()
}

fn repeated(times: u32, variants: &[&str], axes: &[&str]) -> Result<Points, String> {
    let graphs: Vec<Graph> = variants.iter().map(|v| open(Some(v), &[])).collect();
    let axes: Vec<Axis> = axes.iter().map(|a| axes::given(a).unwrap()).collect();
    let of = Replicates::of(times, &graphs, &[], &axes).map_err(|e| e.to_string())?;
    let names = variants.iter().map(|v| Some((*v).to_owned())).collect();
    Ok(Points::new(&graphs[0], names, axes).repeated(of))
}

fn rows(points: &Points, place: &Path) -> Vec<Row> {
    std::fs::create_dir_all(place.join("src")).unwrap();
    std::fs::write(place.join("src/a.txt"), "hello").unwrap();
    let (log, cancel) = (Log::default(), AtomicBool::new(false));
    let options = Options {
        cache: place.join("cache"),
        threads: Some(2),
        keep_going: true,
    };
    let sweeping = Sweeping {
        open: &|point| Ok(open(point.variant.as_deref(), &point.sets())),
        nodes: &[],
        folders: &[("src".to_owned(), place.join("src"))],
        options: &options,
        tell: &["noise.sum".to_owned(), "last.tenfold".to_owned()],
        errors: None,
        watch: &log,
        cancel: &cancel,
    };
    sweep::run(&sweeping, points.iter(), |_| {}).unwrap()
}

#[test]
fn replicates_take_the_next_seeds_alike_in_all_variants_and_share_what_is_equal() {
    let place = proof::in_memory();
    let points = repeated(4, &["more", "still"], &[]);
    let why = points.unwrap_err();
    assert!(
        why.contains("stages that have one: toy.noise.seed"),
        "{why}"
    );
    let points = repeated(6, &["more"], &["noise.n=1,2"]).unwrap();
    assert_eq!(points.count(), 12);
    let rows = rows(&points, place.path());
    let first: Vec<(String, Option<u32>)> = rows[..2]
        .iter()
        .map(|r| (r.point.sets().join(" "), r.point.replicate))
        .collect();
    assert_eq!(
        first,
        [
            ("noise.n=1 noise.seed=2".to_owned(), Some(1)),
            ("noise.n=1 noise.seed=3".to_owned(), Some(2)),
        ],
        "what the goal does not need (aside) is left as it is"
    );
    let reported: Vec<Reported> = rows.iter().map(Reported::of).collect();
    let groups = spread(&reported);
    assert_eq!(groups.len(), 2);
    let sum = &groups[0].spreads[0];
    // Seeds 2, 3, 5, 6 have it; 4 refuses, 7 fails.
    assert_eq!(
        (sum.n, sum.refused, groups[0].failed, sum.mean),
        (4, 1, 1, Some(14.0))
    );
    proof::near(sum.sd.unwrap(), (10.0f64 / 3.0).sqrt(), 1e-12);
    assert!(
        matches!(&rows[5].end, End::Failed(node, why) if node == "noise" && why.contains("seven"))
    );
    let read = tables::json("toys 1", "s", "", &rows);
    assert_eq!(Reported::read(&read).unwrap(), reported);
    assert_eq!(read["replicates"][0]["metrics"][0]["refused"], 1);
}

#[test]
fn a_sweep_again_with_more_replicates_makes_only_what_is_new() {
    let place = proof::in_memory();
    let few = rows(&repeated(2, &["more"], &[]).unwrap(), place.path());
    let more = rows(&repeated(3, &["more"], &[]).unwrap(), place.path());
    let made = |rows: &[Row]| rows.iter().map(|r| r.made).sum::<usize>();
    assert_eq!(
        (made(&few), made(&more)),
        (5, 2),
        "the noise of seed 4 and what reads it"
    );
}

#[test]
fn replicates_that_cannot_be_are_refused() {
    let why = repeated(3, &["more"], &["noise.seed=1,2"]).unwrap_err();
    assert_eq!(
        why,
        "`noise.seed` varies by itself and by `replicate`: leave one of them out"
    );
    let why = repeated(20, &["more"], &[]).unwrap_err();
    assert_eq!(
        why,
        "`noise.seed` is 2 and may be 20 at most: give it a smaller number, or fewer replicates"
    );
    let still = PIPELINE
        .replace("toy.noise", "toy.mid")
        .replace("with = { seed = 2 }", "");
    let text = format!("{still}[sweep.s]\nover.last = {{ n = [1, 2] }}\nreplicate = 4\n");
    let Err(reported) = open_text("toy.toml", &text, &Overrides::default(), &CATALOG) else {
        panic!("replicates of nothing were taken");
    };
    let reported = reported.json()["mistakes"][0].clone();
    assert!(
        reported["what"]
            .as_str()
            .unwrap()
            .contains("all replicates would be the same"),
        "{reported}"
    );
    assert_eq!(reported["line"], still.lines().count() + 3, "{reported}");
    let text = format!("{PIPELINE}[sweep.s]\nreplicate = 1\n");
    let Err(reported) = open_text("toy.toml", &text, &Overrides::default(), &CATALOG) else {
        panic!("one replicate was taken");
    };
    assert!(reported.to_string().contains("2 to 10000"), "{reported}");
}
