//! Heavy tails: people who are unlike most, and readings that are of something else.

use super::file::{LevelModel, Population};
use super::normal::Conditional;
use crate::features::readings::Reading;
#[cfg(test)]
use {super::file::Scope, super::level::Level, crate::features::readings::Readings};

/// How people and what is read of them scatter.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Tails {
    /// Degrees of freedom: tails are heavier than a normal distribution's.
    pub freedom: f64,
    /// How often a reading is of something else. Three at once are one body in a million, so they are not looked at.
    pub bad: f64,
    /// How many times as far as people's such a reading scatters.
    pub astray: f64,
}

/// `freedom` and `bad` are fitted on made bodies of single people left out (a test beside their errors): where readings and chests are
/// likeliest, and as often as costs a hundredth of likelihood a body at most, for their readings are hardly ever of something else.
/// `astray` is derived, of a belly that is taken for the bust: even over the 0.246 of stature in which a bust is looked for, the
/// deviation is 0.071, four to five times men's 0.015 and women's 0.018 (`levels-1.toml`).
pub(crate) const TAILS: Tails = Tails {
    freedom: 12.0,
    bad: 0.0025,
    astray: 5.0,
};

/// What one population gives where some readings are of something else.
pub(super) struct Answer {
    /// Logarithm of its weight, but for what all share.
    pub(super) weight: f64,
    pub(super) given: Conditional,
}

impl LevelModel {
    /// What a population gives where all readings are right, or one or two are of something else.
    pub(super) fn answers(
        &self,
        population: &Population,
        tails: Tails,
        observed: &[(usize, f64)],
        more: &[f64],
        target: usize,
    ) -> Vec<Answer> {
        let reading = |i: &usize| self.readings[observed[*i].0] != Reading::LnStature;
        let read: Vec<usize> = (0..observed.len()).filter(reading).collect();
        let one = read.iter().map(|a| vec![*a]);
        let two = read.iter().flat_map(|a| {
            let lower = read.iter().filter(move |b| *b < a);
            lower.map(move |b| vec![*a, *b])
        });
        let normal = &population.normal;
        let answer = |bad: Vec<usize>| -> Option<Answer> {
            let mut more = more.to_vec();
            for i in &bad {
                let k = observed[*i].0;
                more[*i] += tails.astray * tails.astray * normal.covariance[(k, k)];
            }
            let given = normal.given_noisy(observed, &more, target)?;
            let odds = bad.len() as f64 * libm::log(tails.bad / (1.0 - tails.bad));
            let weight = libm::log(population.weight) + odds;
            Some(heavy(given, observed.len(), weight, tails.freedom))
        };
        let sets = std::iter::once(Vec::new()).chain(one).chain(two);
        sets.filter_map(answer).collect()
    }
}

/// What a distribution with heavy tails gives in place of a normal one of the same covariance, from so many values.
fn heavy(mut given: Conditional, observed: usize, weight: f64, freedom: f64) -> Answer {
    let (n, free) = (observed as f64, freedom - 2.0);
    let tails = 0.5 * (freedom + n) * libm::log1p(given.distance / free);
    given.variance *= (free + given.distance) / (free + n);
    Answer {
        weight: weight + given.log_density + 0.5 * given.distance - tails,
        given,
    }
}

/// Mean and variance of a mixture.
pub(super) fn mixture(answers: &[Answer]) -> Option<(f64, f64)> {
    let best = answers.iter().map(|a| a.weight).reduce(f64::max)?;
    let weight = |a: &Answer| libm::exp(a.weight - best);
    let total: f64 = answers.iter().map(weight).sum();
    let share = |a: &Answer| weight(a) / total;
    let mean: f64 = answers.iter().map(|a| share(a) * a.given.mean).sum();
    let second = |a: &Answer| share(a) * (a.given.variance + (a.given.mean - mean).powi(2));
    let variance: f64 = answers.iter().map(second).sum();
    Some((mean, variance))
}

#[cfg(test)]
impl LevelModel {
    /// Logarithm of the density of readings of a person and of a level, as shares of stature, by some tails.
    pub(crate) fn density(&self, readings: &Readings, level: (Level, f64), tails: Tails) -> f64 {
        let observed = self.observed(readings);
        let (n, read) = (observed.len() as f64, observed.iter().filter(|o| o.0 > 0));
        let target = self.readings.len() + level.0 as usize;
        let more = self.spread_more(readings, &observed);
        let people = self.populations.iter().filter(|p| p.scope == Scope::People);
        let answers = people.flat_map(|p| self.answers(p, tails, &observed, &more, target));
        let gamma = |x: f64| libm::lgamma(x / 2.0);
        let off = |a: &Answer| (level.1 - a.given.mean).powi(2) / a.given.variance;
        let free = tails.freedom + n;
        // The level has the tails, too, with as many degrees of freedom more as there are readings.
        let one = |a: Answer| {
            let level = -0.5 * libm::log(a.given.variance * (free - 2.0))
                - 0.5 * (free + 1.0) * libm::log1p(off(&a) / (free - 2.0));
            libm::exp(a.weight + level)
        };
        libm::log(answers.map(one).sum::<f64>()) + gamma(free + 1.0)
            - gamma(tails.freedom)
            - 0.5 * n * libm::log((tails.freedom - 2.0) / 2.0)
            + read.count() as f64 * libm::log1p(-tails.bad)
    }
}
