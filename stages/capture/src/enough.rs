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

/// The first `keep` of each `of`.
pub(crate) fn thinned<T>(all: Vec<T>, keep: usize, of: usize) -> Vec<T> {
    let kept = all.into_iter().enumerate().filter(|(i, _)| i % of < keep);
    kept.map(|(_, item)| item).collect()
}

#[cfg(test)]
mod tests {
    #[test]
    fn two_of_three_views_are_left() {
        assert_eq!(super::thinned((0..7).collect(), 2, 3), [0, 1, 3, 4, 6]);
    }
}
