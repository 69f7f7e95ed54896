//! The fold between an arm and the trunk: where an outline, followed from the arm's outermost point, turns back.

use std::f64::consts::TAU;

/// Samples to either side of one that tell the way there.
const REACH: usize = 5;
/// An outline that has turned back by so much is the trunk's by then. \[rad\]
const BACK: f64 = 25.0 * TAU / 360.0;
/// The fold begins where the turning that is left to it is no more than this: a web's straight skin. \[rad\]
const STRAIGHT: f64 = 5.0 * TAU / 360.0;

/// Where an arm ends: an index, the outline's way there, away from the arm, how far it has turned until there, and from which
/// index on the outline is the trunk's.
pub(super) struct Fold {
    pub(super) steps: usize,
    pub(super) beyond: usize,
    pub(super) turned: f64,
    pub(super) way: [f64; 2],
}

/// Follows an outline from a point of it, `at` of so many steps, to where it turns back. `None` if it never does.
pub(super) fn fold(at: &impl Fn(usize) -> [f64; 2], count: usize, turn: f64) -> Option<Fold> {
    let way = |k: usize| {
        let (a, b) = (at(k + count - REACH), at(k + REACH));
        let (x, y) = (b[0] - a[0], b[1] - a[1]);
        let long = libm::hypot(x, y).max(1e-9);
        [x / long, y / long]
    };
    let (mut turned, mut most) = (vec![0.0f64], 0.0f64);
    let mut last = way(0);
    for k in 1..count {
        let next = way(k);
        let by = libm::atan2(
            last[0] * next[1] - last[1] * next[0],
            last[0] * next[0] + last[1] * next[1],
        );
        let now = turned[k - 1] + turn * by;
        turned.push(now);
        most = most.max(now);
        last = next;
        // Once around: nothing but the arm.
        if now > 0.75 * TAU {
            return None;
        }
        if now < most - BACK {
            let steps = turned.iter().position(|t| *t >= most - STRAIGHT)?;
            return Some(Fold {
                steps,
                beyond: k + REACH,
                turned: most,
                way: way(steps),
            });
        }
    }
    None
}
