//! Comparing: where two runs part ways, which girths are the same, what a folder needs.

use serde_json::{Value, json};
use shape::{Mesh, mesh_to_ply};
use std::path::{Path, PathBuf};
use tailor::compare::{Side, TechnicalErrors, compare, json as to_json, markdown, page};

/// A node of a `run.json`.
fn node(name: &str, stage: &str, content: &str, provenance: &[(&str, &str)]) -> Value {
    json!({ "node": name, "stage": stage, "version": 1, "status": "made", "why": null, "key": "k",
        "content": content, "provenance": provenance, "seconds": 1.5, "bytes": 2_000_000, "metrics": [], "warnings": [] })
}

/// A cube with this edge. \[mm\]
fn cube(edge: f32) -> Mesh {
    let corner = |i: u32| [i & 1, i >> 1 & 1, i >> 2 & 1].map(|b| b as f32 * edge);
    let quads = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    let faces = quads
        .iter()
        .flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]);
    Mesh {
        positions: (0..8).map(corner).collect(),
        faces: faces.collect(),
        ..Mesh::default()
    }
}

/// A folder as `measure` writes it: `voxel` is a param of the hull, `waist` its tape. \[cm\]
pub(crate) fn folder(
    place: &Path,
    name: &str,
    voxel: &str,
    hull: &str,
    waist: f64,
    edge: f32,
) -> PathBuf {
    let folder = place.join(name);
    std::fs::create_dir(&folder).unwrap();
    let run = json!({ "program": "tailor", "about": "", "seconds": 3.0, "nodes": [
        node("masks", "silhouette.grabcut", "aa", &[("stage", "silhouette.grabcut v1"), ("from photos", "01")]),
        node("hull", "hull.carve", hull, &[("stage", "hull.carve v1"), ("with voxel_mm", voxel), ("from masks", "aa")]),
        node("girths", "measure.girths", &format!("g{waist}"), &[("stage", "measure.girths v1"), ("from mesh", hull)]),
    ] });
    let girth = |name: &str, cm: f64| json!({ "name": name, "label": name, "cm": cm, "tape_cm": cm, "interval_cm": [cm - 1.0, cm + 1.0] });
    let girths = json!({ "unit": "cm", "girths": [girth("WC", waist), girth("NC", 30.0)] });
    std::fs::write(folder.join("run.json"), run.to_string()).unwrap();
    std::fs::write(folder.join("girths.json"), girths.to_string()).unwrap();
    std::fs::write(folder.join("body.ply"), mesh_to_ply(&cube(edge))).unwrap();
    folder
}

/// The exit code, and all that is printed.
fn tailor(args: &[&str]) -> (Option<i32>, String) {
    let cache = tempfile::tempdir().unwrap();
    let (code, out, err) = super::ran(args, cache.path());
    (code, out + &err)
}

#[test]
fn the_first_difference_the_girths_and_the_surfaces_are_reported() {
    let place = tempfile::tempdir().unwrap();
    let a = folder(place.path(), "a", "3.0", "h1", 80.0, 100.0);
    let b = folder(place.path(), "b", "2.0", "h2", 81.2, 104.0);
    let sides = [("a", &a), ("b", &b)].map(|(n, f)| Side::from_folder(n, f).unwrap());
    let c = compare(sides.to_vec(), None, &TechnicalErrors::new());
    let d = &c.differences[0];
    assert_eq!(d.first.as_deref(), Some("hull"));
    assert_eq!(d.diverged, ["hull", "girths"]);
    assert_eq!(d.changes.len(), 1, "{:?}", d.changes);
    assert_eq!(
        (d.changes[0].what.as_str(), d.changes[0].old.as_str()),
        ("voxel_mm", "3.0")
    );
    assert_eq!(c.girths[0].off_mm, [Some(12.0)]);
    assert_eq!(
        (&c.girths[0].same, &c.girths[1].same),
        (&vec![Some(false)], &vec![Some(true)])
    );
    // Three faces of the cube are 4 mm farther out, three in the same planes.
    let apart = c.apart[0].as_ref().unwrap();
    assert!((apart.max_mm - 48f64.sqrt()).abs() < 1e-3, "{apart:?}");
    proof::near(apart.volume_l, 1.04f64.powi(3) - 1.0, 1e-5);
    let words = markdown(&c, &tailor::reader::English);
    for line in [
        "b differs from a from `hull` on (2 of 3 results).",
        "| WC (WC)",
        "NO, 9 mm",
        "voxel_mm",
        "LSC: least significant change",
    ] {
        assert!(words.contains(line), "{line}: {words}");
    }
    let other = compare(sides.to_vec(), Some(20.0), &TechnicalErrors::new());
    assert_eq!(other.girths[0].same, [Some(true)]);
    assert_eq!(to_json(&c)["against_first"][0]["first_diverging"], "hull");
    let page = page(&c, true);
    for outside in ["http:", "https:", " src=", "@import", "url("] {
        assert!(!page.contains(outside), "{outside}");
    }
    assert!(page.contains("\"distances\":["));
    assert!(page.contains("LSC: least significant change"));
}

#[test]
fn what_is_given_otherwise_and_makes_the_same_bytes_is_no_divergence() {
    let place = tempfile::tempdir().unwrap();
    let a = folder(place.path(), "a", "3.0", "h1", 80.0, 100.0);
    let b = folder(place.path(), "b", "2.0", "h1", 80.0, 100.0);
    let sides = [("a", &a), ("b", &b)].map(|(n, f)| Side::from_folder(n, f).unwrap());
    let c = compare(sides.to_vec(), None, &TechnicalErrors::new());
    assert_eq!(c.differences[0].first, None);
    assert_eq!(c.differences[0].met_again, ["hull"]);
    assert_eq!(c.apart[0].as_ref().unwrap().max_mm, 0.0);
    assert!(
        markdown(&c, &tailor::reader::English)
            .contains("b made the same bytes as a in every node.")
    );
}

#[test]
fn folders_are_compared_from_the_command_line_and_bad_ones_are_refused() {
    let place = tempfile::tempdir().unwrap();
    let a = folder(place.path(), "a", "3.0", "h1", 80.0, 100.0);
    let b = folder(place.path(), "b", "2.0", "h2", 81.2, 104.0);
    let out = place.path().join("out");
    let [a, b, o] = [&a, &b, &out].map(|p| p.to_str().unwrap());
    let (code, text) = tailor(&["compare", a, b, "--out", o]);
    assert_eq!(code, Some(0), "{text}");
    for file in ["compare.md", "compare.json", "compare.html"] {
        assert!(out.join(file).is_file(), "{file}");
    }
    let (empty, broken) = (place.path().join("empty"), place.path().join("broken"));
    std::fs::create_dir(&empty).unwrap();
    std::fs::create_dir(&broken).unwrap();
    std::fs::write(broken.join("run.json"), "{\"nodes\": [{}]}").unwrap();
    for (args, what) in [
        (&["compare", a][..], "two or more"),
        (&["compare", a, "nosuch"], "is no folder"),
        (
            &["compare", a, empty.to_str().unwrap()],
            "run.json: is not there",
        ),
        (
            &["compare", a, broken.to_str().unwrap()],
            "no record of a run",
        ),
        (&["compare", a, "last"], "the cache knows 0 runs"),
        (
            &["compare", "pipelines/body.toml", "as-is", "nosuch"],
            "no variant `nosuch`",
        ),
        (
            &["compare", "pipelines/body.toml", "as-is", "hull.voxl_mm=2"],
            "did you mean `voxel_mm`",
        ),
    ] {
        let (code, text) = tailor(args);
        assert_eq!(code, Some(2), "{args:?}: {text}");
        assert!(text.contains(what), "{args:?}: {text}");
    }
}

#[test]
fn every_waist_has_the_limit_of_a_large_girth_and_a_file_may_name_the_part_itself() {
    let place = tempfile::tempdir().unwrap();
    let girths = |name: &str, off: f64| {
        let folder = folder(place.path(), name, "3.0", name, 80.0, 100.0);
        let girth = |name: &str, part: Value| json!({ "name": name, "label": name, "part": part, "cm": 80.0, "tape_cm": 80.0 + off });
        let list = [
            girth("WC_navel", Value::Null),
            girth("HC_max", Value::Null),
            girth("TC_L", Value::Null),
            girth("below_the_bust", "chest".into()),
            girth("mid_thigh_L", "thigh".into()),
        ];
        let file = json!({ "unit": "cm", "girths": list });
        std::fs::write(folder.join("girths.json"), file.to_string()).unwrap();
        Side::from_folder(name, &folder).unwrap()
    };
    let c = compare(
        vec![girths("a", 0.0), girths("b", 0.7)],
        None,
        &TechnicalErrors::new(),
    );
    let limits: Vec<_> = c
        .girths
        .iter()
        .map(|row| (row.tolerance_mm, row.same[0]))
        .collect();
    let (large, small) = ((9.0, Some(true)), (4.0, Some(false)));
    assert_eq!(limits, [large, large, small, large, small]);
}

#[test]
fn relative_lengths_are_never_compared_with_centimetres() {
    let place = tempfile::tempdir().unwrap();
    let relative = |name: &str, tape: f64| {
        let folder = folder(place.path(), name, "3.0", name, 80.0, 100.0);
        let girth = json!({ "name": "WC", "label": "waist", "part": "waist", "rel": tape, "tape_rel": tape });
        let file = json!({ "unit": "relative", "girths": [girth] });
        std::fs::write(folder.join("girths.json"), file.to_string()).unwrap();
        folder
    };
    let a = folder(place.path(), "a", "3.0", "h1", 80.0, 100.0);
    let (b, c) = (relative("b", 0.31), relative("c", 0.32));
    let [a, b, c] = [&a, &b, &c].map(|p| p.to_str().unwrap());
    let (code, text) = tailor(&["compare", a, b]);
    assert_eq!(code, Some(2), "{text}");
    assert!(
        text.contains("lengths of b are relative") && text.contains("those of a"),
        "{text}"
    );
    // Side by side they may be, without a verdict in millimetres.
    let (code, text) = tailor(&["compare", b, c]);
    assert_eq!(code, Some(0), "{text}");
    assert!(
        text.contains("b [relative]") && text.contains("0.31000"),
        "{text}"
    );
    assert!(
        !text.contains("[cm]") && !text.contains("NO, 9 mm"),
        "{text}"
    );
    let truth = place.path().join("truth");
    std::fs::create_dir(&truth).unwrap();
    let known =
        json!({ "WC": { "cm": 80.0, "tape_cm": 80.0, "point": [0, 0, 1], "normal": [0, 0, 1] } });
    std::fs::write(truth.join("measurements.json"), known.to_string()).unwrap();
    let (code, text) = tailor(&["score", b, "--truth", truth.to_str().unwrap()]);
    assert_eq!(code, Some(2), "{text}");
    assert!(text.contains("its lengths are relative"), "{text}");
}

#[test]
fn a_surface_that_is_placed_differently_is_aligned_to_the_first_before_it_is_judged() {
    let place = tempfile::tempdir().unwrap();
    let solid = synth::body_solid(&synth::Build {
        stature: 1750.0,
        stout: 1.0,
        furrow: 14.0,
        arms: 0.7,
        exponent: 2.3,
    });
    let (low, high) = synth::bounds(&solid);
    let body = synth::surface(&solid, low, high, 14.0);
    let turn =
        nalgebra::Rotation3::from_axis_angle(&nalgebra::Vector3::z_axis(), 15f64.to_radians());
    let moved = |p: &[f32; 3]| {
        let at = turn * nalgebra::Point3::from(p.map(f64::from))
            + nalgebra::Vector3::new(30.0, 0.0, 0.0);
        at.coords.map(|x| x as f32).into()
    };
    let other = Mesh {
        positions: body.positions.iter().map(moved).collect(),
        ..body.clone()
    };
    let side = |name: &str, mesh: &Mesh| {
        let folder = folder(place.path(), name, "3.0", name, 80.0, 100.0);
        std::fs::write(folder.join("body.ply"), mesh_to_ply(mesh)).unwrap();
        Side::from_folder(name, &folder).unwrap()
    };
    let sides = vec![side("a", &body), side("b", &other), side("c", &body)];
    let c = compare(sides, None, &TechnicalErrors::new());
    assert!(
        c.apart[0].as_ref().unwrap().mean_mm > 15.0,
        "{:?}",
        c.apart[0]
    );
    let laid = c.laid[0].as_ref().unwrap();
    assert!(laid.apart.mean_mm < 0.2, "{:?}", laid.apart);
    proof::near(laid.turned_deg, 15.0, 0.1);
    assert_eq!(c.laid[1], None);
    assert!(markdown(&c, &tailor::reader::English).contains("b, aligned to a (turned 15.0°"));
    assert!(page(&c, false).contains("aligned to a"));
}
