//! What girths of made bodies come to, end to end, as `models/tables/girths.csv` has it: errors and intervals of
//! those whose levels no model tells.

use std::path::Path;

/// Error of a tape as a share, and whether the interval holds the truth.
fn errors(girth: &str) -> Vec<(f64, bool)> {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../models/tables/girths.csv");
    let mut table = csv::Reader::from_path(file).unwrap();
    let mut all = Vec::new();
    for row in table.records() {
        let row = row.unwrap();
        let families = ["range/", "reach/", "survey/"];
        let own = families.iter().any(|f| row[0].starts_with(f)) && row[1].starts_with(girth);
        // Without an interval a girth makes no promise.
        if own && row[2].is_empty() && !row[4].is_empty() {
            let number = |k: usize| row[k].parse::<f64>().unwrap();
            let (tape, truth) = (number(3), number(6));
            let inside = (number(4)..=number(5)).contains(&truth);
            all.push(((tape / truth - 1.0).abs(), inside));
        }
    }
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    all
}

#[test]
fn hips_and_calves_are_right_and_their_intervals_hold() {
    for (girth, middle, nine) in [("HC", 0.003, 0.008), ("CFC_", 0.005, 0.015)] {
        let all = errors(girth);
        assert!(all.len() > 700, "{girth}: {}", all.len());
        let at = |q: f64| all[((all.len() - 1) as f64 * q) as usize].0;
        assert!(
            at(0.5) <= middle && at(0.9) <= nine,
            "{girth}: {} {}",
            at(0.5),
            at(0.9)
        );
    }
    // Conservative: the surface's part is that of a worse surface than these.
    for girth in ["HC", "TC_", "CFC_", "AC_"] {
        let all = errors(girth);
        let share = all.iter().filter(|e| e.1).count() as f64 / all.len() as f64;
        assert!(share >= 0.87, "{girth}: {share}");
    }
}
