//! Where a turn closes: the frame that looks like the first again.

/// How alike frames are, evenly spread over a turn or more: by distance in order.
pub(crate) struct Likeness {
    /// `apart[i][j - i - 1]`: how much frame i differs from the later frame j. \[levels\]
    apart: Vec<Vec<f64>>,
}

/// Where a turn begins and how long it is, both in places between the frames that were compared with
/// each other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Closing {
    /// The place of its first frame.
    pub(crate) from: f64,
    /// How many places later the same is seen again.
    pub(crate) length: f64,
    /// Whether it closes within what was filmed, or nearly.
    pub(crate) closed: bool,
}

/// A turn closes where frames differ by no more than this share of the way from one place's difference to the usual
/// one. By hand: not on record.
const CLOSES_SHARE: f64 = 0.25;
/// Of several such lengths the shortest that is about as good as the best: so many times its difference, or so much
/// more. Whole turns again are as good, half a turn of a body is not. By hand: not on record.
const AS_GOOD: (f64, f64) = (1.5, 0.1);
/// A turn is no shorter than this share of what was filmed. By hand: not on record.
const SHORTEST_SHARE: f64 = 0.1;

impl Likeness {
    /// Holds frames against each other, at least three; by pixels that move.
    pub(crate) fn of(frames: &[&[f32]], moves: &[bool]) -> Likeness {
        let moving: Vec<usize> = (0..moves.len()).filter(|i| moves[*i]).collect();
        let every = (moving.len() / 2000).max(1);
        let pixels: Vec<usize> = moving.into_iter().step_by(every).collect();
        let of = |i: usize, j: usize| {
            let sum: f64 = pixels
                .iter()
                .map(|p| f64::from((frames[i][*p] - frames[j][*p]).abs()))
                .sum();
            sum / pixels.len().max(1) as f64
        };
        let count = frames.len();
        let row = |i: usize| (i + 1..count).map(|j| of(i, j)).collect();
        Likeness {
            apart: (0..count).map(row).collect(),
        }
    }

    fn count(&self) -> usize {
        self.apart.len()
    }

    /// How frames differ that are so many places apart, the least different fifth.
    fn at(&self, places: usize, share: f64) -> f64 {
        let pairs = self.count() - places;
        let mut all: Vec<f64> = (0..pairs).map(|i| self.apart[i][places - 1]).collect();
        all.sort_by(f64::total_cmp);
        all[((pairs - 1) as f64 * share) as usize]
    }

    /// The turn within these frames.
    pub(crate) fn closing(&self) -> Closing {
        let count = self.count();
        let open = Closing {
            from: 0.0,
            length: count as f64,
            closed: false,
        };
        let profile: Vec<f64> = (1..count).map(|p| self.at(p, 0.2)).collect();
        let (floor, usual) = (
            profile[0],
            shape::upper_median(&profile).unwrap_or_default(),
        );
        let height = usual - floor;
        if height <= 0.0 {
            return open;
        }
        let excess = |p: usize| ((profile[p - 1] - floor) / height).max(0.0);
        let least = ((SHORTEST_SHARE * count as f64) as usize).max(2);
        // Only behind frames that differ.
        let far = (1..count).find(|p| excess(*p) > 0.6).unwrap_or(count);
        let dip = |p: &usize| {
            let near = p.saturating_sub(3).max(1)..=(p + 3).min(count - 1);
            excess(*p) <= CLOSES_SHARE && near.into_iter().all(|q| excess(*p) <= excess(q))
        };
        let dips: Vec<usize> = (least.max(far)..count).filter(dip).collect();
        let best = dips.iter().map(|p| excess(*p)).fold(f64::MAX, f64::min);
        let good = |p: &&usize| excess(**p) <= (AS_GOOD.0 * best).max(best + AS_GOOD.1);
        let Some(length) = dips.iter().find(good).copied() else {
            return open;
        };
        let here = |i: usize| self.apart[i][length - 1];
        let lowest = (0..count - length).map(here).fold(f64::MAX, f64::min);
        let from = (0..count - length).find(|i| here(*i) <= 1.1 * lowest);
        let beyond = if length == count - 1 {
            self.beyond()
        } else {
            0.0
        };
        Closing {
            from: from.unwrap_or(0) as f64,
            length: length as f64 + beyond,
            closed: true,
        }
    }

    /// How many places the first frame is behind the last: as many as make frames of the end differ
    /// from frames of the beginning as frames of either differ among themselves. Not by the last and the
    /// first alone: neighbours share what a film's compression does to them, those two do not.
    fn beyond(&self) -> f64 {
        let count = self.count();
        let reach = (count / 16).clamp(2, 12);
        let apart = |i: usize, j: usize| self.apart[i][j - i - 1];
        // Frames so many places apart, of the beginning and of the end.
        let among = |places: usize| {
            let all = (0..reach).flat_map(|k| [k, count - 1 - places - k]);
            all.map(|i| apart(i, i + places)).sum::<f64>() / (2 * reach) as f64
        };
        let table: Vec<f64> = (1..=3 * reach).map(among).collect();
        let between = |places: f64| {
            let at = (places - 1.0).clamp(0.0, (table.len() - 1) as f64);
            let (low, part) = (at as usize, at.fract());
            let high = (low + 1).min(table.len() - 1);
            table[low] * (1.0 - part) + table[high] * part
        };
        // Of the end against the beginning, so many places less than the whole apart.
        let across = |k: usize| {
            let pairs = (0..=k).map(|i| apart(i, count - 1 - k + i));
            pairs.sum::<f64>() / (k + 1) as f64
        };
        let off = |behind: f64| -> f64 {
            let places = reach / 4..reach;
            places
                .map(|k| (across(k) - between(k as f64 + behind)).powi(2))
                .sum()
        };
        let tried = (0..=8 * reach).map(|i| i as f64 / 4.0);
        let best = tried.min_by(|a, b| off(*a).total_cmp(&off(*b)));
        best.expect("bug: nothing was tried")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    /// What 40 pixels see of something that turns by `from` to `to` turns; front and back are alike
    /// but for a mark.
    fn turned(from: f64, to: f64, frames: usize) -> Vec<Vec<f32>> {
        let frame = |k: usize| {
            let angle = TAU * (from + (to - from) * k as f64 / frames as f64);
            let pixel = |i: usize| {
                let a = angle + 0.15 * i as f64;
                (25.0 * libm::sin(2.0 * a) + 40.0 * libm::cos(a) + 10.0 * libm::sin(5.0 * a)) as f32
            };
            (0..40).map(pixel).collect()
        };
        (0..frames).map(frame).collect()
    }

    fn closing(frames: &[Vec<f32>]) -> Closing {
        let frames: Vec<&[f32]> = frames.iter().map(Vec::as_slice).collect();
        Likeness::of(&frames, &[true; 40]).closing()
    }

    #[test]
    fn one_turn_closes_where_it_began_and_two_are_taken_as_one() {
        let whole = closing(&turned(0.0, 1.0, 240));
        assert!(whole.closed, "{whole:?}");
        proof::near(whole.length, 240.0, 1.0);
        let more = closing(&turned(0.3, 1.5, 240));
        assert!(more.closed, "{more:?}");
        proof::near(more.length, 200.0, 1.5);
        let two = closing(&turned(0.0, 2.3, 240));
        proof::near(two.length, 240.0 / 2.3, 1.5);
        let short = closing(&turned(0.0, 0.975, 240));
        assert!(short.closed, "{short:?}");
        proof::near(short.length, 240.0 / 0.975, 2.5);
    }

    #[test]
    fn what_does_not_come_round_is_reported() {
        let part = closing(&turned(0.0, 0.8, 240));
        assert!(!part.closed, "{part:?}");
        assert_eq!((part.from, part.length), (0.0, 240.0));
        let still = closing(&turned(0.0, 0.0, 240));
        assert!(!still.closed);
    }

    #[test]
    fn what_comes_before_the_turn_is_left_out() {
        let mut frames = vec![vec![90.0; 40]; 12];
        frames.extend(turned(0.0, 1.05, 220));
        frames.extend(vec![vec![-90.0; 40]; 8]);
        let found = closing(&frames);
        assert!(found.closed, "{found:?}");
        assert!((12.0..=23.0).contains(&found.from), "{found:?}");
        proof::near(found.length, 220.0 / 1.05, 2.0);
    }
}
