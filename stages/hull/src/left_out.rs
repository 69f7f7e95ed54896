//! The warning of parts of a hull that are apart from it.

use stage::{Message, message};

stage::messages! {
    PIECES = "warn-hull-pieces": "the hull is in pieces: only the largest was kept, and {left_out:.1 %} of the volume left out; look where the masks cut the body through";
    PARTS = "warn-hull-parts": "smaller parts left out: {count}, {left_out:.1 %} of the volume in all; if a part of the body is missing, look at the masks";
}
/// Other parts than the largest are warned of from this share of the volume on. By hand: not on record.
const WARNED_SHARE: f64 = 0.01;
/// From this share on the body itself is in pieces. By hand: looked at a leg, which is a sixth of a body (Dempster
/// 1955).
const IN_PIECES_SHARE: f64 = 0.15;

/// The warning of the parts that were left out, beside the one that was kept. \[mm³\]
pub(crate) fn left_out(kept: f64, rest: &[f64]) -> Option<Message> {
    let small: f64 = rest.iter().map(|v| v.abs()).sum();
    let share = small / (kept + small);
    let percent = 100.0 * share;
    if share > IN_PIECES_SHARE {
        return Some(message!(PIECES, left_out = percent));
    }
    (share > WARNED_SHARE).then(|| message!(PARTS, count = rest.len(), left_out = percent))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_that_were_left_out_are_counted_and_a_body_in_pieces_is_named() {
        assert_eq!(left_out(70.0, &[0.1, 0.2]), None);
        let one = left_out(70.0, &[2.0]).unwrap();
        assert!(
            one.starts_with("smaller parts left out: 1, 2.8 % of the volume"),
            "{one}"
        );
        // Of two halves, as many litres were left out as kept: no more than half of the whole.
        let half = left_out(35.0, &[-34.0, 1.0]).unwrap();
        assert!(
            half.contains("in pieces") && half.contains("50.0 %"),
            "{half}"
        );
    }
}
