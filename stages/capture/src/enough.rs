//! Whether there are photos enough, and as many as somebody said; copies of another are none.

use crate::error::CaptureError;

/// Copies, each with the photo that it is a copy of.
fn listed(copies: &[(String, String)]) -> String {
    let one = |(copy, first): &(String, String)| format!("{copy} = {first}");
    copies.iter().map(one).collect::<Vec<_>>().join(", ")
}

/// As many photos as was said, if that was.
pub(crate) fn as_many_as_said(
    found: usize,
    copies: &[(String, String)],
    said: Option<usize>,
) -> Result<(), CaptureError> {
    match said.filter(|said| *said != found) {
        None => Ok(()),
        Some(said) => Err(CaptureError::Count {
            said,
            found,
            copies: listed(copies),
        }),
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
