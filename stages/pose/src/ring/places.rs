//! Photos that are not in their place: one that is missing, or that is elsewhere in the turn.
//!
//! Where the step of a turn is known, photo i should be at i steps. Whether a photo, or all from
//! it on, fits the rest far better some whole steps elsewhere is tried, the best change first.

use crate::calibration::params::CalibrateParams;
use crate::ring::pairs::LEAST_FEATURES;
use crate::ring::start::{Pair, Start, essential, robust};
use stage::{Message, message};

stage::messages! {
    LARGE_STEP = "warn-large-step": "between {before} and {after} the disk turned by {turn:.0 °}, not {usual:.0 °}: is a photo missing there?";
    NO_STEP = "warn-no-step": "between {before} and {after} the disk did not turn: remove one of them";
    WRONG_PLACE = "warn-wrong-place": "{after} comes before {before} in the turn, not behind it: put the photos into turning order";
}

/// Changes by so many steps are tried (structural: the width of a search, a cap on work).
const MOVED_STEPS: [i32; 6] = [-3, -2, -1, 1, 2, 3];
/// By how much a change must lower the error of the pairs that it touches.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Gain {
    /// As a share.
    share: f64,
    /// A pair of features. \[px\]
    px: f64,
}

impl Gain {
    /// What is there fits worse by the factor that shows a sway, and by what a feature scatters.
    pub(crate) fn of(p: &CalibrateParams) -> Self {
        Gain {
            share: 1.0 - 1.0 / p.sway_ratio,
            px: p.feature_px,
        }
    }
}

/// The place of each photo in the turn, in steps, and the start with those angles.
pub(crate) fn placed(pairs: &[Pair], start: &Start, least: Gain) -> (Start, Vec<i32>) {
    let photos = start.angles.len();
    let mut places: Vec<i32> = (0..photos as i32).collect();
    let step = start.angles.get(1).copied().unwrap_or(0.0);
    if step == 0.0 {
        return (start.clone(), places);
    }
    let error = |pair: &Pair, places: &[i32]| -> Option<f64> {
        let turns = places[pair.to] - places[pair.from];
        // Nothing moves between photos of one place.
        (turns != 0).then(|| {
            let e = essential(&start.axis, start.beside, f64::from(turns) * step);
            robust(&e, start.focal_px, &pair.seen)
        })
    };
    for _ in 0..photos {
        let now: Vec<f64> = pairs
            .iter()
            .map(|p| error(p, &places).unwrap_or(f64::MAX))
            .collect();
        let mut best: Option<(f64, Vec<i32>)> = None;
        for moved in changes(&places) {
            if let Some(gain) = gain(pairs, &places, &moved, &now, &error, least)
                && best.as_ref().is_none_or(|(most, _)| gain > *most)
            {
                best = Some((gain, moved));
            }
        }
        match best {
            Some((_, better)) => places = better,
            None => break,
        }
    }
    let first = places[0];
    places.iter_mut().for_each(|p| *p -= first);
    let angles = places.iter().map(|p| f64::from(*p) * step).collect();
    let start = Start {
        angles,
        ..start.clone()
    };
    (start, places)
}

/// What is tried: one photo elsewhere, all from one on, two that are near each other swapped.
fn changes(places: &[i32]) -> Vec<Vec<i32>> {
    let photos = places.len();
    let mut all = Vec::new();
    for photo in 0..photos {
        for (by, last) in MOVED_STEPS
            .iter()
            .flat_map(|by| [(by, photo + 1), (by, photos)])
        {
            let mut moved = places.to_vec();
            moved[photo..last].iter_mut().for_each(|p| *p += by);
            all.push(moved);
        }
        for other in photo + 1..photos.min(photo + 3) {
            let mut moved = places.to_vec();
            moved.swap(photo, other);
            all.push(moved);
        }
    }
    all
}

/// By how much a change lowers the error, if it is worth it. \[px\]
fn gain(
    pairs: &[Pair],
    was: &[i32],
    is: &[i32],
    now: &[f64],
    error: &dyn Fn(&Pair, &[i32]) -> Option<f64>,
    least: Gain,
) -> Option<f64> {
    let (mut before, mut after, mut count) = (0.0, 0.0, 0);
    for (pair, now) in pairs.iter().zip(now) {
        if is[pair.to] - is[pair.from] == was[pair.to] - was[pair.from] {
            continue;
        }
        before += now;
        after += error(pair, is)?;
        count += pair.seen.len();
    }
    let gain = before - after;
    let worth =
        count >= LEAST_FEATURES && gain > least.share * before && gain > least.px * count as f64;
    worth.then_some(gain)
}

/// What the user should know of photos that are not in their place.
pub(crate) fn out_of_place(names: &[&str], places: &[i32], step_deg: f64) -> Vec<Message> {
    let mut warnings = Vec::new();
    for (i, w) in places.windows(2).enumerate() {
        let turn = w[1] - w[0];
        if turn == 1 {
            continue;
        }
        let (before, after) = (names[i], names[i + 1]);
        warnings.push(match turn {
            2.. => message!(
                LARGE_STEP,
                before = before,
                after = after,
                turn = f64::from(turn) * step_deg,
                usual = step_deg
            ),
            0 => message!(NO_STEP, before = before, after = after),
            _ => message!(WRONG_PLACE, after = after, before = before),
        });
    }
    warnings
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ring::start::on_axis;
    use nalgebra::{Rotation3, Unit, Vector2, Vector3};

    const STEP: f64 = 0.349;

    /// Photos of a trunk at some places of a turn: what those near each other have in common.
    fn turned(places: &[i32]) -> (Vec<Pair>, Start) {
        let mut dice = proof::Dice(2);
        let axis = Vector3::new(0.01, -1.0, 0.15).normalize();
        let beside = 0.01;
        let points: Vec<(f64, f64)> = (0..900)
            .map(|_| {
                (
                    dice.within(0.0, std::f64::consts::TAU),
                    dice.within(-0.3, 0.3),
                )
            })
            .collect();
        let seen = |(a, h): (f64, f64), place: i32, dice: &mut proof::Dice| {
            let (sin, cos) = libm::sincos(a);
            let x = Vector3::new(0.08 * sin, h, -0.05 * cos);
            let r = Rotation3::from_axis_angle(&Unit::new_normalize(axis), f64::from(place) * STEP);
            let out = r * Vector3::new(sin, 0.0, -cos);
            let at = r * x + on_axis(&axis, beside);
            let px = Vector2::new(at.x, at.y) * (2600.0 / at.z);
            (out.z < -0.5).then(|| px + Vector2::new(dice.normal(), dice.normal()) * 0.5)
        };
        let mut pairs = Vec::new();
        for from in 0..places.len() {
            for to in from + 1..places.len().min(from + 4) {
                let both = |p: &(f64, f64)| {
                    let (a, b) = (
                        seen(*p, places[from], &mut dice),
                        seen(*p, places[to], &mut dice),
                    );
                    Some([a?, b?])
                };
                let seen: Vec<_> = points.iter().filter_map(both).collect();
                if seen.len() > 12 {
                    pairs.push(Pair { from, to, seen });
                }
            }
        }
        let start = Start {
            focal_px: 2600.0,
            axis,
            beside,
            angles: (0..places.len()).map(|i| i as f64 * STEP).collect(),
            error_px: 0.0,
        };
        (pairs, start)
    }

    #[test]
    fn missing_and_swapped_photos_are_reported() {
        let names: Vec<String> = (0..10).map(|i| format!("{i}.jpg")).collect();
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        for (places, begins) in [
            ((0..10).collect::<Vec<i32>>(), None),
            (
                vec![0, 1, 2, 3, 5, 6, 7, 8, 9, 10],
                Some("between 3.jpg and 4.jpg the disk turned by 40°"),
            ),
            (
                vec![0, 1, 2, 3, 4, 7, 8, 9, 10, 11],
                Some("between 4.jpg and 5.jpg the disk turned by 60°"),
            ),
            (
                vec![0, 1, 2, 4, 3, 5, 6, 7, 8, 9],
                Some("4.jpg comes before 3.jpg"),
            ),
        ] {
            let (pairs, start) = turned(&places);
            let least = Gain::of(&CalibrateParams::default());
            let (found, at) = placed(&pairs, &start, least);
            assert_eq!(at, places);
            proof::near(found.angles[9], f64::from(places[9]) * STEP, 1e-9);
            let warnings = out_of_place(&names, &at, 20.0);
            match begins {
                None => assert_eq!(warnings, Vec::<Message>::new()),
                Some(begins) => assert!(
                    warnings[0].starts_with(begins) || warnings[1].starts_with(begins),
                    "{warnings:?}"
                ),
            }
        }
    }
}
