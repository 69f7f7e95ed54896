//! Where a profile that is read in rows is farthest, between them.

/// The top, or the bottom, of the parabola through a row and both beside it, each a place and a value: no farther than half a row from the
/// middle one, if that is the greatest or the least. The middle one where all are on a line.
pub(crate) fn between_rows([low, middle, high]: [(f64, f64); 3]) -> f64 {
    let up = (middle.1 - low.1) / (middle.0 - low.0);
    let on = (high.1 - middle.1) / (high.0 - middle.0);
    if up == on {
        return middle.0;
    }
    // Slopes are those midway between rows; where they come to nought, in between.
    let (from, to) = ((low.0 + middle.0) / 2.0, (middle.0 + high.0) / 2.0);
    from + (to - from) * up / (up - on)
}

/// The same of the row of rising places that is farthest, however rows are laid; an end is where it is. `None` without rows.
pub(crate) fn farthest(rows: &[(f64, f64)]) -> Option<(usize, f64)> {
    let k = (0..rows.len()).max_by(|a, b| rows[*a].1.total_cmp(&rows[*b].1))?;
    let inner = k > 0 && k + 1 < rows.len();
    let place = inner.then(|| between_rows([rows[k - 1], rows[k], rows[k + 1]]));
    Some((k, place.unwrap_or(rows[k].0)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_parabola_is_farthest_at_its_top_however_rows_are_laid() {
        let bend = |z: f64| 7.0 - 0.01 * (z - 41.3).powi(2);
        for k in 0..20 {
            // Unevenly, too.
            let at = |i: i32| 0.2 * f64::from(k) + 4.0 * f64::from(i) + f64::from(i % 3);
            let rows: Vec<(f64, f64)> = (0..20).map(|i| (at(i), bend(at(i)))).collect();
            proof::near(farthest(&rows).unwrap().1, 41.3, 1e-9);
        }
    }

    #[test]
    fn what_is_flat_or_farthest_at_its_end_is_at_a_row() {
        assert_eq!(farthest(&[]), None);
        let rising = [(0.0, 1.0), (1.0, 2.0), (2.0, 4.0)];
        assert_eq!(farthest(&rising), Some((2, 2.0)));
        let flat = [(0.0, 1.0), (1.0, 1.0), (2.0, 1.0)];
        assert_eq!(between_rows(flat), 1.0);
        // Two rows alike: midway.
        let even = [(0.0, 0.0), (1.0, 2.0), (2.0, 2.0), (3.0, 0.0)];
        proof::near(farthest(&even).unwrap().1, 1.5, 1e-12);
    }
}
