//! How a sweep that cannot be is refused, and how much one is before it runs.

use crate::points::PIPELINE;
use crate::toys::CATALOG;
use engine::recipe::{Overrides, open_text, read};
use engine::sweep::{Points, axes, outlook};
use std::path::Path;

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
        "200000 points, 200202 results unless cached, about 31.1 h if none is, going by earlier runs (not known how long: src)"
    );
}

#[test]
fn mistakes_of_a_sweep_are_reported_with_their_places() {
    for (declared, place, what) in [
        ("over.mad = { n = [1] }", 2, "there is no node `mad`"),
        (
            "over.mid = { m = [1] }",
            2,
            "toy.mid: there is no param `m`",
        ),
        ("over.mid = { n = [1, 5000000] }", 2, "out of range"),
        (
            "over.mid = { n = { from = 1, to = 5000001, steps = 3 } }",
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
            "`mid` (toy.mid) has no `tenfolt`; did you mean `tenfold`? it has: tenfold, seconds, bytes",
        ),
        (
            "with = [\"double\", \"triple\"]\ntell = \"src.tenfold\"",
            3,
            "`src` (toy.clean) has no `tenfold`; it has: seconds, bytes",
        ),
        ("over.mid = { n = [1] }\nzip = [\"mid.m\"]", 3, "`mid.m`"),
        ("about = \"?\"", 1, "needs `over`"),
        ("over.mid = { n = [] }", 2, "takes no value"),
    ] {
        let text = format!("{PIPELINE}[sweep.s]\n{declared}\n");
        let Err(reported) = open_text("toy.toml", &text, &Overrides::default(), &CATALOG) else {
            panic!("{declared}: no mistake was found");
        };
        let reported = reported.json()["mistakes"][0].clone();
        let line = PIPELINE.lines().count() + place;
        assert!(
            reported["what"].as_str().unwrap().contains(what),
            "{declared}: {reported}"
        );
        assert_eq!(reported["line"], line, "{declared}: {reported}");
    }
}
