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
    let still = left_out[0].iter().filter(|still| **still).count();
    for (out, known) in left_out.iter_mut().zip(known_still) {
        out.iter_mut().zip(known).for_each(|(o, s)| *o |= s);
    }
    let mut moving = mutual(a, b, p.ratio, rise, &left_out);
    let both = |(i, j): &(u32, u32)| -> Both {
        let (k, l) = (&a.points[*i as usize], &b.points[*j as usize]);
        [
            [f64::from(k.x), f64::from(k.y)],
            [f64::from(l.x), f64::from(l.y)],
        ]
    };
    moving.retain(|m| {
        let [k, l] = both(m);
        libm::hypot(k[0] - l[0], k[1] - l[1]) >= p.still_px
    });
    let (rounds, seed) = (p.rounds as usize, p.seed as u64);
    let mut pairs: Vec<Both> = moving.iter().map(both).collect();
    let background = background_shift(first, &pairs, rounds.min(500), seed);
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
        background_px: background.map(|r| r.by_px),
    }
}
