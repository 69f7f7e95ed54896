//! The turn within a video: how far it has come at each frame.

use crate::video::closing::Likeness;
use crate::video::speed::{Motion, stretch};

/// So many frames, spread over what moves, are compared with each other (structural: samples).
const MOST_COMPARED: usize = 240;
/// A disk turns evenly whose speed, as pictures change, differs by less than this share (standard deviation). By hand:
/// looked at bodies that turn evenly, which change by 0.13 to 0.24 more or less as they show their sides.
const UNEVEN_SHARE: f64 = 0.35;

/// What was found.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Turn {
    /// How far the turn has come at each frame: 0 where it begins, 1 where it closes; less and more
    /// before and after it. Nothing where the subject does not turn. \[turns\]
    pub(crate) come: Vec<Option<f64>>,
    /// Whether it closes.
    pub(crate) closed: bool,
    /// Whether the subject turned evenly.
    pub(crate) even: bool,
}

/// Finds the turn; `times` are when frames were taken. Nothing where nothing turns. \[s\]
pub(crate) fn turn(motion: &Motion, times: &[f64]) -> Option<Turn> {
    let turning = stretch(&motion.change)?;
    let (first, last) = (*turning.start(), *turning.end());
    let (change, times_of) = (&motion.change[first..=last], &times[first..=last]);
    let even = is_even(change, times_of);
    // How far frames have come, in whatever unit.
    let come: Vec<f64> = match even {
        true => times_of.iter().map(|t| t - times_of[0]).collect(),
        // A disk that is turned by hand, or rests.
        false => {
            let mut sum = 0.0;
            let steps = change.windows(2).map(|w| {
                sum += (w[0] + w[1]) / 2.0;
                sum
            });
            std::iter::once(0.0).chain(steps).collect()
        }
    };
    let whole = come.last().copied().filter(|w| *w > 0.0)?;
    let places = come.len().min(MOST_COMPARED);
    if places < 3 {
        return None;
    }
    // Frames evenly spread by how far they have come.
    let spread: Vec<&[f32]> = (0..places)
        .map(|k| {
            let wanted = whole * k as f64 / (places - 1) as f64;
            let at = come.partition_point(|c| *c < wanted).min(come.len() - 1);
            let near = match at > 0 && wanted - come[at - 1] < come[at] - wanted {
                true => at - 1,
                false => at,
            };
            motion.frames[first + near].as_slice()
        })
        .collect();
    let closing = Likeness::of(&spread, &motion.moves).closing();
    let part = |come: f64| (come / whole * (places - 1) as f64 - closing.from) / closing.length;
    let turned = (0..times.len()).map(|i| match turning.contains(&i) {
        true => Some(part(come[i - first])),
        false => None,
    });
    Some(Turn {
        come: turned.collect(),
        closed: closing.closed,
        even,
    })
}

/// Whether pictures change about as fast all the time.
fn is_even(change: &[f64], times: &[f64]) -> bool {
    let near = (change.len() / 24).max(1);
    let speed = |i: usize| {
        let around = i.saturating_sub(near)..(i + near + 1).min(change.len());
        let seconds = times[around.end - 1] - times[around.start];
        change[around].iter().sum::<f64>() / seconds.max(1e-3)
    };
    let speed: Vec<f64> = (0..change.len()).map(speed).collect();
    let count = speed.len() as f64;
    let mean = speed.iter().sum::<f64>() / count;
    let spread = (speed.iter().map(|s| (s - mean).powi(2)).sum::<f64>() / count).sqrt();
    spread <= UNEVEN_SHARE * mean
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::video::speed::motion;
    use std::f64::consts::TAU;

    /// A turned thing before a wall, by angle.
    fn frame(angle: f64) -> Vec<u8> {
        let pixel = |i: usize| {
            let (x, y) = (i % 32, i / 32);
            let across = (x as f64 - 16.0) / 9.0;
            match across.abs() < 1.0 && y > 4 {
                true => {
                    let a = libm::asin(across) + angle;
                    (120.0
                        + 30.0 * libm::cos(2.0 * a)
                        + 50.0 * libm::sin(a)
                        + 15.0 * libm::sin(5.0 * a)) as u8
                }
                false => (60 + x * 7 % 90) as u8,
            }
        };
        (0..32 * 40).map(pixel).collect()
    }

    fn found(angles: &[f64], times: &[f64]) -> Option<Turn> {
        let frames: Vec<Vec<u8>> = angles.iter().map(|a| frame(*a)).collect();
        let small: Vec<&[u8]> = frames.iter().map(Vec::as_slice).collect();
        turn(&motion(&small), times)
    }

    /// The worst error of `come` against the true angles. \[°\]
    fn worst(turn: &Turn, angles: &[f64]) -> f64 {
        let from = angles
            .iter()
            .zip(&turn.come)
            .find_map(|(a, c)| c.map(|c| a - TAU * c));
        let off = |(c, a): (&Option<f64>, &f64)| Some(a - TAU * (*c)? - from?);
        let off = turn.come.iter().zip(angles).filter_map(off);
        off.fold(0.0, |worst: f64, o| worst.max(o.abs()))
            .to_degrees()
    }

    #[test]
    fn a_turn_between_standing_still_is_measured_in_turns() {
        let angles: Vec<f64> = (0..260)
            .map(|i| TAU * 1.1 * (f64::from(i - 40) / 200.0).clamp(0.0, 1.0))
            .collect();
        let times: Vec<f64> = (0..260).map(|i| f64::from(i) / 30.0).collect();
        let turn = found(&angles, &times).unwrap();
        assert!(turn.closed && turn.even, "{turn:?}");
        assert!(turn.come[20].is_none() && turn.come[250].is_none());
        assert!(worst(&turn, &angles) < 8.0, "{}", worst(&turn, &angles));
        assert_eq!(found(&[1.0; 60], &times[..60]), None, "nothing turns");
    }

    #[test]
    fn a_disk_turned_by_hand_and_frames_at_any_times_are_followed() {
        // It rests four times; frames come unevenly.
        let times: Vec<f64> = (0..300)
            .map(|i| f64::from(i) / 30.0 + 0.01 * f64::from(i % 3))
            .collect();
        let angle = |t: &f64| {
            let part = t / 10.0 * 5.0;
            TAU * 1.05 * (part.floor() + ((part % 1.0) / 0.6).min(1.0)) / 5.0
        };
        let angles: Vec<f64> = times.iter().map(angle).collect();
        let turn = found(&angles, &times).unwrap();
        assert!(turn.closed && !turn.even, "{turn:?}");
        assert!(worst(&turn, &angles) < 35.0, "{}", worst(&turn, &angles));
    }
}
