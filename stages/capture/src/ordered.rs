//! Much done at once; of several errors the first in order, not the first in time.

use rayon::prelude::*;

/// All results, or the error of the first that has one, whatever the number of threads.
///
/// # Errors
///
/// The first error in order.
pub(crate) fn in_order<T: Send, E: Send>(
    all: impl ParallelIterator<Item = Result<T, E>>,
) -> Result<Vec<T>, E> {
    all.collect::<Vec<_>>().into_iter().collect()
}

#[cfg(test)]
mod tests {
    use super::in_order;
    use rayon::prelude::*;

    #[test]
    fn the_first_error_in_order_wins_though_a_later_one_is_sooner() {
        let slow = |k: u64| {
            std::thread::sleep(std::time::Duration::from_millis(40 - 4 * k));
            if k > 2 { Err(k) } else { Ok(k) }
        };
        for _ in 0..5 {
            assert_eq!(in_order((0..10u64).into_par_iter().map(slow)), Err(3));
        }
        assert_eq!(
            in_order((0..3u64).into_par_iter().map(slow)),
            Ok(vec![0, 1, 2])
        );
    }
}
