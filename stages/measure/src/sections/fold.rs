//! The fold between an arm and the trunk: where an outline, followed from the arm's outermost point, turns back.

use std::f64::consts::TAU;

/// Samples to either side of one that tell the way there (structural: samples).
const REACH: usize = 5;
/// An outline that has turned by so much has turned: back, it is the trunk's by then; round, an arm may begin. By hand: looked at three
/// scans, at 0.7 and 1.4 of it: back, no tape changes; round, tapes move by at most 0.9 and 0.34 %, intervals change by at most 153 and 7 %. \[rad\]
pub(super) const TURNED_RAD: f64 = 25.0 * TAU / 360.0;
/// Turning of an outline that counts as straight, such as a web's skin: a fold begins where no more is left to it. By
/// hand: looked at three scans, at 0.7 and 1.4 of it: tapes move by at most 0.07 and 0.05 %, intervals change by at
/// most 1 and 3 %. \[rad\]
pub(super) const STRAIGHT_RAD: f64 = 5.0 * TAU / 360.0;

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
        if now < most - TURNED_RAD {
            let steps = turned.iter().position(|t| *t >= most - STRAIGHT_RAD)?;
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

#[cfg(test)]
mod tests {
    use super::*;

    /// The outline of an arm of 50 mm beside a trunk of 150 mm whose middles are so far apart, from the arm's outermost point on,
    /// clockwise, a sample a millimetre; and how many of them are the arm's.
    fn outline(apart: f64) -> (Vec<[f64; 2]>, usize) {
        let (arm, trunk) = (50.0f64, 150.0f64);
        let x = (arm * arm - trunk * trunk + apart * apart) / (2.0 * apart);
        let y = (arm * arm - x * x).max(0.0).sqrt();
        let (end, from) = (libm::atan2(y, x), libm::atan2(y, x - apart));
        let arc = |at: f64, radius: f64, from: f64, to: f64| {
            let steps = (radius * (from - to).abs()) as usize;
            let angle = move |k: usize| from + (to - from) * k as f64 / steps as f64;
            (0..steps)
                .map(move |k| libm::sincos(angle(k)))
                .map(move |(s, c)| [at + radius * c, radius * s])
        };
        let upper = arc(0.0, arm, TAU / 2.0, end);
        let lower = arc(0.0, arm, -end, -TAU / 2.0);
        let own = upper.clone().count();
        let round = arc(apart, trunk, from, -from);
        (upper.chain(round).chain(lower).collect(), own)
    }

    #[test]
    fn an_arm_ends_where_its_outline_turns_back_to_the_trunk_and_alone_it_ends_nowhere() {
        for apart in [160.0, 180.0, 195.0] {
            let (points, own) = outline(apart);
            let n = points.len();
            let there = fold(&|k| points[k % n], n, -1.0).unwrap();
            let back = fold(&|k| points[(2 * n - k) % n], n, 1.0).unwrap();
            for found in [&there, &back] {
                let turned = own as f64 / 50.0;
                assert!(
                    (found.turned - turned).abs() < 2.0 * STRAIGHT_RAD,
                    "{apart}: {}",
                    found.turned
                );
                assert!(
                    (own - 2 * REACH..=own).contains(&found.steps),
                    "{apart}: {}",
                    found.steps
                );
                assert!(
                    (own..=own + 2 * REACH).contains(&found.beyond),
                    "{apart}: {}",
                    found.beyond
                );
                let way = libm::atan2(found.way[1].abs(), found.way[0]);
                proof::near(way, found.turned - TAU / 4.0, 2.0 * STRAIGHT_RAD);
            }
        }
        let alone: Vec<[f64; 2]> = (0..314)
            .map(|k| libm::sincos(f64::from(k) / 50.0))
            .map(|(s, c)| [-50.0 * c, 50.0 * s])
            .collect();
        assert!(fold(&|k| alone[k % 314], 314, -1.0).is_none());
    }
}
