//! What two photos of a turn have in common.

use crate::features::matching::{mutual, still};
use crate::features::params::TracksParams;
use crate::two_view::background_shift::background_shift;
use crate::two_view::epipolar::{agreeing, agreeing_through};
use crate::two_view::five_point::Both;
use shape::{Features, Intrinsics};

/// What two photos have in common.
pub(crate) struct Common {
    /// What moves as one rigid thing.
    pub(crate) matches: Vec<(u32, u32)>,
    /// How many features stood still.
    pub(crate) still: usize,
    /// How far the background moved, where it did. \[px\]
    pub(crate) background_px: Option<f64>,
}

/// The matches of a pair.
pub(crate) fn matched(
    [a, b]: [&Features; 2],
    known_still: [&Vec<bool>; 2],
    p: &TracksParams,
    rise: f32,
    first: &Intrinsics,
    known: Option<&Intrinsics>,
) -> Common {
    let mut left_out = still(a, b, p.still_px as f32);
    let still = count(&left_out[0]);
    let both = |(i, j): &(u32, u32)| -> Both {
        let (k, l) = (&a.points[*i as usize], &b.points[*j as usize]);
        [
            [f64::from(k.x), f64::from(k.y)],
            [f64::from(l.x), f64::from(l.y)],
        ]
    };
    let (rounds, seed) = (p.rounds as usize, p.seed as u64);
    let shift = |pairs: &[Both]| background_shift(first, pairs, rounds.min(500), seed);
    // What is at one place on other photos, and here at another: no subject, however narrow.
    let nudged = 2 * still < count(known_still[0]).min(count(known_still[1]));
    let elsewhere = nudged.then(|| {
        let turns = |k: usize| {
            known_still[k]
                .iter()
                .zip(&left_out[k])
                .map(|(known, here)| !known || *here)
        };
        let pairs = mutual(
            a,
            b,
            p.ratio,
            rise,
            &[turns(0).collect(), turns(1).collect()],
        );
        shift(&pairs.iter().map(both).collect::<Vec<_>>())
    });
    for (out, known) in left_out.iter_mut().zip(known_still) {
        out.iter_mut().zip(known).for_each(|(o, s)| *o |= s);
    }
    let mut moving = mutual(a, b, p.ratio, rise, &left_out);
    moving.retain(|m| {
        let [k, l] = both(m);
        libm::hypot(k[0] - l[0], k[1] - l[1]) >= p.still_px
    });
    let mut pairs: Vec<Both> = moving.iter().map(both).collect();
    let background = shift(&pairs).filter(|shift| shift.wide);
    if let Some(background) = &background {
        let mut of = background.of.iter();
        moving.retain(|_| !of.next().is_some_and(|of| *of));
        pairs = moving.iter().map(both).collect();
    }
    let agree = match known {
        Some(lens) => agreeing_through(lens, &pairs, p.epipolar_px, rounds, seed),
        None => agreeing(&pairs, p.epipolar_px, rounds, seed),
    };
    let kept: Vec<(u32, u32)> = moving
        .iter()
        .zip(&agree)
        .filter(|(_, agree)| **agree)
        .map(|(m, _)| *m)
        .collect();
    let chance = (kept.len() as f64) < p.least_share * moving.len() as f64;
    Common {
        matches: if chance { vec![] } else { kept },
        still,
        background_px: background.or(elsewhere.flatten()).map(|r| r.by_px),
    }
}

fn count(of: &[bool]) -> usize {
    of.iter().filter(|of| **of).count()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::features::matching::tests::features;
    use shape::Keypoint;

    /// A wall above the subject, as a camera sees it that moved by so much.
    fn wall(by: [f32; 2]) -> Features {
        let mut seen = features(&mut proof::Dice(7), 200);
        let shifted = |p: &mut Keypoint| (p.x, p.y) = (p.x + by[0], p.y + by[1]);
        seen.points.iter_mut().for_each(shifted);
        seen
    }

    #[test]
    fn a_background_that_is_still_on_other_photos_shows_that_the_camera_moved_here() {
        let lens = Intrinsics::simple(900, 1200, 1700.0);
        let known = vec![true; 200];
        let shift = |by: [f32; 2]| {
            let (a, b) = (wall([0.0; 2]), wall(by));
            let p = TracksParams::default();
            let found = matched([&a, &b], [&known, &known], &p, 192.0, &lens, None);
            found.background_px
        };
        assert_eq!(shift([1.0, 0.0]), None);
        let found = shift([-8.0, -10.0]).expect("a shift of 13 px");
        proof::near(found, 12.8, 0.1);
    }
}
