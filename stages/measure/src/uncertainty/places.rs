//! How a tape changes over the places where it may be meant: what nine in ten of them are within, which is rarely as far up as down.

use shape::NINE_IN_TEN;

/// How far to either side sections are taken, in deviations (derived: the outer nodes of Gauss and Hermite, by which a mean over a
/// normal distribution is right where a tape is a parabola).
pub(crate) const FAR: f64 = 1.732_050_807_568_877_2;
/// Even steps over a normal distribution: so many deviations to either side, and steps in one (structural: samples).
const SAMPLES: (i32, f64) = (35, 10.0);

/// How much a tape changes by where it is taken. \[mm\]
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Changes {
    /// Root mean square.
    pub(crate) sigma: f64,
    /// Nine in ten are between these: below nought or nought, and above or nought.
    pub(crate) ends: [f64; 2],
}

/// Samples over a normal distribution: how many deviations, and how much each counts.
fn normal() -> impl Iterator<Item = (f64, f64)> + Clone {
    let one = |k: i32| {
        let x = f64::from(k) / SAMPLES.1;
        (x, libm::exp(-0.5 * x * x))
    };
    (-SAMPLES.0..=SAMPLES.0).map(one)
}

/// Changes by a level alone, from sections at some deviations from it, rising, between which a tape is straight. `None` without one to
/// either side; where one side has none, it is as the other is.
pub(crate) fn along(change: impl Fn(f64) -> Option<f64>) -> Option<Changes> {
    // Nearer where the farther one is no section of the part.
    let side = |way: f64| -> Vec<(f64, f64)> {
        let all = [0.5, 1.0].map(|share| share * FAR * way);
        all.into_iter()
            .map_while(|x| Some((x, change(x)?)))
            .collect()
    };
    let mirrored = |other: &[(f64, f64)]| other.iter().map(|(x, c)| (-x, -c)).collect();
    let (mut low, mut high) = (side(-1.0), side(1.0));
    match (low.is_empty(), high.is_empty()) {
        (true, true) => return None,
        (true, false) => low = mirrored(&high),
        (false, true) => high = mirrored(&low),
        (false, false) => {}
    }
    let beside = |nodes: &[(f64, f64)], x: f64| {
        let (from, to) = match nodes {
            [near, far] if x.abs() > near.0.abs() => (*near, *far),
            _ => ((0.0, 0.0), nodes[0]),
        };
        from.1 + (to.1 - from.1) * (x - from.0) / (to.0 - from.0)
    };
    let at = |x: f64| beside(if x < 0.0 { &low } else { &high }, x);
    let square = (at(-FAR).powi(2) + at(FAR).powi(2)) / (2.0 * FAR * FAR);
    Some(Changes {
        sigma: square.sqrt(),
        ends: ends(normal().map(|(x, weight)| (at(x), weight)).collect()),
    })
}

/// Changes by a level and a tilt that err each by itself: a parabola in both, through sections a deviation to either side of each, and
/// of both at once. Down they reach as far as a tape does, too, that is free to tilt and comes to rest where it is shortest. `None`
/// without one to either side of one.
pub(crate) fn over(change: impl Fn(f64, f64) -> Option<f64>) -> Option<Changes> {
    let parabola = |at: &dyn Fn(f64) -> Option<f64>| {
        let (low, high) = (at(-1.0), at(1.0));
        let (low, high) = (low.or(high.map(|c| -c))?, high.or(low.map(|c| -c))?);
        Some([(high - low) / 2.0, (high + low) / 2.0])
    };
    let level = parabola(&|x| change(x, 0.0))?;
    let tilt = parabola(&|x| change(0.0, x))?;
    let corner = |(x, y): (f64, f64)| Some(x * y * change(x, y)?);
    let corners = [(1.0, 1.0), (-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0)].map(corner);
    let corners: Option<Vec<f64>> = corners.into_iter().collect();
    let both = corners.map_or(0.0, |all| all.iter().sum::<f64>() / 4.0);
    let at =
        |x: f64, y: f64| (level[0] + level[1] * x) * x + (tilt[0] + tilt[1] * y) * y + both * x * y;
    let all = normal().flat_map(|(x, one)| normal().map(move |(y, other)| (x, y, one * other)));
    let square = level[0] * level[0]
        + tilt[0] * tilt[0]
        + both * both
        + 3.0 * (level[1] * level[1] + tilt[1] * tilt[1])
        + 2.0 * level[1] * tilt[1];
    let at_rest = |x: f64| normal().map(|(y, _)| at(x, y)).fold(f64::MAX, f64::min);
    let [rest, _] = ends(normal().map(|(x, weight)| (at_rest(x), weight)).collect());
    let [down, up] = ends(all.map(|(x, y, weight)| (at(x, y), weight)).collect());
    Some(Changes {
        sigma: square.sqrt(),
        ends: [down.min(rest), up],
    })
}

/// Between which nine in ten of weighted values are, nought among them.
fn ends(mut all: Vec<(f64, f64)>) -> [f64; 2] {
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    let total: f64 = all.iter().map(|a| a.1).sum();
    let beyond = 0.5 * libm::erfc(NINE_IN_TEN / std::f64::consts::SQRT_2);
    let at = |share: f64| {
        let (mut below, mut last) = (0.0, (0.0, all[0].0));
        for (value, weight) in &all {
            let middle = (below + 0.5 * weight) / total;
            if middle >= share {
                let part = (share - last.0) / (middle - last.0);
                return last.1 + (value - last.1) * part;
            }
            below += weight;
            last = (middle, *value);
        }
        last.1
    };
    [at(beyond).min(0.0), at(1.0 - beyond).max(0.0)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_interval_reaches_as_far_up_and_down_as_the_tape_does() {
        // Straight: to both sides alike, as a deviation has it.
        let line = along(|x| Some(4.0 * x)).unwrap();
        proof::near(line.sigma, 4.0, 1e-9);
        proof::near(line.ends[0], -4.0 * NINE_IN_TEN, 0.01);
        proof::near(line.ends[1], 4.0 * NINE_IN_TEN, 0.01);
        // At a waist, nothing is shorter.
        let waist = along(|x| Some(x * x)).unwrap();
        assert_eq!(waist.ends[0], 0.0);
        assert!((3.0..4.5).contains(&waist.ends[1]), "{waist:?}");
        // Steep to one side alone, as beside a narrow waist.
        let steep = along(|x| Some(if x > 0.0 { -10.0 * x } else { -x })).unwrap();
        proof::near(steep.ends[0], -10.0 * NINE_IN_TEN, 0.05);
        proof::near(steep.ends[1], NINE_IN_TEN, 0.01);
    }

    #[test]
    fn where_a_side_has_no_section_it_is_as_the_other() {
        let all = along(|x| Some(2.0 * x)).unwrap();
        let up = along(|x| (x > 0.0).then_some(2.0 * x)).unwrap();
        let near = along(|x| (x.abs() < 1.0).then_some(2.0 * x)).unwrap();
        for one in [up, near] {
            proof::near(one.sigma, all.sigma, 1e-9);
            proof::near(one.ends[1], all.ends[1], 1e-9);
        }
        assert_eq!(along(|_| None), None);
        assert_eq!(over(|x, _| (x == 0.0).then_some(1.0)), None);
    }

    #[test]
    fn a_level_and_a_tilt_that_both_lengthen_a_tape_reach_up_farther_together() {
        let alone = over(|x, y| Some(3.0 * x + 4.0 * y)).unwrap();
        proof::near(alone.sigma, 5.0, 1e-9);
        // Samples are in steps.
        proof::near(alone.ends[1], 5.0 * NINE_IN_TEN, 0.1);
        let both = over(|x, y| Some((3.0 * x + 4.0 * y) + 0.5 * (x + y).powi(2))).unwrap();
        assert!(both.ends[1] > alone.ends[1] + 1.0, "{both:?}");
        assert!(both.ends[0] > alone.ends[0], "{both:?}");
    }

    #[test]
    fn a_tape_that_comes_to_rest_by_tilting_is_within_reach() {
        // Shortest two deviations of the tilt away, by 8, wherever the level is.
        let rest = over(|x, y| Some(x + 2.0 * y * (y - 4.0))).unwrap();
        proof::near(rest.ends[0], -8.0 - NINE_IN_TEN, 0.05);
        assert!(rest.ends[1] > 10.0, "{rest:?}");
        // Shortest where it was taken: as far as the level goes.
        let here = over(|x, y| Some(4.0 * x + y * y)).unwrap();
        proof::near(here.ends[0], -4.0 * NINE_IN_TEN, 0.05);
    }
}
