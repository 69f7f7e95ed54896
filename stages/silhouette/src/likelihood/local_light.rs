//! Light that differs from the scene's place by place: a phone that lifts dark parts of each picture, a cloud before a window.
//!
//! Where the network is sure that nobody is, neighbourhoods of walls and floor show it. At other places it follows from those
//! by local lines, weighed by a normal density of the distance (Cleveland and Devlin 1988), as wide as predicts neighbourhoods
//! best from those that are as far as the network is unsure beside a person.

use crate::likelihood::cast::{Change, FEW, SAME_SIGMAS};
use crate::likelihood::grounds::Ground;
use crate::likelihood::neighbourhoods::stride;
use crate::likelihood::noise::Noise;
use crate::likelihood::person::surely_nobody;
use nalgebra::{Matrix3, Vector3};
use shape::{Gray, Rgb};

/// Widths of the weights that are tried, in neighbourhoods (structural: each twice the last; the photo decides).
const WIDTHS: [f64; 4] = [2.0, 4.0, 8.0, 16.0];
/// Neighbourhoods nearer than this do not predict each other: the network is unsure so far beside a person (structural: it
/// decides which width is taken).
const GAP: usize = 2;
/// What changed by more than this share otherwise than in its light is another thing (structural: most of the change).
const MOST_OTHER: f32 = 0.5;

/// How many times as bright each pixel of a reduced photo is as what is expected of it, by its surroundings where the network
/// is sure of nobody: `odds` are its log-odds, row by row. Empty where less than half of what neighbourhoods differ by is
/// alike in those beside them, or nobody is seen.
pub(crate) fn local_light(
    both: [&Rgb; 2],
    ground: &dyn Fn(usize, usize) -> Ground,
    odds: &[f32],
    noise: &Noise,
    reach: usize,
) -> Vec<f32> {
    let Some(seen) = Seen::of(both, ground, odds, noise, reach) else {
        return Vec::new();
    };
    let plane = seen.plane();
    let level = seen.without(&plane);
    let fits = WIDTHS.map(|width| level.fit(width));
    let best = fits.iter().min_by(|a, b| a.held_out.total_cmp(&b.held_out));
    let Some(Fit { all, .. }) = best else {
        return Vec::new();
    };
    let [wide, tall] = seen.size;
    let ratio = |i: usize| libm::exp(all[i] + plane.dot(&seen.at(i))) as f32;
    let map = Gray {
        width: wide,
        height: tall,
        data: (0..wide * tall).map(ratio).collect(),
    };
    let place = |v: usize| (v as f32 - reach as f32) / stride(reach) as f32;
    let [width, height] = [both[0].width, both[0].height];
    let all = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    all.map(|(x, y)| map.sample(place(x), place(y))).collect()
}

/// An image in the light that is on each pixel of it reduced by a factor; as it is where none is given.
pub(crate) fn lit(image: &Rgb, light: &[f32], factor: usize) -> Rgb {
    let (wide, tall) = (image.width / factor, image.height / factor);
    let mut lit = image.clone();
    if light.is_empty() || light.len() != wide * tall {
        return lit;
    }
    let map = Gray {
        width: wide,
        height: tall,
        data: light.to_vec(),
    };
    let place = |v: usize| (v as f32 + 0.5) / factor as f32 - 0.5;
    for (i, to) in lit.data.iter_mut().enumerate() {
        let times = map.sample(place(i % image.width), place(i / image.width));
        *to = to.map(|v| (f32::from(v) * times).round().min(255.0) as u8);
    }
    lit
}

/// The light of a photo's neighbourhoods, as logarithms of what is expected.
struct Seen {
    /// Neighbourhoods to a row and to a column.
    size: [usize; 2],
    /// 1 where it is known, else 0.
    sure: Vec<f64>,
    light: Vec<f64>,
}

/// Sums of ones, x, y, xx, xy, yy, and of light, x light, y light; places in widths of the weights.
type Sums = [f64; 9];

/// What a width of the weights comes to at each neighbourhood.
struct Fit {
    /// By all that are known.
    all: Vec<f64>,
    /// What those that are known are off from those beyond the gap; squares, their sum.
    held_out: f64,
}

impl Seen {
    /// `None` where there are few, or neighbours differ by more than half of what all do.
    fn of(
        both: [&Rgb; 2],
        ground: &dyn Fn(usize, usize) -> Ground,
        odds: &[f32],
        noise: &Noise,
        reach: usize,
    ) -> Option<Seen> {
        let [width, height] = [both[0].width, both[0].height];
        let count = |side: usize| side.saturating_sub(2 * reach).div_ceil(stride(reach));
        let size = [count(width), count(height)];
        let one = |i: usize| {
            let (x, y) = (
                reach + i % size[0] * stride(reach),
                reach + i / size[0] * stride(reach),
            );
            let on = ground(x, y);
            let sure = surely_nobody(odds, y * width + x);
            let change = (sure && on != Ground::Disk).then(|| Change::at(both, x, y, reach))?;
            let noise = SAME_SIGMAS * noise.bounced(on);
            let alike = change.other < noise.max(MOST_OTHER * change.all);
            alike.then(|| f64::from(libm::logf(change.light)))
        };
        let all: Vec<Option<f64>> = (0..size[0] * size[1]).map(one).collect();
        let seen = Seen {
            size,
            sure: all.iter().map(|l| f64::from(l.is_some())).collect(),
            light: all.iter().map(|l| l.unwrap_or(0.0)).collect(),
        };
        let enough = all.iter().flatten().count() >= FEW;
        (enough && seen.is_smooth()).then_some(seen)
    }

    /// Whether neighbourhoods beyond the gap share more than half of what they differ from the scene by (the variogram there,
    /// Matheron 1963).
    fn is_smooth(&self) -> bool {
        let lag = GAP + 1;
        let (mut apart, mut whole) = (0.0, 0.0);
        for i in 0..self.sure.len() {
            let beside = (i % self.size[0] + lag < self.size[0]).then_some(i + lag);
            let below = Some(i + lag * self.size[0]).filter(|j| *j < self.sure.len());
            for j in [beside, below].into_iter().flatten() {
                let known = self.sure[i] * self.sure[j];
                let [a, b] = [self.light[i], self.light[j]];
                apart += known * (a - b) * (a - b) / 2.0;
                whole += known * (a * a + b * b) / 2.0;
            }
        }
        2.0 * apart < whole
    }

    /// One, and the place in neighbourhoods.
    fn at(&self, i: usize) -> Vector3<f64> {
        Vector3::new(1.0, (i % self.size[0]) as f64, (i / self.size[0]) as f64)
    }

    /// The plane that is nearest to all, by least squares.
    fn plane(&self) -> Vector3<f64> {
        let (mut of, mut to) = (Matrix3::zeros(), Vector3::zeros());
        for i in 0..self.sure.len() {
            let at = self.at(i);
            of += at * at.transpose() * self.sure[i];
            to += at * (self.sure[i] * self.light[i]);
        }
        of.cholesky().map_or(Vector3::zeros(), |of| of.solve(&to))
    }

    /// What a plane leaves.
    fn without(&self, plane: &Vector3<f64>) -> Seen {
        let all = 0..self.light.len();
        Seen {
            size: self.size,
            sure: self.sure.clone(),
            light: all
                .map(|i| self.sure[i] * (self.light[i] - plane.dot(&self.at(i))))
                .collect(),
        }
    }

    /// By local lines, of weights so many neighbourhoods wide.
    fn fit(&self, width: f64) -> Fit {
        let weight = |far: usize| libm::exp(-((far * far) as f64) / (2.0 * width * width));
        let weights: Vec<f64> = (0..=(3.0 * width) as usize).map(weight).collect();
        let each: Vec<Sums> = (0..self.sure.len()).map(|i| self.one(i, width)).collect();
        let around = self.spread(&self.spread(&each, &weights, false), &weights, true);
        let off = |i: usize| {
            let mut sums = around[i];
            for (j, by) in self.within_gap(i, &weights) {
                sums.iter_mut()
                    .zip(each[j])
                    .for_each(|(sum, one)| *sum -= by * one);
            }
            height(&sums, &(self.at(i) / width)) - self.light[i]
        };
        let known = (0..self.sure.len()).filter(|i| self.sure[*i] > 0.0);
        Fit {
            held_out: known.map(|i| off(i) * off(i)).sum(),
            all: around
                .iter()
                .enumerate()
                .map(|(i, sums)| height(sums, &(self.at(i) / width)))
                .collect(),
        }
    }

    /// What one neighbourhood adds to sums.
    fn one(&self, i: usize, width: f64) -> Sums {
        let (at, sure, light) = (self.at(i) / width, self.sure[i], self.light[i]);
        let (x, y) = (at[1], at[2]);
        let of_light = [1.0, x, y].map(|v| v * light);
        let [a, b, c, d, e, f] = [1.0, x, y, x * x, x * y, y * y].map(|v| v * sure);
        [a, b, c, d, e, f, of_light[0], of_light[1], of_light[2]]
    }

    /// The neighbourhoods within the gap, with their weights.
    fn within_gap<'a>(
        &'a self,
        i: usize,
        weights: &'a [f64],
    ) -> impl Iterator<Item = (usize, f64)> + 'a {
        let [wide, tall] = self.size;
        let near = |at: usize, count: usize| at.saturating_sub(GAP)..(at + GAP + 1).min(count);
        let (x, y) = (i % wide, i / wide);
        near(y, tall).flat_map(move |v| {
            let by = move |u: usize| weights[u.abs_diff(x)] * weights[v.abs_diff(y)];
            near(x, wide).map(move |u| (v * wide + u, by(u)))
        })
    }

    /// Sums about each neighbourhood, weighed by the distance along rows or columns.
    fn spread(&self, each: &[Sums], weights: &[f64], columns: bool) -> Vec<Sums> {
        let [wide, tall] = self.size;
        let (step, count) = if columns { (wide, tall) } else { (1, wide) };
        let reach = weights.len() - 1;
        let about = |i: usize| {
            let at = i / step % count;
            let first = i - at * step;
            let mut sums = [0.0; 9];
            for k in at.saturating_sub(reach)..(at + reach + 1).min(count) {
                let by = weights[k.abs_diff(at)];
                let one = each[first + k * step];
                sums.iter_mut()
                    .zip(one)
                    .for_each(|(sum, one)| *sum += by * one);
            }
            sums
        };
        (0..each.len()).map(about).collect()
    }
}

/// The height, at a place, of the plane that sums give, where one neighbourhood without a difference and without a slope is
/// believed beforehand.
fn height(sums: &Sums, at: &Vector3<f64>) -> f64 {
    let [one, x, y, xx, xy, yy, l, lx, ly] = *sums;
    let (u, v) = (at[1], at[2]);
    // About the place.
    let (cx, cy) = (x - u * one, y - v * one);
    let cxx = xx - 2.0 * u * x + u * u * one;
    let cxy = xy - u * y - v * x + u * v * one;
    let cyy = yy - 2.0 * v * y + v * v * one;
    let of = Matrix3::new(one, cx, cy, cx, cxx, cxy, cy, cxy, cyy) + Matrix3::identity();
    let to = Vector3::new(l, lx - u * l, ly - v * l);
    of.cholesky().map_or(0.0, |of| of.solve(&to)[0])
}

#[cfg(test)]
mod tests;
