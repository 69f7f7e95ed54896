//! Planes across calves: where one is fullest between ankle and knee, or, as far as none shows, where calves are.

use crate::features::body::Body;
use crate::features::limb::{Limbs, Segment};
use crate::geometry::peak::between_rows;
use crate::planes::limbs::{Across, Placed, holds_other, sure};
use shape::Refusal;

/// Where calves are fullest, as a share of the way from knee to ankle, and its standard deviation: fitted on 57 legs of bodies 162 to 231 of
/// `models/made/strangers.py`, those that narrow between calf and knee.
const FULLEST: (f64, f64) = (0.277, 0.068);
/// A shank that narrows by this share of its tape between what is fullest and what is larger beyond has a calf there; one that narrows less
/// has one in part. By hand: looked at thirteen bodies, at half and double of it: tapes move by at most 0.52 and 0.36 %, intervals change by at most
/// 24 and 232 %.
const NARROWS: f64 = 0.005;
/// Of the way from ankle to knee, what is below is not looked at (structural: calves are fullest above).
const LOW: f64 = 0.3;
/// Steps, as a share of stature (structural: samples).
const STEP: f64 = 0.0025;

/// A calf where it is greatest between ankle and knee (ISO 8559-1 5.3.24), square to the shank: a greatest of its own, not the end of what is
/// looked at, so that neither the knee nor a hem above it is taken. A shank that goes on growing up to the knee shows none: there it is where
/// calves are fullest, and as unsure as that is.
pub(crate) fn calf(limbs: &Limbs<'_>, body: &Body, side: f64) -> Result<Placed, Refusal> {
    let leg = limbs.leg(side)?;
    let down = -leg.axis(Segment::Shank).ok_or(Refusal::NoLimb)?.along;
    let across = Across::new(limbs, leg, down, body.stature);
    let (ankle, knee) = (leg.end.s, leg.middle.s);
    let long = knee - ankle;
    let step = STEP * body.stature;
    // Below what may be the knee itself, by two of its standard deviations.
    let knees = knee - 2.0 * leg.middle.sigma;
    let (low, high) = (ankle + LOW * long, knees.min(leg.clear_to()));
    let count = ((high - low) / step).max(0.0) as usize;
    let found: Vec<(f64, f64)> = (0..=count)
        .map(|i| low + step * i as f64)
        .filter_map(|s| Some((s, across.at(s)?.1)))
        // Up to where both legs are one on the surface.
        .take_while(|(_, ring)| holds_other(limbs, body, side, ring) != Some(true))
        .map(|(s, ring)| (s, ring.tape))
        .collect();
    let usual = (knee - FULLEST.0 * long, FULLEST.1 * long);
    if found.last().is_none_or(|top| top.0 < usual.0) {
        return Err(Refusal::NoPeak);
    }
    let (at, spread) = fullest(&found, usual);
    let (plane, _) = across.at(at).ok_or(Refusal::NoSection)?;
    Ok((plane, sure(spread)))
}

/// Where tapes along a line are greatest, and its standard deviation by what may be a greatest: peaks count by how much the tape falls to
/// either side before it is larger, the largest first; `usual` is where it is, and how surely, as far as none shows. \[mm\]
fn fullest(found: &[(f64, f64)], usual: (f64, f64)) -> (f64, f64) {
    // Each the mean of five: a hull's facets jump.
    let mean = |i: usize| {
        let near = &found[i.saturating_sub(2)..(i + 3).min(found.len())];
        near.iter().map(|f| f.1).sum::<f64>() / near.len() as f64
    };
    let tapes: Vec<f64> = (0..found.len()).map(mean).collect();
    let mut peaks: Vec<usize> = (1..tapes.len().saturating_sub(1))
        .filter(|i| tapes[i - 1] <= tapes[*i] && tapes[i + 1] < tapes[*i])
        .collect();
    peaks.sort_by(|a, b| tapes[*b].total_cmp(&tapes[*a]));
    let (mut left, mut parts) = (1.0, Vec::new());
    for i in peaks {
        let below = falls(tapes[i], tapes[..i].iter().rev());
        let falls = below.min(falls(tapes[i], tapes[i + 1..].iter()));
        let share = left * smooth(falls / (NARROWS * tapes[i]));
        let row = |k: usize| (found[k].0, tapes[k]);
        parts.push((share, between_rows([i - 1, i, i + 1].map(row)), 0.0));
        left -= share;
    }
    parts.push((left, usual.0, usual.1));
    let at = parts.iter().map(|(share, s, _)| share * s).sum::<f64>();
    let square = |(share, s, sigma): &(f64, f64, f64)| share * ((s - at).powi(2) + sigma * sigma);
    (at, parts.iter().map(square).sum::<f64>().sqrt())
}

/// How far tapes fall under one before they are larger, or end.
fn falls<'a>(own: f64, tapes: impl Iterator<Item = &'a f64>) -> f64 {
    own - tapes.take_while(|t| **t <= own).fold(own, |a, b| a.min(*b))
}

/// From 0 at 0 to 1 at 1 and beyond, without a kink.
fn smooth(x: f64) -> f64 {
    let x = x.clamp(0.0, 1.0);
    x * x * (3.0 - 2.0 * x)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A shank from below to the knee at 400 mm: its tape rises by 60 mm to a calf at 280, dips by `dip` and grows to the knee by 30. \[mm\]
    fn shank(dip: f64, from: f64) -> Vec<(f64, f64)> {
        let tape = |s: f64| match s {
            s if s < 280.0 => 340.0 - 60.0 * ((280.0 - s) / 160.0).powi(2),
            s if s < 330.0 => 340.0 - dip * smooth((s - 280.0) / 50.0),
            s => 340.0 - dip + 30.0 * ((s - 330.0) / 70.0),
        };
        (0..60)
            .map(|i| from + 4.0 * f64::from(i))
            .map(|s| (s, tape(s)))
            .collect()
    }

    #[test]
    fn a_calf_above_which_the_shank_narrows_is_at_its_peak_and_none_is_where_calves_are() {
        let usual = (300.0, 25.0);
        let (at, spread) = fullest(&shank(5.0, 150.0), usual);
        proof::near(at, 279.0, 2.0);
        assert!(spread < 0.5, "{spread}");
        let rising: Vec<(f64, f64)> = (0..50)
            .map(|i| (200.0 + 4.0 * f64::from(i), 300.0 + f64::from(i)))
            .collect();
        assert_eq!(fullest(&rising, usual), usual);
    }

    #[test]
    fn a_calf_does_not_jump_where_a_dip_above_it_comes_to_show_or_steps_begin_elsewhere() {
        let usual = (300.0, 25.0);
        let places: Vec<f64> = (0..=300)
            .map(|k| fullest(&shank(0.01 * f64::from(k), 150.0), usual).0)
            .collect();
        assert!(places[300] < 285.0 && places[0] > 295.0, "{places:?}");
        assert!(
            places.windows(2).all(|p| (p[1] - p[0]).abs() < 0.5),
            "{places:?}"
        );
        for dip in [0.0, 0.8, 3.0] {
            let all: Vec<f64> = (0..8)
                .map(|k| fullest(&shank(dip, 150.0 + 0.5 * f64::from(k)), usual).0)
                .collect();
            let least = all.iter().copied().fold(f64::MAX, f64::min);
            assert!(all.iter().all(|s| s - least < 2.0), "{dip}: {all:?}");
        }
    }
}
