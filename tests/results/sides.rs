//! Many sides in a real browser: tables fit a page.

use super::chromium::Tab;
use super::comparisons::folder;
use serde_json::{Value, json};
use tailor::compare::{Side, TechnicalErrors, compare, markdown, page};

#[test]
#[cfg_attr(not(chromium), ignore = "no Chromium is installed")]
fn tables_of_three_sides_with_long_names_fit_a_page() {
    let place = tempfile::tempdir().unwrap();
    let names = [
        "as-is",
        "weighted_median+hull.voxel_mm=2.5",
        "weighted_median+body.lambda=0.3+body.iterations=120",
    ];
    let side = |(k, name): (usize, &&str)| {
        let folder = folder(
            place.path(),
            &k.to_string(),
            "3.0",
            &format!("h{k}"),
            80.0,
            100.0,
        );
        let labels = [
            "waist",
            "left upper arm, in its middle",
            "hip, where it is widest",
        ];
        let girth = |i: usize| {
            let (name, cm) = (format!("G{i}_L"), 80.0 + (i * k) as f64);
            json!({ "name": name, "label": labels[i % 3], "cm": cm, "tape_cm": cm, "interval_cm": [cm - 1.5, cm + 1.5] })
        };
        let girths: Vec<Value> = (0..18).map(girth).collect();
        let file = json!({ "unit": "cm", "girths": girths });
        std::fs::write(folder.join("girths.json"), file.to_string()).unwrap();
        Side::from_folder(name, &folder).unwrap()
    };
    let sides: Vec<Side> = names.iter().enumerate().map(side).collect();
    let c = compare(sides, None, &TechnicalErrors::new());
    let words = markdown(&c, &tailor::reader::English);
    assert!(words.contains("| girth "), "{words}");
    let rows = words.lines().filter(|l| l.starts_with("| G0_L"));
    assert_eq!(rows.count(), 2, "a row a side: {words}");
    let mut tab = Tab::open(&page(&c, false), [1280, 900], false, false);
    let out = tab.value(
        "[...document.querySelectorAll('section')].filter((s) => s.scrollWidth > s.clientWidth + 1).map((s) => s.querySelector('h2').textContent)",
    );
    assert_eq!(out, json!([]), "cards that scroll at 1280 px");
    assert_eq!(
        tab.value("document.documentElement.scrollWidth <= document.documentElement.clientWidth"),
        true
    );
}
