//! A level from what a surface shows: the mixture of the populations that fit it.

use super::file::{LevelModel, Population, Scope};
use super::level::Level;
use super::normal::Conditional;
use crate::features::readings::{Reading, Readings};

/// A level as the model tells it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LevelEstimate {
    /// Height above the ground. \[mm\]
    pub height_mm: f64,
    /// Standard deviation of the predictive distribution. \[mm\]
    pub sigma_mm: f64,
    /// Standard deviation when the same person is measured again: what readings alone scatter. \[mm\]
    pub repeat_mm: Option<f64>,
    /// How well the body is covered by what the model was fitted on.
    pub cover: Cover,
}

/// How well a body is covered by what a model was fitted on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cover {
    /// Like the measured people.
    People,
    /// Outside of the measured people, like the made bodies: levels come from these.
    Made,
    /// Outside of both.
    Outside,
}

/// People's statures are within so many standard deviations: all but one in two thousand.
pub(crate) const SIZES: f64 = 3.5;

/// A population's own answer.
struct Answer<'a> {
    population: &'a Population,
    given: Conditional,
}

/// What populations give together, as shares of stature.
#[derive(Clone, Copy)]
struct Answered {
    mean: f64,
    variance: f64,
    /// Variance of what readings alone scatter.
    repeat: Option<f64>,
    /// Squared distance of the readings from the nearest population, in that of 99 in 100.
    far: f64,
    cover: Cover,
}

impl LevelModel {
    /// A level from readings of a body of some stature \[mm\]. `None` where the readings say nothing,
    /// or the model does not know the level.
    pub fn estimate(
        &self,
        readings: &Readings,
        stature_mm: f64,
        level: Level,
    ) -> Option<LevelEstimate> {
        self.observed(readings).first()?;
        let target = self.readings.len() + self.levels.iter().position(|l| *l == level)?;
        self.reported(readings, stature_mm, target)
    }

    /// A reading that does not show, from those that do, as [`estimate`](Self::estimate) tells a level.
    pub fn hidden(
        &self,
        readings: &Readings,
        stature_mm: f64,
        reading: Reading,
    ) -> Option<LevelEstimate> {
        let target = self.readings.iter().position(|r| *r == reading)?;
        self.reported(&readings.clone().with(reading, None), stature_mm, target)
    }

    /// Whether readings are those of a body that the model knows, of measured people or of made bodies: 99 in 100
    /// of them are.
    pub fn knows(&self, readings: &Readings) -> bool {
        let observed = self.observed(readings);
        let limit = observed
            .len()
            .checked_sub(1)
            .and_then(|n| self.limit.get(n));
        let near = |p: &Population| {
            let given = p.normal.given(&observed, self.readings.len());
            given
                .zip(limit)
                .is_some_and(|(given, limit)| given.distance <= *limit)
        };
        self.populations.iter().any(near)
    }

    /// The readings that there are, by the model's variables.
    fn observed(&self, readings: &Readings) -> Vec<(usize, f64)> {
        let all = self.readings.iter().enumerate();
        all.filter_map(|(i, r)| Some((i, readings.get(*r)?)))
            .collect()
    }

    /// By how much the variance of each observed reading is above what it is of made bodies: on this surface it is spread.
    fn spread_more(&self, readings: &Readings, observed: &[(usize, f64)]) -> Vec<f64> {
        let more = |(k, _): &(usize, f64)| {
            let spread = readings.spread(self.readings[*k]);
            (spread * spread - self.reading_sigma[*k].powi(2)).max(0.0)
        };
        observed.iter().map(more).collect()
    }

    /// One of the model's variables from readings. Where nobody has such a body but for a few of them, those are bad:
    /// the worst is left out in turn, as long as most agree. It is no better known for that.
    fn reported(
        &self,
        readings: &Readings,
        stature_mm: f64,
        target: usize,
    ) -> Option<LevelEstimate> {
        let all = self.answered(readings, target)?;
        let most = self.observed(readings).len() / 2;
        let (mut used, mut from) = (readings.clone(), all);
        while from.cover == Cover::Outside && self.observed(&used).len() > most + 1 {
            let seen = Reading::ALL.into_iter().filter(|r| used.get(*r).is_some());
            let without = |reading: Reading| {
                let rest = used.clone().with(reading, None);
                Some((self.answered(&rest, target)?, rest))
            };
            let lengths = seen.filter(|r| *r != Reading::LnStature);
            let best = lengths.filter_map(without);
            let Some(best) = best.min_by(|a, b| a.0.far.total_cmp(&b.0.far)) else {
                break;
            };
            (from, used) = best;
        }
        if from.cover == Cover::Outside {
            from = all;
        }
        // Where nobody knows the body, errors grow as it is farther away.
        let wider = all.far.max(1.0).sqrt();
        Some(LevelEstimate {
            height_mm: from.mean * stature_mm,
            sigma_mm: from.variance.sqrt() * wider * stature_mm,
            repeat_mm: from.repeat.map(|v| v.sqrt() * stature_mm),
            cover: all.cover,
        })
    }

    /// A variable by the populations that fit these readings.
    fn answered(&self, readings: &Readings, target: usize) -> Option<Answered> {
        let observed = self.observed(readings);
        // Of a body of which nothing is read, nobody is unlike.
        let limit = match observed.len().checked_sub(1) {
            Some(n) => *self.limit.get(n)?,
            None => f64::INFINITY,
        };
        let more = self.spread_more(readings, &observed);
        let answers = |scope: Scope| -> Vec<Answer<'_>> {
            self.populations
                .iter()
                .filter(|p| p.scope == scope)
                .filter_map(|population| {
                    let given = population.normal.given_noisy(&observed, &more, target)?;
                    Some(Answer { population, given })
                })
                .collect()
        };
        let near = |all: &[Answer<'_>]| all.iter().any(|a| a.given.distance <= limit);
        let (people, made) = (answers(Scope::People), answers(Scope::Made));
        // Made bodies stand in where people are of another size altogether: their ribs are nobody's.
        let (from, cover) = match (near(&people), self.of_their_size(readings)) {
            (true, _) => (people, Cover::People),
            (false, true) => (people, Cover::Outside),
            (false, false) if near(&made) => (made, Cover::Made),
            (false, false) if made.is_empty() => (people, Cover::Outside),
            (false, false) => (made, Cover::Outside),
        };
        let (mean, variance) = mixture(&from)?;
        let nearest = from.iter().map(|a| a.given.distance).reduce(f64::min)?;
        Some(Answered {
            mean,
            variance,
            repeat: self.repeat_variance(&observed, &more, &from),
            far: nearest / limit,
            cover,
        })
    }

    /// Whether a stature is one that the measured people have; unknown ones may be.
    fn of_their_size(&self, readings: &Readings) -> bool {
        let at = self.readings.iter().position(|r| *r == Reading::LnStature);
        let Some((k, value)) = at.and_then(|k| Some((k, readings.get(Reading::LnStature)?))) else {
            return true;
        };
        let people = self.populations.iter().filter(|p| p.scope == Scope::People);
        people.into_iter().any(|p| {
            let off = value - p.normal.mean[k];
            off * off <= SIZES * SIZES * p.normal.covariance[(k, k)]
        })
    }

    /// How sure a reading itself is against its definition, and when the same person is measured again:
    /// standard deviations for a body of some stature. \[mm\]
    pub fn reading(&self, reading: Reading, stature_mm: f64) -> Option<(f64, Option<f64>)> {
        let k = self.readings.iter().position(|r| *r == reading)?;
        let again = self.repeat.as_ref().map(|r| r[(k, k)].sqrt() * stature_mm);
        Some((self.reading_sigma[k] * stature_mm, again))
    }

    /// The variance of the level that the scatter of readings alone makes, by the population that fits
    /// best.
    fn repeat_variance(
        &self,
        observed: &[(usize, f64)],
        more: &[f64],
        answers: &[Answer<'_>],
    ) -> Option<f64> {
        let repeat = self.repeat.as_ref()?;
        let best = answers
            .iter()
            .max_by(|a, b| a.given.log_density.total_cmp(&b.given.log_density))?;
        let weights = &best.given.weights;
        let own = weights.iter().zip(more);
        let mut sum: f64 = own.map(|(weight, more)| weight * weight * more).sum();
        for (i, (a, _)) in observed.iter().enumerate() {
            for (j, (b, _)) in observed.iter().enumerate() {
                sum += weights[i] * repeat[(*a, *b)] * weights[j];
            }
        }
        Some(sum.max(0.0))
    }
}

/// Mean and variance of a mixture whose weights are how likely each population makes the readings.
fn mixture(answers: &[Answer<'_>]) -> Option<(f64, f64)> {
    let best = answers
        .iter()
        .map(|a| a.given.log_density)
        .reduce(f64::max)?;
    let weight = |a: &Answer<'_>| a.population.weight * libm::exp(a.given.log_density - best);
    let total: f64 = answers.iter().map(weight).sum();
    let share = |a: &Answer<'_>| weight(a) / total;
    let mean: f64 = answers.iter().map(|a| share(a) * a.given.mean).sum();
    let second = |a: &Answer<'_>| share(a) * (a.given.variance + (a.given.mean - mean).powi(2));
    let variance: f64 = answers.iter().map(second).sum();
    Some((mean, variance))
}
