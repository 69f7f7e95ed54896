//! Whether there are photos enough, and as many as were promised; copies of another photo do not count.

use crate::error::CaptureError;

/// Copies, each with the photo that it is a copy of.
fn listed(copies: &[(String, String)]) -> String {
    let one = |(copy, first): &(String, String)| format!("{copy} = {first}");
    copies.iter().map(one).collect::<Vec<_>>().join(", ")
}

/// As many photos as `views` promises, if it is given.
pub(crate) fn as_many_as_promised(
    found: usize,
    copies: &[(String, String)],
    promised: Option<usize>,
) -> Result<(), CaptureError> {
    match promised.filter(|promised| *promised != found) {
        None => Ok(()),
        Some(promised) => Err(CaptureError::count(promised, found, &listed(copies))),
    }
}

/// No fewer than a turn has.
pub(crate) fn enough(
    found: usize,
    copies: &[(String, String)],
    least: u32,
) -> Result<(), CaptureError> {
    match (found >= least as usize, copies.is_empty()) {
        (true, _) => Ok(()),
        (_, true) => Err(CaptureError::TooFew { found, least }),
        _ => Err(CaptureError::Copies {
            found,
            files: found + copies.len(),
            least,
            copies: listed(copies),
        }),
    }
}

/// The first `keep` of each `of`, and of how many even steps each is then one, where they are even.
pub(crate) fn thinned<T>(all: Vec<T>, [keep, of]: [usize; 2]) -> (Vec<T>, Option<usize>) {
    let kept = all.into_iter().enumerate().filter(|(i, _)| i % of < keep);
    let even = match (keep < of, keep) {
        (false, _) => Some(1),
        (true, 1) => Some(of),
        _ => None,
    };
    (kept.map(|(_, item)| item).collect(), even)
}

/// Of n times `about` one of each n, and n; all of fewer than twice as many, and if `about` is 0.
pub(crate) fn one_of_each<T>(all: Vec<T>, about: usize) -> (Vec<T>, usize) {
    let each = all.len().checked_div(about).unwrap_or(1).max(1);
    (thinned(all, [1, each]).0, each)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_of_three_views_are_left() {
        let left = |by| thinned((0..7).collect(), by);
        assert_eq!(left([2, 3]), (vec![0, 1, 3, 4, 6], None));
        assert_eq!(left([1, 3]), (vec![0, 3, 6], Some(3)));
        assert_eq!(left([5, 3]).1, Some(1));
    }

    #[test]
    fn of_many_views_about_as_many_are_left_as_are_wanted() {
        let left = |count: usize, about| {
            let (left, each) = one_of_each((0..count).collect(), about);
            (left.len(), left[1], each)
        };
        assert_eq!(left(72, 18), (18, 4, 4));
        assert_eq!(left(35, 18), (35, 1, 1));
        assert_eq!(left(40, 18), (20, 2, 2));
        assert_eq!(left(10, 18), (10, 1, 1));
        assert_eq!(left(72, 0), (72, 1, 1));
    }
}
