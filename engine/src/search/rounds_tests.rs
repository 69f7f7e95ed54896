//! Searches on surfaces given by formula.

use super::*;

/// A bowl with ripples, whose floor is 0 at (0.3, 7).
fn surface(x: f64, y: f64) -> f64 {
    let (u, v) = (x - 0.3, (y - 7.0) / 10.0);
    let ripple = 0.02 * (2.0 - libm::cos(25.0 * u) - libm::cos(25.0 * v));
    u * u + v * v + ripple
}

fn declared(more: &str) -> Search {
    let text = format!(
        "[search.s]\nover.a = {{ x = {{ from = 0.0, to = 1.0 }}, y = {{ from = 0.0, to = 10.0 }} }}\nleast = \"a.z\"\n{more}\n"
    );
    crate::recipe::read(&text).unwrap().searches.remove(0)
}

fn number(v: &Value) -> f64 {
    match v {
        Value::Float(x) => *x,
        Value::Int(i) => *i as f64,
        other => panic!("{other}"),
    }
}

fn found(declared: &Search) -> Found {
    let run = |round: &Round<'_>| -> Result<Values, ()> {
        let z = |row: &Vec<Value>| {
            // A third param makes points dear; cheap ones are off, but alike.
            let off = row.get(2).map_or(0.0, |n| 0.1 / number(n));
            surface(number(&row[0]), number(&row[1])) + off
        };
        Ok(round
            .axis
            .rows
            .iter()
            .map(|row| (None, Some(z(row))))
            .collect())
    };
    search(declared, run).unwrap()
}

#[test]
fn a_search_finds_what_a_grid_of_ten_times_the_points_finds() {
    // 20 × 20 points, ends included.
    let at = |i: usize| i as f64 / 19.0;
    let grid = (0..400)
        .map(|i| surface(at(i % 20), 10.0 * at(i / 20)))
        .fold(f64::MAX, f64::min);
    let mut beaten = 0;
    for seed in 1..=9 {
        let narrowed = found(&declared(&format!(
            "method = \"narrowing\"\nbudget = 40\nseed = {seed}"
        )));
        assert!(narrowed.cost() <= 40.0);
        beaten += usize::from(narrowed.best.unwrap().value.unwrap() <= grid);
    }
    assert!(beaten >= 7, "{beaten} of 9 seeds find the grid's");
}

#[test]
fn every_method_keeps_to_its_budget_and_is_the_same_again() {
    for more in [
        "method = \"random\"",
        "method = \"hypercube\"",
        "method = \"narrowing\"",
        "method = \"halving\"\ndear.a = { n = { from = 1, to = 9 } }",
    ] {
        let declared = declared(&format!("{more}\nbudget = 30"));
        let one = found(&declared);
        assert!(one.cost() <= 30.0 + 1e-9, "{more}: {}", one.cost());
        assert!(one.cost() > 25.0, "{more}: {}", one.cost());
        assert_eq!(found(&declared), one, "{more}");
        let best = one.best.unwrap();
        let full = one.tried.iter().filter(|t| t.cost >= 1.0);
        assert_eq!(
            best.value,
            full.map(|t| t.value)
                .min_by(|a, b| a.partial_cmp(b).unwrap())
                .unwrap()
        );
    }
}

#[test]
fn mistakes_of_a_search_are_reported() {
    for (more, what) in [
        ("budget = 0", "how many whole points"),
        (
            "method = \"hypercub\"\nbudget = 3",
            "did you mean `hypercube`",
        ),
        ("method = \"halving\"\nbudget = 3", "what makes points dear"),
        (
            "budget = 3\nsample = { points = 3 }",
            "chooses its points itself",
        ),
        ("", "needs a `budget`"),
    ] {
        let text = format!("[search.s]\nover.a = {{ x = [1] }}\nleast = \"a.z\"\n{more}\n");
        let reported = crate::recipe::read(&text).unwrap_err();
        assert!(
            reported.iter().any(|m| m.what.contains(what)),
            "{more}: {reported:?}"
        );
    }
}
