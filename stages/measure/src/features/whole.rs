//! Whether a body is whole from crown to soles, so that its height is a stature.

use crate::features::body::Body;
use shape::Refusal;
use stage::{Message, message};

stage::messages! {
    NO_NECK = "warn-no-neck-head": "no neck was found between head and shoulders, so it is unknown whether the head is there";
}

/// A head closes round: its section just below the crown is at most so much of the one four steps lower. A flat top is
/// a stump, or the border of the photos. By hand: looked at three scans, at 0.7 and 1.4 of it: no tape changes.
const ROUND_SHARE: f64 = 0.7;

/// Why the height of what is seen is no stature, with a sentence. `None` if it is one.
pub(crate) fn no_stature(body: &Body) -> Option<(Refusal, Message)> {
    if !body.whole {
        return Some((Refusal::NoLegs, Refusal::NoLegs.message()));
    }
    let tapes: Vec<f64> = body
        .slices
        .iter()
        .rev()
        .filter_map(|s| s.rings.first().map(|r| r.tape))
        .take(5)
        .collect();
    let flat = tapes.len() < 5 || tapes[0] > ROUND_SHARE * tapes[4];
    match (flat, body.neck) {
        (true, _) => Some((Refusal::NoHead, Refusal::NoHead.message())),
        (false, None) => Some((Refusal::NoNeck, message!(NO_NECK))),
        (false, Some(_)) => None,
    }
}
