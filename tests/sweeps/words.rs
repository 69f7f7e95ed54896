//! What a sweep that cannot be is told, and how much one is before it runs.

use crate::toy::{CATALOG, PIPELINE};
use std::path::{Path, PathBuf};
use tailor::engine;
use tailor::recipe::{Overrides, open_text, read};
use tailor::sweep::{Points, axes, outlook};

#[test]
fn a_million_points_are_counted_and_not_written_out() {
    let hundred = "{ from = 1, to = 100, steps = 100 }";
    let text = format!(
        "{PIPELINE}[sweep.s]\nover.mid = {{ n = {hundred} }}\nover.final = {{ n = {{ from = 0, to = 999, steps = 1000 }} }}\nwith = [\"double\", \"triple\"]\n"
    );
    let recipe = read(&text).unwrap();
    let base = open_text("toy.toml", &text, &Overrides::default(), &CATALOG).unwrap();
    let axes = axes::axes(&recipe.sweeps[0], Path::new(".")).unwrap();
    let points = Points::new(
        &base,
        vec![Some("double".into()), Some("triple".into())],
        axes,
    );
    let last = |node: &str| match node {
        "final" => Some(0.5),
        "mid" => Some(60.0),
        _ => None,
    };
    let outlook = outlook(&points, &base, &base.goal, &last);
    assert_eq!(outlook.points, 200_000);
    assert_eq!(outlook.results, 2 + 200 + 200_000);
    proof::near(outlook.seconds, 200.0 * 60.0 + 200_000.0 * 0.5, 1e-6);
    assert_eq!(
        outlook.to_string(),
        "200000 points, at most 200202 results to make, about 31.1 h going by earlier runs (not known how long: src)"
    );
}

#[test]
fn mistakes_of_a_sweep_are_told_with_their_places() {
    for (declared, place, what) in [
        ("over.mad = { n = [1] }", 2, "there is no node `mad`"),
        (
            "over.mid = { m = [1] }",
            2,
            "toy.add: there is no param `m`",
        ),
        ("over.mid = { n = [1, 5000] }", 2, "out of range"),
        (
            "over.mid = { n = { from = 1, to = 5001, steps = 3 } }",
            2,
            "out of range",
        ),
        (
            "over.mid = { n = { from = 1, to = 5 } }",
            2,
            "a range needs `steps`",
        ),
        (
            "over.mid = { n = { from = 1, to = 5, steps = 2, till = 5 } }",
            2,
            "no key `till`",
        ),
        (
            "over.mid = { n = [1] }\nwith = [\"dubble\"]",
            3,
            "no variant `dubble`",
        ),
        (
            "over.mid = { n = [1] }\ntell = [\"fin.al\"]",
            3,
            "there is no node `fin`",
        ),
        (
            "over.mid = { n = [1] }\ntell = [\"mid.seconds\",\n\"mid.tenfolt\"]",
            4,
            "`mid` (toy.add) tells no `tenfolt`; did you mean `tenfold`? it tells: tenfold, seconds, bytes",
        ),
        (
            "with = [\"double\", \"triple\"]\ntell = \"src.tenfold\"",
            3,
            "`src` (toy.read) tells no `tenfold`; it tells: seconds, bytes",
        ),
        ("over.mid = { n = [1] }\nzip = [\"mid.m\"]", 3, "`mid.m`"),
        ("about = \"?\"", 1, "needs `over`"),
        ("over.mid = { n = [] }", 2, "takes no value"),
    ] {
        let text = format!("{PIPELINE}[sweep.s]\n{declared}\n");
        let Err(told) = open_text("toy.toml", &text, &Overrides::default(), &CATALOG) else {
            panic!("{declared}: no mistake was found");
        };
        let told = told.json()["mistakes"][0].clone();
        let line = PIPELINE.lines().count() + place;
        assert!(
            told["what"].as_str().unwrap().contains(what),
            "{declared}: {told}"
        );
        assert_eq!(told["line"], line, "{declared}: {told}");
    }
}

fn tailor(args: &[&str], cache: &Path) -> (Option<i32>, String) {
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_tailor"));
    let ran = command
        .args(args)
        .arg("--cache")
        .arg(cache)
        .current_dir(root);
    let ran = ran.output().unwrap();
    let text = [ran.stdout, ran.stderr].concat();
    (
        ran.status.code(),
        String::from_utf8_lossy(&text).into_owned(),
    )
}

#[test]
fn a_sweep_that_cannot_be_is_refused_before_anything_runs() {
    let cache = tempfile::tempdir().unwrap();
    let body = "pipelines/body.toml";
    let huge = [
        "sweep",
        body,
        "--sweep",
        "hull.voxel_mm=1..10/1000",
        "--sweep",
        "photos.fewest=3..1000/998",
    ];
    for (args, what) in [
        (&["sweep", body, "nosuch"][..], "no sweep `nosuch`"),
        (&["sweep", body], "name a sweep"),
        (
            &["sweep", body, "--sweep", "hull.voxl_mm=2,3"],
            "did you mean `voxel_mm`",
        ),
        (
            &["sweep", body, "--sweep", "hul.voxel_mm=2,3"],
            "there is no node `hul`",
        ),
        (
            &["sweep", body, "--sweep", "hull.voxel_mm=2,-3"],
            "out of range",
        ),
        (
            &["sweep", body, "--sweep", "hull.voxel_mm"],
            "say NODE.PARAM=2,3,4",
        ),
        (
            &[
                "sweep",
                body,
                "--sweep",
                "hull.voxel_mm=2",
                "--tell",
                "error.WC",
            ],
            "say --truth",
        ),
        (
            &[
                "sweep",
                body,
                "--sweep",
                "hull.voxel_mm=2",
                "--tell",
                "hull.volum",
            ],
            "`--tell hull.volum`: `hull` (hull.carve) tells no `volum`; did you mean `volume`?",
        ),
        (
            &["sweep", body, "cells", "--tell", "girths.WC.tapes"],
            "`--tell girths.WC.tapes`: `girths` (measure.girths) tells no `WC.tapes`; did you mean `WC.tape`?",
        ),
        (&huge, "998000 points"),
        (&huge, "say --yes"),
        (&["impact", "nosuch_mm"], "no param `nosuch_mm`"),
    ] {
        let (code, text) = tailor(args, cache.path());
        assert_eq!(code, Some(2), "{args:?}: {text}");
        assert!(text.contains(what), "{args:?}: {text}");
    }
    assert_eq!(engine::runs(cache.path()).count(), 0);
}

#[test]
fn a_param_reaches_what_reads_it_and_nothing_else() {
    let cache = tempfile::tempdir().unwrap();
    let (code, text) = tailor(&["impact", "hull.voxel_mm", "--json"], cache.path());
    assert_eq!(code, Some(0), "{text}");
    let list: serde_json::Value = serde_json::from_str(&text).unwrap();
    let reaches: Vec<&str> = list[0]["reaches"]
        .as_array()
        .unwrap()
        .iter()
        .map(|v| v.as_str().unwrap())
        .collect();
    assert_eq!(reaches[0], "hull");
    assert!(
        reaches.contains(&"girths") && !reaches.contains(&"masks") && !reaches.contains(&"photos"),
        "{reaches:?}"
    );
    let (_, all) = tailor(&["impact"], cache.path());
    assert!(
        all.lines().count() > 20 && all.contains("photos.fewest"),
        "{all}"
    );
}
