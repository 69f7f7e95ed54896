//! `tailor repeat`: captures of the same people, from the command line.

use super::ran;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// A folder as `measure` writes it, as far as it is read: tapes by name. \[mm\]
fn capture(place: &Path, name: &str, tapes: &[(&str, f64)]) -> PathBuf {
    let folder = place.join(name);
    std::fs::create_dir_all(&folder).unwrap();
    let girth = |(name, mm): &(&str, f64)| json!({ "name": name, "label": name, "part": null, "cm": mm / 10.0, "tape_cm": mm / 10.0 });
    let list: Vec<Value> = tapes.iter().map(girth).collect();
    let file = json!({ "unit": "cm", "girths": list });
    std::fs::write(folder.join("girths.json"), file.to_string()).unwrap();
    folder
}

#[test]
fn two_people_twice_have_errors_correlation_and_plots() {
    let place = tempfile::tempdir().unwrap();
    let all = [
        capture(place.path(), "anna-1", &[("WC", 800.0), ("NC", 330.0)]),
        capture(place.path(), "anna-2-out", &[("WC", 804.0), ("NC", 331.0)]),
        capture(
            place.path(),
            "bert-2026-05-01",
            &[("WC", 950.0), ("NC", 400.0)],
        ),
        capture(place.path(), "bert-2026-06-01", &[("WC", 947.0)]),
    ];
    let out = place.path().join("out");
    let mut args = vec!["repeat", "--json", "--out", out.to_str().unwrap()];
    args.extend(all.iter().map(|p| p.to_str().unwrap()));
    let (code, text, errors) = ran(&args, place.path());
    assert_eq!(code, Some(0), "{errors}");
    let study: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(study["people"][1]["person"], "bert");
    let waist = &study["repeatability"][0];
    // Differences of 4 and 3 mm: √(25 / 4).
    proof::near(waist["tem_mm"].as_f64().unwrap(), 2.5, 1e-9);
    proof::near(waist["lsc95_mm"].as_f64().unwrap(), 6.93, 0.01);
    assert_eq!(waist["allowed_mm"], 12.0);
    assert!(waist["icc_2_1"].as_f64().unwrap() > 0.99);
    let neck = &study["repeatability"][1];
    assert_eq!(
        (&neck["degrees_of_freedom"], &neck["icc_2_1"]),
        (&json!(1), &Value::Null)
    );
    let read = |name: &str| std::fs::read_to_string(out.join(name)).unwrap();
    let known = tailor::repeat::technical_errors(&read("repeat.json")).unwrap();
    proof::near(known["WC"], 2.5, 1e-9);
    assert!(
        read("repeat.csv")
            .lines()
            .nth(1)
            .unwrap()
            .starts_with("WC,WC,2,4,")
    );
    assert!(read("bland-altman-WC.svg").contains("bias +0.5"));
    let page = read("repeat.html");
    assert_eq!(page.matches("<svg").count(), 2);
    assert!(read("repeat.md").contains("27 (30 people twice"));
}

#[test]
fn captures_that_come_out_equal_err_by_their_rounding_at_least() {
    let place = tempfile::tempdir().unwrap();
    let all = ["anna-1", "anna-2", "anna-3"];
    let all = all.map(|name| capture(place.path(), name, &[("CC", 912.3)]));
    let mut args = vec!["repeat", "--json"];
    args.extend(all.iter().map(|p| p.to_str().unwrap()));
    let (code, text, errors) = ran(&args, place.path());
    assert_eq!(code, Some(0), "{errors}");
    let study: Value = serde_json::from_str(&text).unwrap();
    let chest = &study["repeatability"][0];
    // 0.1 mm / √12; by χ² of two degrees of freedom up to 6.3 times that.
    let error = 0.1 / 12f64.sqrt();
    proof::near(chest["tem_mm"].as_f64().unwrap(), error, 1e-4);
    proof::near(chest["lsc95_mm"].as_f64().unwrap(), 2.77 * error, 1e-3);
    let ends = chest["tem_interval_mm"].as_array().unwrap();
    assert_eq!(ends[0].as_f64(), Some(0.0), "{chest}");
    proof::near(
        ends[1].as_f64().unwrap() / error,
        (2.0f64 / 0.050_64).sqrt(),
        0.01,
    );
    let (_, text, _) = ran(&[&args[..1], &args[2..]].concat(), place.path());
    assert!(text.contains("0.03 mm at least"), "{text}");
}

#[test]
fn what_cannot_be_known_is_refused_with_what_to_do() {
    let place = tempfile::tempdir().unwrap();
    let anna = capture(place.path(), "anna", &[("WC", 800.0)]);
    let bert = capture(place.path(), "bert", &[("WC", 900.0)]);
    let unmeasured = place.path().join("carl");
    std::fs::create_dir(&unmeasured).unwrap();
    let [anna, bert, carl] = [&anna, &bert, &unmeasured].map(|p| p.to_str().unwrap());
    for (args, what) in [
        (
            ["repeat", anna, bert],
            "nobody was measured twice among anna, bert",
        ),
        (["repeat", anna, carl], "run `tailor measure"),
        (["repeat", anna, anna], "is given twice"),
        (["repeat", anna, "nosuch"], "nosuch is not there"),
    ] {
        let (code, _, errors) = ran(&args, place.path());
        assert_eq!(code, Some(2), "{args:?}: {errors}");
        assert!(errors.contains(what), "{args:?}: {errors}");
    }
    let (code, text, _) = ran(&["repeat", anna, bert, "--by", "one"], place.path());
    assert_eq!(code, Some(0));
    assert!(text.contains("one person: no correlation"), "{text}");
    assert!(
        tailor::repeat::technical_errors("{}")
            .unwrap_err()
            .contains("repeat.json")
    );
}
