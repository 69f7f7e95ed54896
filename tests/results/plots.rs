//! Plots of sweeps in a real browser: small multiples with intervals and lines of reference, maps, tables that fit a page.

use super::chromium::Tab;
use stage::{Metric, Value};
use tables::{Behind, Reference};
use tailor::sweep::{End, Point, Row};

const DESK: [u32; 2] = [1280, 900];

/// A point over two params, repeated, by two methods: two metrics in millimetres.
fn row(i: usize, replicate: Option<u32>) -> Row {
    let (x, y) = ([1.0, 10.0, 100.0][i / 2 % 3], (i / 6 % 4) as f64);
    let method = ["rigid", "weighted_median"][i % 2];
    let metric = |name: &str, value: f64| {
        let unit = "mm tape".into();
        (
            name.to_owned(),
            Some(Metric {
                name: name.into(),
                value,
                unit,
            }),
        )
    };
    let noise = f64::from(replicate.unwrap_or(1)) * 0.3;
    let waist = libm::log10(x) + y + noise + (i % 2) as f64;
    Row {
        point: Point {
            variant: Some(method.into()),
            values: vec![
                ("body".into(), "lambda".into(), Value::Float(x)),
                ("sway".into(), "sway_mm".into(), Value::Float(y)),
            ],
            replicate,
            seeds: vec![],
        },
        end: End::Done,
        metrics: vec![
            metric("error.WC", waist),
            metric("error.HC", waist * 0.5 - 1.0),
        ],
        within: vec![],
        known: vec![],
        results: vec![],
        made: 1,
        found: 3,
        seconds: 1.0,
        alone: 2.0,
        work: 1.0,
        engine: 0.1,
    }
}

fn limits(metric: &str, _: &str) -> Vec<Reference> {
    let line = |label: &str, value: f64| Reference {
        label: label.into(),
        value,
    };
    match metric.starts_with("error.") {
        true => vec![
            line("truth", 0.0),
            line("ISO 20685-1", 9.0),
            line("ISO 20685-1", -9.0),
        ],
        false => vec![],
    }
}

fn count(tab: &mut Tab, selector: &str) -> u64 {
    let count = tab.value(&format!("document.querySelectorAll({selector:?}).length"));
    count.as_u64().unwrap()
}

#[test]
#[cfg_attr(not(chromium), ignore = "no Chromium is installed")]
fn small_multiples_have_intervals_references_and_equal_scales() {
    let rows: Vec<Row> = (0..24)
        .flat_map(|i| (1..=3).map(move |r| row(i, Some(r))))
        .collect();
    let shown = tables::page("s", "Which?", &rows, &limits, &|row| {
        let link = (
            "body".to_owned(),
            "why".to_owned(),
            format!("points/{}", row.made),
        );
        Behind {
            commands: vec!["tailor run".into()],
            links: vec![link],
        }
    });
    let mut tab = Tab::open(&shown.page, DESK, false, false);
    // Two metrics over three params, and a map of each.
    assert_eq!(count(&mut tab, "#view figure"), 8);
    assert_eq!(
        count(&mut tab, "#view figure:nth-child(1) circle"),
        24,
        "means, not points"
    );
    let dashed = "figure:nth-child(2) line[stroke-dasharray]";
    assert_eq!(count(&mut tab, dashed), 3, "truth and both limits");
    let heights = |tab: &mut Tab, plot: usize| {
        tab.value(&format!("[...document.querySelectorAll('figure:nth-child({plot}) line[stroke-dasharray]')].map((l) => l.getAttribute('y1'))"))
    };
    assert_eq!(
        heights(&mut tab, 2),
        heights(&mut tab, 5),
        "waist and hip have one scale"
    );
    // λ of 1, 10, 100: the middle one is in the middle.
    let xs = tab.value("[...new Set([...document.querySelectorAll('figure:nth-child(2) svg > text[text-anchor=middle]')].map((t) => t.textContent))]");
    assert_eq!(xs, serde_json::json!(["1", "10", "100"]));
    assert_eq!(
        count(&mut tab, "figure:nth-child(7) rect"),
        24,
        "a cell a point, both methods"
    );
    assert_eq!(count(&mut tab, "#points tbody tr"), 24);
    assert_eq!(count(&mut tab, "#all tbody tr"), 72);
    assert_eq!(count(&mut tab, "#all details pre"), 72);
    tab.click("figure:nth-child(7) a:nth-of-type(3)");
    assert_eq!(
        tab.value("location.hash.startsWith('#points-')"),
        true,
        "a cell leads to its row"
    );
    fits(&mut tab);
    // Every plot is a file by itself, and its numbers another.
    let svg = shown
        .plots
        .iter()
        .filter(|(name, _)| name.ends_with(".svg"));
    for (name, text) in svg {
        assert!(text.starts_with("<svg xmlns"), "{name}");
        let data = name.replace(".svg", ".csv");
        assert!(
            shown
                .plots
                .iter()
                .any(|(n, t)| *n == data && t.lines().count() > 2),
            "{data}"
        );
    }
    assert_eq!(shown.plots.len(), 2 * 9);
}

/// No table reaches out of its card.
#[track_caller]
fn fits(tab: &mut Tab) {
    let out = tab.value(
        "[...document.querySelectorAll('section')].filter((s) => s.scrollWidth > s.clientWidth + 1).map((s) => s.querySelector('h2').textContent)",
    );
    assert_eq!(out, serde_json::json!([]), "cards that scroll at 1280 px");
}
