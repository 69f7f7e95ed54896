//! Where in a video something turns, and by how much from frame to frame, from small pictures of all frames.

use crate::glance::STILL_LEVELS;

/// So many frames, spread over the video, show what moves (structural: samples).
const SAMPLED: usize = 150;
/// Where less changes than this share of the usual, nothing turns. By hand: not on record.
const SLOW_SHARE: f64 = 0.25;
/// Changes by less than this, beyond those of what does not move, are noise. By hand: not on record. \[levels\]
const NOISE_LEVELS: f64 = 0.3;
/// A pause of less than this share of all frames is within a turn. By hand: not on record.
const PAUSE_SHARE: f64 = 0.15;

/// Brightness of all frames, brought to one exposure, and what is known of it.
pub(crate) struct Motion {
    /// By frame and pixel. \[levels\]
    pub(crate) frames: Vec<Vec<f32>>,
    /// Which pixels move.
    pub(crate) moves: Vec<bool>,
    /// By how much each frame changes where something moves, beyond what does not move, over a few frames
    /// about it, the same for all. \[levels\]
    pub(crate) change: Vec<f64>,
}

fn middle(all: &mut [f32]) -> f32 {
    let at = all.len() / 2;
    *all.select_nth_unstable_by(at, f32::total_cmp).1
}

/// Evenly spread places.
fn spread(count: usize, most: usize) -> impl Iterator<Item = usize> + Clone {
    let taken = count.min(most);
    (0..taken).map(move |k| k * count / taken)
}

/// What moves. `small` are small pictures of one size, at least two.
pub(crate) fn motion(small: &[&[u8]]) -> Motion {
    let pixels = small[0].len();
    let sampled = spread(small.len(), SAMPLED);
    let usual: Vec<f32> = (0..pixels)
        .map(|i| {
            middle(
                &mut sampled
                    .clone()
                    .map(|f| f32::from(small[f][i]))
                    .collect::<Vec<_>>(),
            )
        })
        .collect();
    // By pixels that are neither black nor white.
    let clear: Vec<usize> = (0..pixels)
        .filter(|i| (12.0..243.0).contains(&usual[*i]))
        .collect();
    let levelled = |frame: &&[u8]| -> Vec<f32> {
        let mut ratios: Vec<f32> = clear
            .iter()
            .map(|i| f32::from(frame[*i]) / usual[*i])
            .collect();
        let gain = if ratios.is_empty() {
            1.0
        } else {
            middle(&mut ratios).max(0.05)
        };
        frame.iter().map(|v| f32::from(*v) / gain).collect()
    };
    let frames: Vec<Vec<f32>> = small.iter().map(levelled).collect();
    let moves: Vec<bool> = (0..pixels)
        .map(|i| {
            let mut seen: Vec<f32> = sampled.clone().map(|f| frames[f][i]).collect();
            seen.sort_by(f32::total_cmp);
            let cut = usize::from(seen.len() > 6);
            seen[seen.len() - 1 - cut] - seen[cut] > STILL_LEVELS
        })
        .collect();
    let change = change(&frames, &moves);
    Motion {
        frames,
        moves,
        change,
    }
}

/// How many frames apart two are in which something has turned by a few degrees.
fn lag(frames: usize) -> usize {
    (frames / 150).max(1).min(frames - 1)
}

fn change(frames: &[Vec<f32>], moves: &[bool]) -> Vec<f64> {
    let (count, lag) = (frames.len(), lag(frames.len()));
    let apart = |a: &[f32], b: &[f32], moving: bool| {
        let each = a.iter().zip(b).zip(moves).filter(|(_, m)| **m == moving);
        let (sum, all) = each.fold((0.0f64, 0usize), |(sum, all), ((a, b), _)| {
            (sum + f64::from((a - b).abs()), all + 1)
        });
        sum / all.max(1) as f64
    };
    (0..count)
        .map(|i| {
            let from = i.saturating_sub(lag / 2).min(count - 1 - lag);
            let (a, b) = (&frames[from], &frames[from + lag]);
            let more = apart(a, b, true) - apart(a, b, false);
            if more > NOISE_LEVELS { more } else { 0.0 }
        })
        .collect()
}

/// The frames, from first to last, in which something turns; none where nothing does.
pub(crate) fn stretch(change: &[f64]) -> Option<std::ops::RangeInclusive<usize>> {
    let usual = &shape::upper_median(change.iter().filter(|s| **s > 0.0))?;
    let turns: Vec<bool> = steady(change)
        .iter()
        .map(|s| *s > SLOW_SHARE * usual)
        .collect();
    let pause = ((PAUSE_SHARE * change.len() as f64) as usize).max(2);
    // Runs with pauses within; the one in which most frames move.
    let mut runs: Vec<(usize, usize, usize)> = Vec::new();
    for i in (0..change.len()).filter(|i| turns[*i]) {
        match runs.last_mut() {
            Some((_, last, frames)) if i - *last <= pause => (*last, *frames) = (i, *frames + 1),
            _ => runs.push((i, i, 1)),
        }
    }
    // The first of equals.
    let longest = runs.into_iter().rev().max_by_key(|(.., frames)| *frames)?;
    (longest.1 > longest.0).then_some(longest.0..=longest.1)
}

/// Each value as the middle one of those around it.
fn steady(all: &[f64]) -> Vec<f64> {
    let near = (all.len() / 100).clamp(1, 15);
    let middle = |i: usize| {
        let around = &all[i.saturating_sub(near)..(i + near + 1).min(all.len())];
        shape::upper_median(around).unwrap_or_default()
    };
    (0..all.len()).map(middle).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_turn_is_found_between_standing_still_with_a_pause_in_it() {
        let mut speed = vec![0.0; 20];
        speed.extend([4.0; 60]);
        speed.extend([0.0; 10]);
        speed.extend([5.0; 60]);
        speed.extend([0.0; 30]);
        // Somebody walks through long before.
        let mut before = vec![0.0; 5];
        before.extend([30.0; 5]);
        before.extend([0.0; 40]);
        let found = stretch(&[before, speed].concat()).unwrap();
        assert!(found.start().abs_diff(70) <= 1, "{found:?}");
        assert!(found.end().abs_diff(199) <= 1, "{found:?}");
        assert_eq!(stretch(&[0.0; 50]), None);
        assert_eq!(stretch(&[]), None);
    }
}
