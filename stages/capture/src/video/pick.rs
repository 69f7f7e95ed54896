//! Which frames of a turn are taken: one sharp one a step.

use crate::sharpness::blurred;

/// As sharp as the sharpest is what reaches this share of it: of those the one nearest to the step. By hand: not on
/// record.
const AS_SHARP_SHARE: f64 = 0.95;

/// What was picked.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Picked {
    /// The frames, in order.
    pub(crate) frames: Vec<usize>,
    /// Steps without any frame.
    pub(crate) empty: Vec<usize>,
    /// Those of the frames that are blurred.
    pub(crate) blurred: Vec<usize>,
}

/// Picks one frame for each of `steps` even steps of a turn. `come` is how far the turn has come at
/// each frame, `sharp` how sharp each is; a frame is taken from the middle `window` of its step,
/// from the whole step where none is there.
pub(crate) fn pick(come: &[Option<f64>], sharp: &[f64], steps: usize, window: f64) -> Picked {
    let mut picked = Picked::default();
    // By step: frames, each with how far it is from the step's middle, -0.5 to 0.5.
    let mut within: Vec<Vec<(usize, f64)>> = vec![vec![]; steps];
    for (frame, come) in come.iter().enumerate() {
        let Some(come) = come.filter(|c| (0.0..1.0).contains(c)) else {
            continue;
        };
        let place = come * steps as f64;
        let step = (place as usize).min(steps - 1);
        within[step].push((frame, place - step as f64 - 0.5));
    }
    for (step, all) in within.iter().enumerate() {
        let near: Vec<_> = all
            .iter()
            .filter(|(_, off)| off.abs() <= window / 2.0)
            .collect();
        let of = if near.is_empty() {
            all.iter().collect()
        } else {
            near
        };
        let best = of.iter().map(|(f, _)| sharp[*f]).fold(0.0, f64::max);
        let good = of
            .iter()
            .filter(|(f, _)| sharp[*f] >= AS_SHARP_SHARE * best);
        match good.min_by(|a, b| a.1.abs().total_cmp(&b.1.abs())) {
            Some((frame, _)) => picked.frames.push(*frame),
            None => picked.empty.push(step),
        }
    }
    let taken: Vec<[f64; 1]> = picked.frames.iter().map(|frame| [sharp[*frame]]).collect();
    let blurred = blurred(&taken).into_iter();
    picked.blurred = blurred.map(|k| picked.frames[k]).collect();
    picked
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Twelve frames a step over ten steps, after ten that do not belong to the turn.
    fn come() -> Vec<Option<f64>> {
        let turning = (0..132).map(|i| Some(f64::from(i) / 120.0));
        std::iter::repeat_n(None, 10).chain(turning).collect()
    }

    #[test]
    fn the_sharpest_near_the_middle_of_each_step_is_taken() {
        let come = come();
        let mut sharp = vec![1.0; come.len()];
        sharp[10 + 12 * 2 + 4] = 2.0;
        // Too far from the middle.
        sharp[10 + 12 * 3] = 9.0;
        let picked = pick(&come, &sharp, 10, 0.6);
        let wanted = [6, 18, 28, 42, 54, 66, 78, 90, 102, 114].map(|i| i + 10);
        assert_eq!(picked.frames, wanted);
        assert_eq!((picked.empty.len(), picked.blurred.len()), (0, 0));
    }

    #[test]
    fn steps_without_a_frame_and_without_a_sharp_one_are_reported() {
        let mut come = come();
        (0..10).for_each(|i| come[70 + i] = None);
        (80..82).for_each(|i| come[i] = None);
        let mut sharp = vec![1.0; come.len()];
        (34..46).for_each(|i| sharp[i] = 0.3);
        let picked = pick(&come, &sharp, 10, 0.6);
        assert_eq!(picked.empty, [5]);
        assert_eq!(picked.blurred, [40]);
        assert_eq!(picked.frames.len(), 9);
    }
}
