//! The ground below a body: its soles, compared with the ground of the cameras.

use crate::features::soles::{Soles, soles};
use shape::{Mesh, Refusal, Unit};
use stage::{Message, message};

stage::messages! {
    FEET_LOST = "warn-feet-lost": "the surface ends {end} above the ground without feet: they are lost, and heights are measured from the ground";
    BELOW_SOLES = "warn-ground-below": "the ground from the cameras is {far} below the soles on the surface: the body is not on it; heights and stature are measured from the soles";
    ABOVE_SOLES = "warn-ground-above": "the ground from the cameras is {far} above the soles on the surface: the body is not on it; heights and stature are measured from the soles";
}

/// A ground that cameras tell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GivenGround {
    /// Its height. \[mm\]
    pub height_mm: f64,
    /// Whether it is the mat or the disk that the body was photographed on; else it was only given.
    pub firm: bool,
    /// Its standard deviation, as far as it is known. \[mm\]
    pub sigma_mm: f64,
    /// What lengths are in.
    pub unit: Unit,
}

/// Where a body is on the ground.
#[derive(Debug, Clone, PartialEq)]
pub struct Ground {
    /// Height of the ground. \[mm\]
    pub height_mm: f64,
    /// Its standard deviation. \[mm\]
    pub sigma_mm: f64,
    /// Whether feet show on it: a body with feet is not cut off below.
    pub feet: bool,
    /// What the user should know: a sentence.
    pub word: Option<Message>,
}

/// Soles and a ground that is only given agree within this, as a share of the body's height.
/// By hand: looked at three scans and five captures, at 0.7 and 1.4 of it: nothing changes.
const AGREEING_SHARE: f64 = 0.012;
/// A surface of feet on a mat or a disk ends within this of it, as a share of the body's height: nobody sees soles, and
/// shadows beside them are cut off or taken in. By hand: looked at three scans and five captures, at 0.7 and
/// 1.4 of it: nothing changes.
const END_SHARE: f64 = 0.03;
/// From a mat or a disk up to here feet may be lost, as a share of the body's height: ankles are seen. The malleolus is
/// at 0.030 to 0.053 (ANSUR II).
pub(crate) const LOST_SHARE: f64 = 0.08;
/// Standard deviation of a ground where the feet are lost, as a share of the body's height.
/// By hand: looked at three scans and five captures, at 0.7 and 1.4 of it: nothing changes.
const UNSEEN_SIGMA: f64 = 0.004;

/// The ground of an upright body. Soles that the surface shows and a ground of the cameras are compared
/// against each other; where they disagree and neither can be trusted, there is none.
///
/// # Errors
///
/// [`Refusal::NoGround`] where neither is there or to be trusted, or the mesh is empty.
pub fn ground(mesh: &Mesh, reported: Option<&GivenGround>) -> Result<Ground, Refusal> {
    let (low, high) = mesh.bounds().ok_or(Refusal::NoGround)?;
    let (tall, found) = (high.z - low.z, soles(mesh));
    let by_soles = |s: &Soles, word: Option<Message>| Ground {
        height_mm: s.height,
        sigma_mm: s.sigma,
        feet: s.sure,
        word,
    };
    let Some(reported) = reported else {
        let sure = found.filter(|s| s.sure).ok_or(Refusal::NoGround)?;
        return Ok(by_soles(&sure, None));
    };
    let as_given = |more: f64, word: Option<Message>| Ground {
        height_mm: reported.height_mm,
        sigma_mm: libm::hypot(reported.sigma_mm, more),
        feet: found.is_some_and(|s| s.sure),
        word,
    };
    let Some(found) = found else {
        return match reported.firm {
            true => Ok(as_given(UNSEEN_SIGMA * tall, None)),
            false => Err(Refusal::NoGround),
        };
    };
    let off = found.height - reported.height_mm;
    match (reported.firm, found.sure) {
        (true, _) if off.abs() <= END_SHARE * tall => Ok(as_given(0.0, None)),
        (_, true) => {
            let word = (off.abs() > AGREEING_SHARE * tall).then(|| apart(off, reported.unit));
            Ok(by_soles(&found, word))
        }
        (false, false) if off.abs() <= AGREEING_SHARE * tall => Ok(as_given(found.sigma, None)),
        (true, false) if (0.0..=LOST_SHARE * tall).contains(&off) => Ok(as_given(
            UNSEEN_SIGMA * tall,
            Some(message!(FEET_LOST, end = reported.unit.field(off))),
        )),
        _ => Err(Refusal::NoGround),
    }
}

/// What is reported of a ground that the body does not touch.
fn apart(off: f64, unit: Unit) -> Message {
    let far = unit.field(off.abs());
    match off > 0.0 {
        true => message!(BELOW_SOLES, far = far),
        false => message!(ABOVE_SOLES, far = far),
    }
}
