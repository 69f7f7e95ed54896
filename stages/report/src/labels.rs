//! Labels beside a drawing, moved apart so that none covers another.

/// Places of labels that want to be at these places, in ascending order, each at least `gap` from the
/// next and all within `low..=high` where they fit: the least sum of squares of moves (isotonic regression,
/// pool adjacent violators; Ayer et al. 1955).
pub(crate) fn spread(wanted: &[f64], gap: f64, [low, high]: [f64; 2]) -> Vec<f64> {
    // Less the gaps of those before, places have only to ascend.
    let mut pools: Vec<(f64, usize)> = Vec::new();
    for (i, at) in wanted.iter().enumerate() {
        let mut pool = (at - gap * i as f64, 1);
        while let Some(before) = pools.last().filter(|b| b.0 > pool.0) {
            let count = before.1 + pool.1;
            let mean = (before.0 * before.1 as f64 + pool.0 * pool.1 as f64) / count as f64;
            pool = (mean, count);
            pools.pop();
        }
        pools.push(pool);
    }
    let top = (high - gap * wanted.len().saturating_sub(1) as f64).max(low);
    let places = pools
        .iter()
        .flat_map(|(at, n)| vec![at.clamp(low, top); *n]);
    places
        .enumerate()
        .map(|(i, at)| at + gap * i as f64)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proof::Dice;

    #[test]
    fn labels_that_are_clear_of_each_other_stay() {
        let clear = [10.0, 30.0, 45.0];
        assert_eq!(spread(&clear, 12.0, [0.0, 100.0]), clear);
        assert_eq!(spread(&[50.0, 50.0], 12.0, [0.0, 100.0]), [44.0, 56.0]);
        assert_eq!(spread(&[98.0, 99.0], 12.0, [0.0, 100.0]), [88.0, 100.0]);
        assert!(spread(&[], 12.0, [0.0, 1.0]).is_empty());
    }

    #[test]
    fn no_label_covers_another() {
        let mut dice = Dice(1);
        for _ in 0..256 {
            let count = 1 + dice.bits() % 8;
            let mut wanted: Vec<f64> = (0..count).map(|_| dice.within(-50.0, 150.0)).collect();
            wanted.sort_by(f64::total_cmp);
            let placed = spread(&wanted, 12.0, [0.0, 100.0]);
            assert_eq!(placed.len(), wanted.len());
            assert!(
                placed.windows(2).all(|p| p[1] - p[0] > 12.0 - 1e-9),
                "{wanted:?}"
            );
            let inside = |p: &f64| (-1e-9..=100.0 + 1e-9).contains(p);
            assert!(placed.iter().all(inside), "{wanted:?}");
        }
    }
}
