//! A level from what a surface shows: the mixture of the populations that fit it.

use super::file::{LevelModel, Population, Scope};
use super::level::Level;
use super::tails::{Answer, TAILS, mixture};
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

/// People's statures are within so many standard deviations: all but one in two thousand (derived: of a normal distribution).
pub(crate) const SIZES: f64 = 3.5;

/// What populations give together, as shares of stature.
struct Answered {
    mean: f64,
    variance: f64,
    /// Variance of what readings alone scatter.
    repeat: Option<f64>,
    cover: Cover,
}

impl LevelModel {
    /// A level from readings of a body of some stature \[mm\]. `None` where the readings give nothing,
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
    pub(super) fn observed(&self, readings: &Readings) -> Vec<(usize, f64)> {
        let all = self.readings.iter().enumerate();
        all.filter_map(|(i, r)| Some((i, readings.get(*r)?)))
            .collect()
    }

    /// By how much the variance of each observed reading is above what it is of made bodies: on this surface it is spread.
    pub(super) fn spread_more(&self, readings: &Readings, observed: &[(usize, f64)]) -> Vec<f64> {
        let more = |(k, _): &(usize, f64)| {
            let spread = readings.spread(self.readings[*k]);
            (spread * spread - self.reading_sigma[*k].powi(2)).max(0.0)
        };
        observed.iter().map(more).collect()
    }

    /// One of the model's variables from readings.
    fn reported(
        &self,
        readings: &Readings,
        stature_mm: f64,
        target: usize,
    ) -> Option<LevelEstimate> {
        let found = self.answered(readings, target)?;
        Some(LevelEstimate {
            height_mm: found.mean * stature_mm,
            sigma_mm: found.variance.sqrt() * stature_mm,
            repeat_mm: found.repeat.map(|v| v.sqrt() * stature_mm),
            cover: found.cover,
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
        let near = |scope: Scope| {
            let own = self.populations.iter().filter(|p| p.scope == scope);
            own.filter_map(|p| p.normal.given_noisy(&observed, &more, target))
                .any(|given| given.distance <= limit)
        };
        // Made bodies serve where people are of another size altogether: their ribs are nobody's.
        let known = self.populations.iter().any(|p| p.scope == Scope::Made);
        let (from, cover) = match near(Scope::People) {
            true => (Scope::People, Cover::People),
            false if self.of_their_size(readings) || !known => (Scope::People, Cover::Outside),
            false if near(Scope::Made) => (Scope::Made, Cover::Made),
            false => (Scope::Made, Cover::Outside),
        };
        let own = self.populations.iter().filter(|p| p.scope == from);
        let answers: Vec<Answer> = own
            .flat_map(|p| self.answers(p, TAILS, &observed, &more, target))
            .collect();
        let (mean, variance) = mixture(&answers)?;
        Some(Answered {
            mean,
            variance,
            repeat: self.repeat_variance(&observed, &more, &answers),
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
        answers: &[Answer],
    ) -> Option<f64> {
        let repeat = self.repeat.as_ref()?;
        let best = answers
            .iter()
            .max_by(|a, b| a.weight.total_cmp(&b.weight))?;
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
