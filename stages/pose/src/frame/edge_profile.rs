//! Where the edge of something is on a profile of light across it, however blurred.
//!
//! A lens blurs light, not the levels of a file, and alike to both sides: a step stays where it is. A narrow band along the
//! edge, as white paper around what is printed, would draw the steepest change outwards the more it is blurred, so that it
//! is a part of the model: `a + b Φ((e − s)/σ) − c Φ((e − w − s)/σ)`, of the same sign b and c.

use nalgebra::{Matrix3, Vector3};

/// Places of the edge that are tried first; what is farther off is another edge. By hand: looked at six captures: the
/// first halved, size +0.08 % for one; the first doubled, no more than chance; the second halved and doubled, no more
/// than chance (docs/lab/numbers.md). \[px\]
pub(super) const EDGES_PX: [f64; 2] = [-2.0, 2.0];
/// Widths of the band that are tried first (structural: where a search begins). \[px\]
pub(super) const BANDS_PX: [f64; 2] = [1.0, 5.0];
/// Standard deviations of the blur that are tried first (structural: where a search begins). \[px\]
const BLURS_PX: [f64; 2] = [0.3, 2.1];
/// How many of each are tried (structural: the grid from which a search begins).
const TRIED: [usize; 3] = [17, 9, 7];
/// Least width of a band and least blur: narrower ones are alike on pixels. By hand: looked at six captures, halved and
/// doubled: no more than chance (docs/lab/numbers.md). \[px\]
const NARROWEST_PX: [f64; 2] = [0.5, 0.2];
/// Rounds in which the best is bettered by ever smaller steps (structural: steps are halved to a ten-thousandth).
const ROUNDS: usize = 14;
/// An edge is one where the model is off by less than this share of all that light changes, root mean square. By hand:
/// looked at six captures, halved and doubled: no more than chance (docs/lab/numbers.md).
const LOOSE_SHARE: f64 = 0.25;

/// Light along a line that crosses an edge outwards, every `step` pixels from `first` on.
pub(crate) struct Profile {
    pub(crate) first: f64,
    pub(crate) step: f64,
    pub(crate) light: Vec<f64>,
}

impl Profile {
    /// How much brighter it is so far outside than so far inside.
    pub(crate) fn change(&self, beside_px: f64) -> f64 {
        let at = |s: f64| self.light[((s - self.first) / self.step) as usize];
        at(beside_px) - at(-beside_px)
    }

    /// Where the edge is, if light changes there in one sense: outside more than inside, or less. \[px\]
    pub(crate) fn edge(&self, brighter: bool) -> Option<f64> {
        let tried = |[low, high]: [f64; 2], count: usize| {
            (0..count).map(move |i| low + (high - low) * i as f64 / (count - 1) as f64)
        };
        let mut best: Option<(f64, [f64; 3])> = None;
        for edge in tried(EDGES_PX, TRIED[0]) {
            for band in tried(BANDS_PX, TRIED[1]) {
                for blur in tried(BLURS_PX, TRIED[2]) {
                    let at = [edge, band, blur];
                    let cost = self.cost(at, brighter);
                    if cost.is_some_and(|c| best.is_none_or(|(least, _)| c < least)) {
                        best = cost.map(|cost| (cost, at));
                    }
                }
            }
        }
        let (mut cost, mut at) = best?;
        let mut steps = [0.25, 0.5, 0.3];
        for _ in 0..ROUNDS {
            steps = steps.map(|s| 0.6 * s);
            for (k, way) in (0..3).flat_map(|k| [(k, -1.0), (k, 1.0)]) {
                let mut other = at;
                other[k] += way * steps[k];
                if other[1] < NARROWEST_PX[0] || other[2] < NARROWEST_PX[1] {
                    continue;
                }
                if let Some(less) = self.cost(other, brighter).filter(|c| *c < cost) {
                    (cost, at) = (less, other);
                }
            }
        }
        let [low, high] = EDGES_PX;
        let (darkest, brightest) = self
            .light
            .iter()
            .fold((f64::MAX, f64::MIN), |(low, high), l| {
                (low.min(*l), high.max(*l))
            });
        let loose = LOOSE_SHARE * (brightest - darkest);
        (cost < loose * loose && low < at[0] && at[0] < high).then_some(at[0])
    }

    /// Mean square of what the best a, b and c leave. `None` where the step is of the other sense.
    fn cost(&self, [edge, band, blur]: [f64; 3], brighter: bool) -> Option<f64> {
        let below = |x: f64| 0.5 * libm::erfc(-x / blur * std::f64::consts::FRAC_1_SQRT_2);
        let row = |i: usize| {
            let s = self.first + self.step * i as f64;
            Vector3::new(1.0, below(edge - s), -below(edge - band - s))
        };
        let (mut normal, mut right, mut all) = (Matrix3::zeros(), Vector3::zeros(), 0.0);
        for (i, light) in self.light.iter().enumerate() {
            let row = row(i);
            normal += row * row.transpose();
            right += row * *light;
            all += light * light;
        }
        let sense = if brighter { -1.0 } else { 1.0 };
        let whole = normal.cholesky().map(|n| n.solve(&right));
        let of = match whole.filter(|of| of[2] * sense >= 0.0) {
            Some(of) => of,
            None => {
                // Without a band.
                let (n, r) = (normal.fixed_view::<2, 2>(0, 0), right.fixed_rows::<2>(0));
                n.into_owned().cholesky()?.solve(&r.into_owned()).push(0.0)
            }
        };
        // What is left is the sum of squares less what is explained.
        let left = (all - 2.0 * of.dot(&right) + of.dot(&(normal * of))).max(0.0);
        (of[1] * sense > 0.0).then(|| left / self.light.len() as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_edge_stays_where_it_is_though_a_band_along_it_is_blurred() {
        let below = |x: f64| 0.5 * libm::erfc(-x * std::f64::consts::FRAC_1_SQRT_2);
        for (blur, band) in [(0.5, 2.0), (1.2, 2.0), (0.5, 0.0), (1.2, 0.0)] {
            for brighter in [false, true] {
                let sign = if brighter { -1.0 } else { 1.0 };
                let light = |i: i32| {
                    let s = -4.0 + 0.25 * f64::from(i);
                    let edge = 120.0 * below((0.3 - s) / blur);
                    let inner = if band > 0.0 {
                        70.0 * below((0.3 - band - s) / blur)
                    } else {
                        0.0
                    };
                    100.0 + sign * (edge - inner) + 0.3 * libm::sin(f64::from(i * i))
                };
                let profile = Profile {
                    first: -4.0,
                    step: 0.25,
                    light: (0..37).map(light).collect(),
                };
                proof::near(profile.edge(brighter).unwrap(), 0.3, 0.1);
                assert_eq!(
                    profile.edge(!brighter).filter(|e| (e - 0.3).abs() < 0.5),
                    None
                );
            }
        }
    }
}
