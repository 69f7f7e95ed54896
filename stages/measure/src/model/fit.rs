//! Fits a level model: the levels of measured people, estimated by what a surface shows of made bodies.
//!
//! A survey gives the joint distribution of levels L and measures v of real people, but no surfaces.
//! Made bodies give what our program reads on a surface, r = A v + c + e, for the same measures v, but
//! their ribs and hip bones are nobody's. So for each population of the survey, with mean m and
//! covariance S of (v, L):
//!
//! ```text
//! mean(r) = A m_v + c     cov(r) = A S_vv Aᵀ + E     cov(r, L) = A S_vL     cov(L) = S_LL
//! ```
//!
//! which is Bayes' rule for normal distributions where r depends on L through v alone: made bodies
//! line up readings with the survey's definitions (c, A) and give how well they are read (E), and
//! nothing of where ribs are.

use super::families::left_out;
use super::file::{LevelModel, Population, Scope};
use super::fit_error::FitError;
use super::law::Law;
use super::level::Level;
use super::line_up::{
    GRAIN_SIGMA, LEAST_BODIES, LineUp, READINGS, chi_square_99, like, line_up, pairwise,
    picked_bias, repeat, rounded,
};
use super::normal::Normal;
use super::samples::{ANATOMY, Made, Person, STRANGERS, fitted};
use crate::features::readings::Reading;
use nalgebra::{DMatrix, DVector};
use shape::NINE_IN_TEN;

const LEVELS: usize = Level::ALL.len();
const WIDTH: usize = READINGS + LEVELS;

/// The distribution of readings and levels of some people.
fn of_people(people: &[&Person], lined_up: &LineUp) -> Option<Normal> {
    let a = ANATOMY.len();
    let rows = DMatrix::from_fn(people.len(), a + LEVELS, |i, j| match j < a {
        true => people[i].anatomy[j],
        false => people[i].levels[j - a],
    });
    let both = Normal::of(&rows)?;
    let mut lift = DMatrix::zeros(WIDTH, a + LEVELS);
    lift.view_mut((0, 0), (READINGS, a))
        .copy_from(&lined_up.slope);
    for l in 0..LEVELS {
        lift[(READINGS + l, a + l)] = 1.0;
    }
    let mut covariance = &lift * both.covariance * lift.transpose();
    let mut mean = lift * both.mean;
    for i in 0..READINGS {
        mean[i] += lined_up.offset[i];
        for j in 0..READINGS {
            covariance[(i, j)] += lined_up.error[(i, j)];
        }
    }
    Some(Normal { mean, covariance })
}

/// The same people at any size: the stature gives nothing any more.
fn any_size(normal: &Normal) -> Normal {
    let mut freed = normal.clone();
    for i in 1..WIDTH {
        freed.covariance[(0, i)] = 0.0;
        freed.covariance[(i, 0)] = 0.0;
    }
    freed.covariance[(0, 0)] = 1.0;
    freed
}

/// Made bodies of all ages. Their ribs and hip bones are not anatomy: waist and hip bone are from their
/// navels as people's do, and as far scattered.
fn of_made(made: &[&Made], people: &[&Person]) -> Normal {
    let columns: Vec<Vec<Option<f64>>> = (0..WIDTH)
        .map(|k| match k.checked_sub(READINGS) {
            None => made
                .iter()
                .map(|m| m.readings.get(Reading::ALL[k]))
                .collect(),
            Some(l) => made.iter().map(|m| m.levels[l]).collect(),
        })
        .collect();
    let mean = |column: &[Option<f64>]| {
        let known: Vec<f64> = column.iter().flatten().copied().collect();
        known.iter().sum::<f64>() / known.len().max(1) as f64
    };
    let means: Vec<f64> = columns.iter().map(|c| mean(c)).collect();
    let centred: Vec<Vec<Option<f64>>> = columns
        .iter()
        .zip(&means)
        .map(|(c, m)| c.iter().map(|x| x.map(|x| x - m)).collect())
        .collect();
    let mut covariance = pairwise(&centred);
    let mut mean = DVector::from_vec(means);
    let at = |level: Level| READINGS + level as usize;
    let navel = at(Level::Navel);
    for level in [Level::Waist, Level::HipBone] {
        let above = |p: &&Person| p.levels[level as usize] - p.levels[Level::Navel as usize];
        let n = people.len() as f64;
        let offset = people.iter().map(above).sum::<f64>() / n;
        let variance = people
            .iter()
            .map(|p| (above(p) - offset).powi(2))
            .sum::<f64>()
            / n;
        let k = at(level);
        mean[k] = mean[navel] + offset;
        for j in 0..WIDTH {
            let shared = covariance[(navel, j)];
            covariance[(k, j)] = shared;
            covariance[(j, k)] = shared;
        }
        covariance[(k, k)] = covariance[(navel, navel)] + variance;
    }
    // The two share the navel's own variance.
    let (waist, hip) = (at(Level::Waist), at(Level::HipBone));
    covariance[(waist, hip)] = covariance[(navel, navel)];
    covariance[(hip, waist)] = covariance[(navel, navel)];
    for k in 0..WIDTH {
        covariance[(k, k)] += GRAIN_SIGMA * GRAIN_SIGMA;
    }
    Normal { mean, covariance }
}

/// Fits a model on people and made bodies; laws are fitted by themselves. Levels scatter by as much more as families left out
/// in turn are missed by: whoever is measured is of none of them.
pub(crate) fn fit(
    people: &[&Person],
    made: &[&Made],
    laws: Vec<Law>,
) -> Result<LevelModel, FitError> {
    let mut model = LevelModel {
        laws,
        ..joint(people, made)?
    };
    for (l, more) in unexpected(people, made)?.into_iter().enumerate() {
        for p in &mut model.populations {
            let variance = &mut p.normal.covariance[(READINGS + l, READINGS + l)];
            *variance = rounded(*variance + more);
        }
    }
    Ok(model)
}

/// The model as if all that is measured were of the families that it is fitted on.
pub(crate) fn joint(people: &[&Person], made: &[&Made]) -> Result<LevelModel, FitError> {
    let grown = like(people, made);
    let bias = picked_bias(people, &grown).ok_or(FitError::Singular("people"))?;
    let lined_up = line_up(&grown, &bias)?;
    let mut populations = Vec::new();
    for (name, woman) in [("women", true), ("men", false)] {
        let own: Vec<&Person> = people
            .iter()
            .copied()
            .filter(|p| p.woman == woman)
            .collect();
        let few = FitError::Few {
            reading: name,
            rows: own.len(),
            least: LEAST_BODIES,
        };
        let normal = of_people(&own, &lined_up)
            .filter(|_| own.len() >= LEAST_BODIES)
            .ok_or(few)?;
        let scaled = any_size(&normal);
        populations.push(population(name.into(), Scope::People, normal));
        populations.push(population(format!("{name}, any size"), Scope::Made, scaled));
    }
    let own: Vec<&Made> = made.iter().copied().filter(|m| m.fitted()).collect();
    let all = of_made(&own, people);
    populations.push(population("made bodies".into(), Scope::Made, all));
    Ok(LevelModel {
        readings: Reading::ALL.to_vec(),
        levels: Level::ALL.to_vec(),
        populations,
        limit: (1..=READINGS).map(chi_square_99).collect(),
        reading_sigma: lined_up
            .error
            .diagonal()
            .iter()
            .map(|v| rounded(v.sqrt()))
            .collect(),
        repeat: repeat(
            made,
            |m| &m.id,
            |m| m.repeats.as_deref(),
            READINGS,
            |m, k| m.readings.get(Reading::ALL[k]),
        ),
        laws: Vec::new(),
    })
}

fn population(name: String, scope: Scope, normal: Normal) -> Population {
    Population {
        name,
        scope,
        weight: 1.0,
        normal: Normal {
            mean: normal.mean.map(rounded),
            covariance: normal.covariance.map(rounded),
        },
    }
}

/// By how much the variance of each level is above what a fit expects, where it is to be right on nine in ten of a family
/// that it has not seen, each family counting alike, and on nine in ten of strangers; shares of stature, squared.
fn unexpected(people: &[&Person], made: &[&Made]) -> Result<[f64; LEVELS], FitError> {
    let mut missed = Level::ALL.map(|_| Vec::new());
    let mut of_strangers = missed.clone();
    for fold in left_out(people, made) {
        let readable = like(&fold.people, &fold.made).len() >= LEAST_BODIES;
        let strangers = fold.family == STRANGERS;
        if !(fitted(fold.family) || strangers) || !readable {
            continue;
        }
        let model = joint(&fold.people, &fold.made)?;
        for level in Level::ALL {
            let own: Vec<f64> = fold
                .out
                .iter()
                .filter_map(|m| excess(&model, m, level))
                .collect();
            let each = 1.0 / own.len() as f64;
            let all = match strangers {
                true => &mut of_strangers,
                false => &mut missed,
            };
            all[level as usize].extend(own.into_iter().map(|x| (x, each)));
        }
    }
    let of_strangers = of_strangers.map(nine_in_ten);
    let missed = missed.map(nine_in_ten);
    Ok(std::array::from_fn(|l| missed[l].max(of_strangers[l])))
}

/// The variance that would put a body's true level at the end of its interval, less the one that it has.
fn excess(model: &LevelModel, body: &Made, level: Level) -> Option<f64> {
    let truth = body.levels[level as usize].filter(|_| body.grown)?;
    let found = model.estimate(&body.readings, 1.0, level)?;
    let off = (found.height_mm - truth) / NINE_IN_TEN;
    Some(off * off - found.sigma_mm * found.sigma_mm)
}

/// The least value, nought or above, that nine tenths of all weight are not above.
fn nine_in_ten(mut all: Vec<(f64, f64)>) -> f64 {
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    let total: f64 = all.iter().map(|x| x.1).sum();
    let mut below = 0.0;
    let at = all.iter().find(|x| {
        below += x.1;
        below >= 0.9 * total
    });
    at.map_or(0.0, |x| x.0.max(0.0))
}
