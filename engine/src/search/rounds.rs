//! Round by round: which points are tried next, by what came of those before.

use super::found::{Found, Set, Tried};
use crate::recipe::{Method, Over, OverParam, Sample, Search, Stretch, written};
use crate::sweep::{Axis, axes};
use stage::Value;

/// Points of a round that are to be run.
pub struct Round<'a> {
    /// Which, from 1 on.
    pub number: usize,
    /// What varies: one row a point.
    pub axis: &'a Axis,
}

/// A point's variant and number, in the order of the axis' rows, all of one variant after the other.
pub type Values = Vec<(Option<String>, Option<f64>)>;

/// Runs a search; `run` gives what its metric came to at the points of a round.
///
/// # Errors
///
/// Those of `run`.
pub fn search<E>(
    search: &Search,
    mut run: impl FnMut(&Round<'_>) -> Result<Values, E>,
) -> Result<Found, E> {
    let mut course = Course {
        search,
        found: Found::default(),
        round: 0,
    };
    let sample = search
        .sweep
        .sample
        .as_ref()
        .map_or(Sample { points: 1, seed: 1 }, |s| s.value);
    let variants = search.sweep.with.len().max(1);
    let points = (sample.points / variants).max(1);
    let over = &search.sweep.over;
    match search.method {
        Method::Random => course.tried(&random(over, points, sample.seed), 1.0, &mut run)?,
        Method::Hypercube => {
            let axis = axes::hypercube(over, Sample { points, ..sample });
            course.tried(&axis, 1.0, &mut run)?;
        }
        Method::Narrowing => course.narrowed(over, points, sample.seed, &mut run)?,
        Method::Halving => course.halved(over, points, sample.seed, &mut run)?,
    }
    Ok(course.found)
}

struct Course<'a> {
    search: &'a Search,
    found: Found,
    round: usize,
}

impl Course<'_> {
    /// Runs the points of an axis.
    fn tried<E>(
        &mut self,
        axis: &Axis,
        cost: f64,
        run: &mut impl FnMut(&Round<'_>) -> Result<Values, E>,
    ) -> Result<(), E> {
        self.round += 1;
        let number = self.round;
        let values = run(&Round { number, axis })?;
        for (i, (variant, value)) in values.into_iter().enumerate() {
            let row = &axis.rows[i % axis.rows.len()];
            let pairs = axis.params.iter().zip(row);
            let tried = Tried {
                round: number,
                variant,
                sets: pairs
                    .map(|((n, p), v)| (n.clone(), p.clone(), v.clone()))
                    .collect(),
                value: value.filter(|v| v.is_finite()),
                cost,
            };
            let better = |best: &Tried| self.better(&tried, best);
            if cost >= 1.0 && tried.value.is_some() && self.found.best.as_ref().is_none_or(better) {
                self.found.best = Some(tried.clone());
            }
            self.found.tried.push(tried);
        }
        Ok(())
    }

    /// Whether a point beats another; of equal ones the first is kept.
    fn better(&self, one: &Tried, other: &Tried) -> bool {
        match (one.value, other.value) {
            (Some(a), Some(b)) if self.search.most => a > b,
            (Some(a), Some(b)) => a < b,
            (a, _) => a.is_some() && other.value.is_none(),
        }
    }

    /// Hypercubes of ranges half as wide each time, as many as the budget has halves.
    fn narrowed<E>(
        &mut self,
        over: &[OverParam],
        points: usize,
        seed: u64,
        run: &mut impl FnMut(&Round<'_>) -> Result<Values, E>,
    ) -> Result<(), E> {
        let rounds = (points.ilog2() as usize).max(1);
        for round in 0..rounds {
            // What does not divide evenly goes to the first, which knows least.
            let some = points / rounds + if round == 0 { points % rounds } else { 0 };
            let share = 1.0 / (1u64 << round.min(60)) as f64;
            let around = self.found.best.clone();
            let narrow = |o: &OverParam| narrower(o, around.as_ref(), share);
            let now: Vec<OverParam> = over.iter().map(narrow).collect();
            let sample = Sample {
                points: some,
                seed: seed.wrapping_add(round as u64),
            };
            self.tried(&axes::hypercube(&now, sample), 1.0, run)?;
        }
        Ok(())
    }

    /// Many cheap points, the best third of them three times as dear, and so on up to the full.
    fn halved<E>(
        &mut self,
        over: &[OverParam],
        points: usize,
        seed: u64,
        run: &mut impl FnMut(&Round<'_>) -> Result<Values, E>,
    ) -> Result<(), E> {
        let Some((node, param, range)) = &self.search.dear else {
            return Ok(());
        };
        let Stretch {
            from, to, whole, ..
        } = range.value;
        let steps = (libm::log(to / from) / libm::log(3.0) + 1e-9).max(0.0) as i32;
        // The last step is the full value; those before are thirds of it.
        let values: Vec<f64> = (0..=steps)
            .map(|k| to / libm::pow(3.0, f64::from(steps - k)))
            .collect();
        // A round of n points at a share 3^-k costs n·3^-k, and has 3^k times the last one's: all cost the same.
        let first = ((points as f64 / values.len() as f64) * libm::pow(3.0, f64::from(steps)))
            .max(1.0) as usize;
        let cube = axes::hypercube(
            over,
            Sample {
                points: first,
                seed,
            },
        );
        let mut rows = cube.rows.clone();
        let mut params = cube.params.clone();
        params.push((node.value.clone(), param.value.clone()));
        for value in values {
            let dear = written(value, whole);
            let with = |row: &Vec<Value>| [row.clone(), vec![dear.clone()]].concat();
            let axis = Axis {
                params: params.clone(),
                rows: rows.iter().map(with).collect(),
            };
            let before = self.found.tried.len();
            self.tried(&axis, value / to, run)?;
            // A row counts by the best of its variants.
            let tried = &self.found.tried[before..];
            let best = |i: usize| -> &Tried {
                let own = (i..tried.len()).step_by(axis.rows.len());
                own.map(|at| &tried[at])
                    .reduce(|a, b| if self.better(b, a) { b } else { a })
                    .expect("bug: a row without a point")
            };
            let mut order: Vec<usize> = (0..rows.len()).collect();
            order.sort_by(|a, b| {
                let (a, b) = (best(*a), best(*b));
                match (self.better(a, b), self.better(b, a)) {
                    (true, _) => std::cmp::Ordering::Less,
                    (_, true) => std::cmp::Ordering::Greater,
                    _ => std::cmp::Ordering::Equal,
                }
            });
            order.truncate((rows.len() / 3).max(1));
            rows = order.iter().map(|i| rows[*i].clone()).collect();
        }
        Ok(())
    }
}

/// Points each by itself.
fn random(over: &[OverParam], points: usize, seed: u64) -> Axis {
    let one = |i: usize| {
        axes::hypercube(
            over,
            Sample {
                points: 1,
                seed: seed.wrapping_mul(0x9e37_79b9).wrapping_add(i as u64),
            },
        )
    };
    let all: Vec<Axis> = (0..points).map(one).collect();
    Axis {
        params: all[0].params.clone(),
        rows: all.into_iter().flat_map(|a| a.rows).collect(),
    }
}

/// A number to another.
type Map = fn(f64) -> f64;

/// A range around the best point, so wide a share of the whole; a list stays.
fn narrower((node, param, over): &OverParam, best: Option<&Tried>, share: f64) -> OverParam {
    let here = |(n, p, v): &Set| match v {
        _ if *n != node.value || *p != param.value => None,
        Value::Int(i) => Some(*i as f64),
        Value::Float(x) => Some(*x),
        _ => None,
    };
    let middle = best.and_then(|b| b.sets.iter().find_map(here));
    let narrowed = match (over, middle) {
        (Over::Range(spanned), Some(middle)) => {
            let s = &spanned.value;
            let (f, back): (Map, Map) = match s.log {
                true => (libm::log, libm::exp),
                false => (|x| x, |x| x),
            };
            let (low, high) = (f(s.from.min(s.to)), f(s.from.max(s.to)));
            let half = (high - low) * share / 2.0;
            // The range moves in where it would reach out.
            let centre = f(middle).clamp(low + half, high - half);
            let mut narrow = spanned.clone();
            narrow.value.from = back(centre - half).max(s.from.min(s.to));
            narrow.value.to = back(centre + half).min(s.from.max(s.to));
            Over::Range(narrow)
        }
        _ => over.clone(),
    };
    (node.clone(), param.clone(), narrowed)
}

#[cfg(test)]
#[path = "rounds_tests.rs"]
mod tests;
