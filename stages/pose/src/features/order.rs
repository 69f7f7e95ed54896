//! Whether each photo is where it belongs in the turn, by the features that photos have in common.

use std::collections::{BTreeMap, BTreeSet};

/// How many matches pairs of photos have, the earlier photo first.
pub(crate) type Shared = BTreeMap<(usize, usize), usize>;

/// A photo that belongs between two that it is not between.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Misplaced {
    /// The photo.
    pub(crate) photo: usize,
    /// Those that it belongs between, the second after the first.
    pub(crate) between: [usize; 2],
}

/// What counts may differ by, by chance: three standard deviations (derived: counts are Poisson's).
const CHANCE_SIGMAS: f64 = 3.0;

/// Photos whose neighbours share more with each other than with it: only these may belong far away. `photos` in turning
/// order, which closes.
pub(crate) fn doubtful(shared: &Shared, photos: usize) -> Vec<usize> {
    let order: Vec<usize> = (0..photos).collect();
    let is = |i: &usize| {
        let [before, after, across] = here(shared, &order, *i);
        before + after < across
    };
    (0..photos).filter(is).collect()
}

/// Photos that belong elsewhere: the path through all of them gains, in what any two in a row have in common, by putting
/// one after the other of these where that gains most, each by more than chance.
pub(crate) fn misplaced(shared: &Shared, photos: usize) -> Vec<Misplaced> {
    let mut order: Vec<usize> = (0..photos).collect();
    let mut moved = BTreeSet::new();
    for _ in 0..photos {
        let Some((from, to)) = best_move(shared, &order) else {
            break;
        };
        let (photo, behind) = (order[from], order[to]);
        order.retain(|p| *p != photo);
        let at = order.iter().take_while(|p| **p != behind).count();
        order.insert(at + 1, photo);
        moved.insert(photo);
    }
    let found = |photo: usize| {
        let at = order.iter().take_while(|p| **p != photo).count();
        let between = [order[(at + photos - 1) % photos], order[(at + 1) % photos]];
        Misplaced { photo, between }
    };
    moved.into_iter().map(found).collect()
}

/// The place of the photo that gains most by going behind another place, with that place.
fn best_move(shared: &Shared, order: &[usize]) -> Option<(usize, usize)> {
    let places = 0..order.len();
    let moves = places
        .clone()
        .flat_map(|i| places.clone().map(move |j| (i, j)));
    let best = moves
        .filter_map(|(i, j)| Some((gain(shared, order, i, j)?, (i, j))))
        .max_by(|a, b| a.0.total_cmp(&b.0))?;
    (best.0 > 0.0).then_some(best.1)
}

/// By how much more than chance a path through the photos gains where that at place `i` goes behind place `j`; none where
/// that changes nothing.
fn gain(shared: &Shared, order: &[usize], i: usize, j: usize) -> Option<f64> {
    let n = order.len();
    if i == j || (j + 1) % n == i {
        return None;
    }
    let [before, after, across] = here(shared, order, i);
    let (a, b) = (order[j], order[(j + 1) % n]);
    let [first, second, open] =
        [(order[i], a), (order[i], b), (a, b)].map(|(a, b)| number(shared, a, b));
    let by = first + second - open - before - after + across;
    let sigma = (before + after + across + first + second + open).sqrt();
    Some(by - CHANCE_SIGMAS * sigma)
}

/// What a photo shares with the one before and the one after it, and those with each other.
fn here(shared: &Shared, order: &[usize], i: usize) -> [f64; 3] {
    let n = order.len();
    let (before, after) = (order[(i + n - 1) % n], order[(i + 1) % n]);
    [(before, order[i]), (order[i], after), (before, after)].map(|(a, b)| number(shared, a, b))
}

fn number(shared: &Shared, a: usize, b: usize) -> f64 {
    shared.get(&(a.min(b), a.max(b))).map_or(0.0, |n| *n as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    const PHOTOS: usize = 12;

    /// What photos in such an order share: less by what they are apart, and nothing beyond 90°; photo 7 is blurred.
    fn turn(order: [usize; PHOTOS]) -> Shared {
        let mut shared = Shared::new();
        for a in 0..PHOTOS {
            for b in a + 1..PHOTOS {
                let apart = order[a].abs_diff(order[b]);
                let count = [0, 200, 100, 40].get(apart.min(PHOTOS - apart));
                let blur = if [order[a], order[b]].contains(&7) {
                    10
                } else {
                    1
                };
                shared.insert((a, b), count.copied().unwrap_or(3) / blur);
            }
        }
        shared
    }

    #[test]
    fn a_turn_in_order_is_in_order_although_a_photo_is_blurred() {
        let shared = turn(std::array::from_fn(|i| i));
        assert_eq!(misplaced(&shared, PHOTOS), []);
        assert_eq!(doubtful(&shared, PHOTOS), [7]);
    }

    #[test]
    fn exchanged_photos_are_named_with_their_place() {
        let mut order: [usize; PHOTOS] = std::array::from_fn(|i| i);
        order.swap(1, 5);
        let shared = turn(order);
        assert!([1, 5].iter().all(|i| doubtful(&shared, PHOTOS).contains(i)));
        let found = misplaced(&shared, PHOTOS);
        let names: Vec<usize> = found.iter().map(|m| m.photo).collect();
        assert_eq!(names, [1, 5], "{found:?}");
        assert_eq!([found[0].between, found[1].between], [[4, 6], [0, 2]]);
        order.swap(1, 5);
        order.swap(3, 4);
        assert_eq!(misplaced(&turn(order), PHOTOS).len(), 1);
    }
}
