//! Sweeps of the product that cannot be are refused; which nodes a param reaches.

use std::path::{Path, PathBuf};
use tailor::engine;

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
            "give NODE.PARAM=2,3,4",
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
            "give --truth",
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
            "`--tell hull.volum`: `hull` (hull.carve) has no `volum`; did you mean `volume`?",
        ),
        (
            &["sweep", body, "cells", "--tell", "girths.WC.contours"],
            "`--tell girths.WC.contours`: `girths` (measure.girths) has no `WC.contours`; did you mean `WC.contour`?",
        ),
        (&huge, "998000 points"),
        (&huge, "give --yes"),
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
