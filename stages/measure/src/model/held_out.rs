//! What a fit does on bodies that it has not seen: each family left out in turn, with a tenth of the rest.

use super::families::{LeftOut, left_out};
use super::file::LevelModel;
use super::fit::fit;
use super::fit_error::FitError;
use super::level::Level;
use super::line_up::rounded;
use super::predict::LevelEstimate;
use super::samples::{Made, Person};
use shape::NINE_IN_TEN;
use std::fmt::Write;

/// Errors of one level on what one fit left out.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct HeldOut {
    /// The family.
    pub family: String,
    /// The level, or the place of a law.
    pub level: &'static str,
    /// How many bodies.
    pub bodies: usize,
    /// Mean error of the height, estimated less true. \[mm\]
    pub bias_mm: f64,
    /// Median of the height's absolute error. \[mm\]
    pub middle_mm: f64,
    /// Nine in ten are within. \[mm\]
    pub nine_mm: f64,
    /// Median of the tape's absolute error by the level alone; NaN where no tape hangs on it. \[%\]
    pub tape_middle: f64,
    /// Nine in ten are within. \[%\]
    pub tape_nine: f64,
    /// Share of true heights within the 90 % interval.
    pub coverage: f64,
}

impl HeldOut {
    /// As lines of TOML.
    pub(crate) fn lines(&self) -> String {
        let HeldOut {
            family,
            level,
            bodies,
            bias_mm,
            middle_mm,
            nine_mm,
            tape_middle,
            tape_nine,
            coverage,
        } = self;
        let mut text = format!(
            "family = \"{family}\"\nlevel = \"{level}\"\nbodies = {bodies}\nbias_mm = {bias_mm:.1}\nmiddle_mm = {middle_mm:.1}\n\
             nine_in_ten_mm = {nine_mm:.1}\n"
        );
        if tape_middle.is_finite() {
            let _ = write!(
                text,
                "tape_middle_percent = {tape_middle:.2}\ntape_nine_in_ten_percent = {tape_nine:.2}\n"
            );
        }
        let _ = write!(text, "coverage_of_90 = {coverage:.3}");
        text
    }
}

/// One body's error.
pub(crate) struct Miss {
    /// Estimated less true. \[mm\]
    pub mm: f64,
    /// Whether the truth is within the 90 % interval.
    pub inside: bool,
    /// The tape's error by it, as a share.
    pub tape: Option<f64>,
}

/// The `q` quantile of absolute values.
pub(crate) fn quantile(values: impl Iterator<Item = f64>, q: f64) -> f64 {
    let mut all: Vec<f64> = values.map(f64::abs).collect();
    all.sort_by(f64::total_cmp);
    match all.len() {
        0 => f64::NAN,
        n => all[(((n - 1) as f64) * q).round() as usize],
    }
}

pub(crate) fn summary(family: &str, level: &'static str, all: &[Miss]) -> HeldOut {
    let n = all.len().max(1) as f64;
    HeldOut {
        family: family.into(),
        level,
        bodies: all.len(),
        bias_mm: rounded(all.iter().map(|m| m.mm).sum::<f64>() / n),
        middle_mm: quantile(all.iter().map(|m| m.mm), 0.5),
        nine_mm: quantile(all.iter().map(|m| m.mm), 0.9),
        tape_middle: 100.0 * quantile(all.iter().filter_map(|m| m.tape), 0.5),
        tape_nine: 100.0 * quantile(all.iter().filter_map(|m| m.tape), 0.9),
        coverage: all.iter().filter(|m| m.inside).count() as f64 / n,
    }
}

fn miss(reported: &LevelEstimate, body: &Made, truth: f64) -> Miss {
    let mm = reported.height_mm - truth * body.stature;
    let tapes = body
        .tape(reported.height_mm / body.stature)
        .zip(body.tape(truth));
    Miss {
        mm,
        inside: mm.abs() <= NINE_IN_TEN * reported.sigma_mm,
        tape: tapes.map(|(got, want)| got / want - 1.0),
    }
}

/// Whether a row belongs to the tenth that is left out beside a family: by its number alone.
pub(crate) fn tenth(row: usize) -> bool {
    row % 10 == 3
}

/// Fits without each family in turn and tells it. A family that was driven to single people is estimated by
/// a fit without them, too.
pub(crate) fn held_out(people: &[Person], made: &[Made]) -> Result<Vec<HeldOut>, FitError> {
    let (people, made): (Vec<_>, Vec<_>) = (people.iter().collect(), made.iter().collect());
    let mut found = Vec::new();
    for LeftOut {
        family,
        out,
        people,
        made,
    } in left_out(&people, &made)
    {
        let others: Vec<_> = people.into_iter().filter(|p| !tenth(p.row)).collect();
        let kept: Vec<_> = made.into_iter().filter(|m| !tenth(m.row)).collect();
        let model = fit(&others, &kept, Vec::new())?;
        for level in Level::ALL {
            let all: Vec<Miss> = out.iter().filter_map(|m| one(&model, m, level)).collect();
            if !all.is_empty() {
                found.push(summary(family, level.name(), &all));
            }
        }
    }
    Ok(found)
}

/// How a model tells a level of a body whose true level is known.
fn one(model: &LevelModel, body: &Made, level: Level) -> Option<Miss> {
    let truth = body.levels[level as usize]?;
    let reported = model.estimate(&body.readings, body.stature, level)?;
    Some(miss(&reported, body, truth))
}

#[cfg(test)]
mod tests {
    use super::super::fit::joint;
    use super::super::line_up::{like, line_up, picked_bias};
    use super::super::samples::{made as read_made, people as read_people};
    use super::super::table::Table;
    use super::super::tails::{TAILS, Tails};
    use super::*;
    use crate::features::readings::{Reading, Readings};

    /// Numbers of mean 0 and variance 1, near enough to normal: twelve even ones each (a fixed sequence).
    fn normal(state: &mut u64) -> f64 {
        let mut even = || {
            *state = state
                .wrapping_mul(6364136223846793005)
                .wrapping_add(1442695040888963407);
            (*state >> 11) as f64 / (1u64 << 53) as f64
        };
        (0..12).map(|_| even()).sum::<f64>() - 6.0
    }

    /// People of the survey whom no fit has seen: bias, standard deviation \[mm\] and coverage of one
    /// level, men and women, with readings that err as those of made surfaces.
    fn on_people(level: Level) -> [(f64, f64, f64); 2] {
        let people = read_people(&Table::checked_in("ansur2.csv")).unwrap();
        let made = read_made(&Table::checked_in("made-bodies.csv")).unwrap();
        let (fitted, others): (Vec<&Person>, Vec<&Person>) =
            people.iter().partition(|p| p.row % 2 == 0);
        let made: Vec<&Made> = made.iter().collect();
        let model = joint(&fitted, &made).unwrap();
        let grown = like(&fitted, &made);
        let lined_up = line_up(&grown, &picked_bias(&fitted, &grown).unwrap()).unwrap();
        let (scatter, mut state) = (lined_up.scatter(), 7);
        [false, true].map(|woman| {
            let mut off = Vec::new();
            for person in others.iter().filter(|p| p.woman == woman) {
                let error =
                    nalgebra::DVector::from_fn(Reading::ALL.len(), |_, _| normal(&mut state));
                let read = lined_up.mean(&person.anatomy) + &scatter * error;
                let read = Reading::ALL.into_iter().zip(read.iter());
                let read = read.fold(Readings::default(), |all, (r, v)| all.with(r, Some(*v)));
                let stature = 1700.0 * libm::exp(person.anatomy[0]);
                let reported = model.estimate(&read, stature, level).unwrap();
                let miss = reported.height_mm - person.levels[level as usize] * stature;
                off.push((miss, miss.abs() <= NINE_IN_TEN * reported.sigma_mm));
            }
            let n = off.len() as f64;
            let mean = off.iter().map(|o| o.0).sum::<f64>() / n;
            let square = off.iter().map(|o| (o.0 - mean).powi(2)).sum::<f64>() / n;
            (
                mean,
                square.sqrt(),
                off.iter().filter(|o| o.1).count() as f64 / n,
            )
        })
    }

    #[test]
    fn levels_of_people_that_no_fit_has_seen_have_no_bias_and_intervals_that_hold() {
        for (level, most) in [(Level::Waist, [14.5, 13.0]), (Level::Chest, [17.0, 21.0])] {
            for ((bias, sd, coverage), most) in on_people(level).into_iter().zip(most) {
                eprintln!("{level:?}: {bias:+.1} ± {sd:.1} mm, {coverage:.3}");
                assert!(bias.abs() < 2.0, "{level:?}: {bias}");
                assert!(sd < most, "{level:?}: {sd}");
                assert!((0.87..=0.94).contains(&coverage), "{level:?}: {coverage}");
            }
        }
    }

    #[test]
    fn tails_are_those_by_which_bodies_of_people_left_out_are_likely() {
        let people = read_people(&Table::checked_in("ansur2.csv")).unwrap();
        let made = read_made(&Table::checked_in("made-bodies.csv")).unwrap();
        let (out, rest): (Vec<&Made>, Vec<&Made>) = made.iter().partition(|m| m.family == "survey");
        let rest_of_people = people
            .iter()
            .filter(|p| !out.iter().any(|m| m.person == Some(p.row)));
        let model = joint(&rest_of_people.collect::<Vec<_>>(), &rest).unwrap();
        let of = |freedom: f64, bad: f64| {
            let one = |m: &&Made| {
                let chest = m.levels[Level::Chest as usize]?;
                Some(model.density(
                    &m.readings,
                    (Level::Chest, chest),
                    Tails {
                        freedom,
                        bad,
                        ..TAILS
                    },
                ))
            };
            out.iter().filter_map(one).sum::<f64>()
        };
        let best = of(TAILS.freedom, TAILS.bad);
        for freedom in [8.0, 18.0] {
            let other = of(freedom, TAILS.bad);
            eprintln!("{freedom}: {:+.2}", other - best);
            assert!(other < best);
        }
        let cost = |bad: f64| (of(TAILS.freedom, 1e-6) - of(TAILS.freedom, bad)) / out.len() as f64;
        let costs = [cost(TAILS.bad), cost(2.0 * TAILS.bad)];
        eprintln!("{costs:.4?}");
        assert!(costs[0] < 0.01 && costs[1] > 0.01, "{costs:?}");
    }
}
