//! `tailor follow`: the same body turned, moved and with its arms in another pose is the same; what grew is found.

use super::ran;
use follow::{Halves, PARTS, Target, carried, growth, posed, rigid, segments, volumes};
use nalgebra::{Isometry3, Point3, Vector3};
use serde_json::Value;
use shape::{Mesh, Part, Plane, mesh_to_ply};
use std::path::{Path, PathBuf};
use std::sync::LazyLock;
use synth::{Build, body_solid, bounds, surface};

/// A made body of 1.75 m that holds its arms so, with a belt about the waist grown by so much along the radius. \[mm\]
fn body(arms_deg: f64, stature: f64, belt_mm: f64) -> Mesh {
    let solid = body_solid(&Build {
        stature,
        stout: 1.0,
        furrow: 14.0,
        arms: arms_deg.to_radians(),
        exponent: 2.3,
    });
    let (low, high) = bounds(&solid);
    let mut mesh = surface(&solid, low, high, 15.0);
    for at in &mut mesh.positions {
        let [x, y, z] = at.map(f64::from);
        let high = (z - 0.62 * stature) / 60.0;
        // Arms hang far outside.
        if x.abs() < 280.0 {
            let by = belt_mm * libm::exp(-0.5 * high * high) / libm::hypot(x, y).max(1.0);
            (at[0], at[1]) = ((x + x * by) as f32, (y + y * by) as f32);
        }
    }
    mesh
}

/// The body that most tests begin with.
static USUAL: LazyLock<Mesh> = LazyLock::new(|| body(42.0, 1750.0, 0.0));

fn moved(mesh: &Mesh, motion: &Isometry3<f64>) -> Mesh {
    let at = |v: u32| (motion * mesh.point(v)).coords.map(|x| x as f32).into();
    Mesh {
        positions: (0..mesh.positions.len() as u32).map(at).collect(),
        ..mesh.clone()
    }
}

fn parts(mesh: &Mesh) -> Vec<u8> {
    let body = measure::body(mesh, 0.0).unwrap();
    measure::parts(mesh, &body, &measure::limbs(mesh, &body))
}

fn turned(deg: f64) -> Isometry3<f64> {
    Isometry3::new(
        Vector3::new(30.0, -10.0, 0.0),
        Vector3::z() * deg.to_radians(),
    )
}

/// The middle of absolute values.
fn median(values: &[f64]) -> f64 {
    let mut all: Vec<f64> = values.iter().map(|v| v.abs()).collect();
    all.sort_by(f64::total_cmp);
    all[all.len() / 2]
}

#[test]
fn a_turned_and_moved_body_is_laid_back_from_any_side() {
    let first = &*USUAL;
    for deg in [15.0, -100.0, 180.0] {
        let motion = turned(deg);
        let other = moved(first, &motion);
        let found = rigid(first, &Target::new(&other), Halves::Both);
        for p in [
            Point3::new(0.0, 0.0, 1700.0),
            Point3::new(300.0, 0.0, 900.0),
            Point3::origin(),
        ] {
            let off = (found * p - motion * p).norm();
            assert!(off < 0.3, "{deg}°: {off} mm");
        }
    }
}

#[test]
fn arms_in_another_pose_are_the_same_arms_and_levels_stay_where_they_were() {
    let first = &*USUAL;
    let other = moved(&body(34.0, 1750.0, 0.0), &turned(15.0));
    let segments = segments(first, &parts(first));
    let target = Target::new(&other);
    let laid = posed(first, &segments, &target, Halves::Both);
    let off = growth(&laid.mesh, &target);
    assert!(median(&off) < 0.5, "{}", median(&off));
    // Before: the arms alone are some hundred millimetres apart at the hands.
    let mut order: Vec<f64> = off.iter().map(|x| x.abs()).collect();
    order.sort_by(f64::total_cmp);
    let most = order[order.len() * 95 / 100];
    assert!(most < 6.0, "95 % of the surface are within {most} mm");
    let of = segments.parts();
    let waist = Plane {
        point_mm: [0.0, 0.0, 1085.0],
        normal: [0.0, 0.0, 1.0],
    };
    let there = carried(&waist, first, &laid.mesh, |v| of[v] == Part::Trunk).unwrap();
    assert!((there.point_mm[2] - 1085.0).abs() < 0.3, "{there:?}");
    assert!(there.normal[2] > 0.999_99, "{there:?}");
    assert_eq!(carried(&waist, first, &laid.mesh, |_| false), None);
}

#[test]
fn volumes_of_parts_are_those_of_the_whole() {
    let mesh = &*USUAL;
    let of = segments(mesh, &parts(mesh)).parts();
    let all = volumes(mesh, &of, &PARTS);
    proof::near(all.iter().sum::<f64>() / mesh.volume(), 1.0, 1e-9);
    assert!(all.iter().all(|v| *v > 5e5), "{all:?}");
    // Left and right are alike.
    proof::near(all[2] / all[3], 1.0, 0.02);
    proof::near(all[4] / all[5], 1.0, 0.02);
}

/// A surface measured by the program, as a folder of results.
fn capture(place: &Path, name: &str, mesh: &Mesh) -> PathBuf {
    let scan = place.join("scans").join(name);
    std::fs::create_dir_all(&scan).unwrap();
    std::fs::write(scan.join("body.ply"), mesh_to_ply(mesh)).unwrap();
    let out = place.join(name);
    let input = format!("surface={}", scan.display());
    let args = [
        "run",
        "surface",
        "girths",
        "landmarks",
        "body",
        "--quiet",
        "--input",
        &input,
        "--out",
        out.to_str().unwrap(),
    ];
    let (code, _, errors) = ran(&args, &place.join("cache"));
    assert_eq!(code, Some(0), "{errors}");
    out
}

#[test]
fn a_belt_that_grew_is_found_at_its_level() {
    let place = tempfile::tempdir().unwrap();
    let may = capture(place.path(), "anna-2026-05-01", &USUAL);
    // Two millimetres of radius are 12.6 of girth.
    let june = capture(
        place.path(),
        "anna-2026-06-01",
        &moved(&body(38.0, 1750.0, 2.0), &turned(-12.0)),
    );
    let known = place.path().join("repeat.json");
    let row = |name: &str| serde_json::json!({ "name": name, "tem_mm": 1.0 });
    let names = ["WC", "HC", "NC", "AC_L", "AC_R", "CFC_L"];
    let rows: Vec<Value> = names.map(row).to_vec();
    let file = serde_json::json!({ "repeatability": rows });
    std::fs::write(&known, file.to_string()).unwrap();
    let out = place.path().join("out");
    let [may, june, known, o] = [&may, &june, &known, &out].map(|p| p.to_str().unwrap());
    let cache = place.path().join("cache");
    let (code, text, errors) = ran(
        &[
            "follow", "Anna", june, may, "--json", "--repeat", known, "--out", o,
        ],
        &cache,
    );
    assert_eq!(code, Some(0), "{errors}");
    let json: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(json["captures"][0]["date"], "2026-05-01");
    proof::near(
        json["captures"][1]["turned_deg"].as_f64().unwrap(),
        -12.0,
        0.2,
    );
    assert_eq!(json["warnings"], Value::Array(vec![]), "{json}");
    let change = |name: &str| {
        let line = json["girths"]
            .as_array()
            .unwrap()
            .iter()
            .find(|l| l["name"] == name)
            .unwrap();
        (
            line["at"][1]["change_mm"].as_f64().unwrap(),
            line["at"][1]["changed"].as_bool().unwrap(),
        )
    };
    let (waist, changed) = change("WC");
    proof::near(waist, 12.6, 0.8);
    assert!(changed);
    for name in ["NC", "AC_L", "AC_R", "CFC_L"] {
        let (off, changed) = change(name);
        assert!(off.abs() < 1.5 && !changed, "{name}: {off}");
    }
    for file in [
        "follow.md",
        "follow.json",
        "follow.csv",
        "follow.html",
        "growth-anna-2026-06-01.ply",
    ] {
        assert!(out.join(file).is_file(), "{file}");
    }
    let page = std::fs::read_to_string(out.join("follow.html")).unwrap();
    assert!(page.contains("<svg") && page.contains("data:image/jpeg") && !page.contains("http:"));
}

#[test]
fn somebody_else_is_noticed_and_what_cannot_be_followed_is_refused() {
    let place = tempfile::tempdir().unwrap();
    let may = capture(place.path(), "anna-2026-05-01", &USUAL);
    let small = capture(place.path(), "bert-2026-07-01", &body(42.0, 1690.0, 0.0));
    let [may, small] = [&may, &small].map(|p| p.to_str().unwrap());
    let cache = place.path().join("cache");
    let (code, text, errors) = ran(&["follow", "Anna", may, small], &cache);
    assert_eq!(code, Some(0), "{errors}");
    assert!(
        text.contains("may be somebody else's capture: its stature is -6"),
        "{text}"
    );
    for (args, what) in [
        (vec!["follow", "Anna", may], "two captures or more"),
        (vec!["follow", "Anna", may, may], "is given twice"),
        (vec!["follow", "Anna", may, "nosuch"], "is not there"),
    ] {
        let (code, _, errors) = ran(&args, &cache);
        assert_eq!(code, Some(2), "{args:?}: {errors}");
        assert!(errors.contains(what), "{args:?}: {errors}");
    }
}
