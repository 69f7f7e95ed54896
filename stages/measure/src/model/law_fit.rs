//! Fits laws on a table of made bodies, and says how they do on families left out.

use super::fit::FitError;
use super::held_out::{HeldOut, Miss, NINE_IN_TEN, quantile, summary, tenth};
use super::law::{Law, Place};
use super::line_up::{LEAST, pairwise, rounded};
use super::normal::Normal;
use super::samples::fitted;
use super::table::{Table, TableError};
use nalgebra::DMatrix;

/// One body: features of a law and the true place.
#[derive(Debug, Clone)]
pub(crate) struct LawSample {
    /// Its own name in the table.
    id: String,
    family: String,
    /// The body that this is another capture of.
    repeats: Option<String>,
    features: Vec<f64>,
    place: f64,
    /// The law's unit on this body. \[mm\]
    unit_mm: f64,
    /// Tapes over places, from [`Place::profile`] on; any unit.
    tapes: Vec<Option<f64>>,
}

impl LawSample {
    /// Its features, numbered.
    fn observed(&self) -> Vec<(usize, f64)> {
        self.features.iter().copied().enumerate().collect()
    }

    /// Tape at a place.
    fn tape(&self, law: Place, at: f64) -> Option<f64> {
        let (low, step) = law.profile()?;
        let k = (at - low) / step;
        let (below, t) = (k.floor(), k - k.floor());
        if below < 0.0 {
            return None;
        }
        let tape = |k: usize| self.tapes.get(k).copied().flatten();
        Some(tape(below as usize)? * (1.0 - t) + tape(below as usize + 1)? * t)
    }
}

/// Rows of a law's table that have all its features and are not refused.
pub(crate) fn samples(law: Place, table: &Table) -> Result<Vec<LawSample>, TableError> {
    let features = law.features().iter().map(|f| format!("f.{f}"));
    let features: Vec<Vec<Option<f64>>> = features
        .map(|column| table.optional(&column))
        .collect::<Result<_, _>>()?;
    let (id, family, repeats) = (
        table.text("id")?,
        table.text("family")?,
        table.text("repeats")?,
    );
    let place = table.optional(law.column())?;
    let (unit, refused) = (table.numbers("unit_mm")?, table.numbers("refused")?);
    let tapes = table.starting_with("t")?;
    let one = |i: usize| -> Option<LawSample> {
        let whole: Option<Vec<f64>> = features.iter().map(|f| f[i]).collect();
        (refused[i] == 0.0).then_some(LawSample {
            id: id[i].into(),
            family: family[i].into(),
            repeats: Some(repeats[i])
                .filter(|r| !r.is_empty())
                .map(str::to_owned),
            features: whole?,
            place: place[i]?,
            unit_mm: unit[i],
            tapes: tapes.iter().map(|t| t[i]).collect(),
        })
    };
    Ok((0..table.len()).filter_map(one).collect())
}

/// Fits a law. Its sigma is what nine in ten of the families left out in turn are missed by, as a standard
/// deviation, each family counting the same: a stranger is of none of them.
pub(crate) fn fit_law(law: Place, samples: &[&LawSample]) -> Result<Law, FitError> {
    let own: Vec<&LawSample> = samples
        .iter()
        .copied()
        .filter(|s| s.repeats.is_none() && fitted(&s.family))
        .collect();
    let singular = || FitError::Singular(law.name());
    let normal = regression(law, &own)?;
    let n = law.features().len();
    let mut squares = Vec::new();
    for family in families(&own) {
        let (out, rest): (Vec<_>, Vec<_>) = own.iter().partition(|s| s.family == family);
        if rest.len() >= LEAST {
            let without = regression(law, &rest)?;
            let told = |s: &&LawSample| Some(without.given(&s.observed(), n)?.mean - s.place);
            let off: Option<Vec<f64>> = out.iter().map(told).collect();
            let off = off.ok_or_else(singular)?;
            let nine = quantile(off.into_iter(), 0.9) / NINE_IN_TEN;
            squares.push(nine * nine);
        }
    }
    let within = |s: &&LawSample| normal.given(&s.observed(), n);
    let given: Option<Vec<_>> = own.iter().map(within).collect();
    let given = given.ok_or_else(singular)?;
    // One family says nothing of others: its own residual.
    squares.extend(squares.is_empty().then_some(given[0].variance));
    let sigma = (squares.iter().sum::<f64>() / squares.len() as f64).sqrt();
    let mut distances: Vec<f64> = given.iter().map(|g| g.distance).collect();
    distances.sort_by(f64::total_cmp);
    Ok(Law {
        place: law,
        sigma: rounded(sigma),
        limit: rounded(distances[(distances.len() - 1) * 99 / 100]),
        repeat: repeat(law, samples),
        normal,
    })
}

/// The families of samples, in order.
fn families<'a>(samples: &[&'a LawSample]) -> Vec<&'a str> {
    let mut all: Vec<&str> = samples.iter().map(|s| s.family.as_str()).collect();
    all.sort_unstable();
    all.dedup();
    all
}

/// The distribution of features and place over samples.
fn regression(law: Place, own: &[&LawSample]) -> Result<Normal, FitError> {
    if own.len() < LEAST {
        return Err(FitError::Few {
            reading: law.name(),
            rows: own.len(),
            least: LEAST,
        });
    }
    let n = law.features().len();
    let rows = DMatrix::from_fn(own.len(), n + 1, |i, j| match j < n {
        true => own[i].features[j],
        false => own[i].place,
    });
    let normal = Normal::of(&rows).ok_or(FitError::Singular(law.name()))?;
    Ok(Normal {
        mean: normal.mean.map(rounded),
        covariance: normal.covariance.map(rounded),
    })
}

/// Covariance of features between two captures of one body: half of what their differences scatter.
/// `None` with fewer than [`LEAST`] pairs.
fn repeat(law: Place, samples: &[&LawSample]) -> Option<DMatrix<f64>> {
    let pairs: Vec<(&LawSample, &LawSample)> = samples
        .iter()
        .filter_map(|s| {
            let first = s.repeats.as_ref()?;
            Some((samples.iter().copied().find(|o| o.id == *first)?, *s))
        })
        .collect();
    if pairs.len() < LEAST {
        return None;
    }
    let half = |k: usize| -> Vec<Option<f64>> {
        let off = |(a, b): &(&LawSample, &LawSample)| (a.features[k] - b.features[k]) / 2f64.sqrt();
        pairs.iter().map(|p| Some(off(p))).collect()
    };
    let columns: Vec<Vec<Option<f64>>> = (0..law.features().len()).map(half).collect();
    Some(pairwise(&columns).map(rounded))
}

/// Fits a law without each family in turn and a tenth of the rest, and tells that family by it.
pub(crate) fn law_held_out(law: Place, samples: &[LawSample]) -> Result<Vec<HeldOut>, FitError> {
    let first: Vec<&LawSample> = samples.iter().filter(|s| s.repeats.is_none()).collect();
    let mut found = Vec::new();
    for family in families(&first) {
        let (out, rest): (Vec<_>, Vec<_>) = samples
            .iter()
            .enumerate()
            .partition(|(_, s)| s.family == family);
        let kept = rest.iter().filter(|(i, _)| !tenth(*i)).map(|(_, s)| *s);
        let fitted = fit_law(law, &kept.collect::<Vec<_>>())?;
        let all: Vec<Miss> = out.iter().filter_map(|(_, s)| miss(&fitted, s)).collect();
        found.push(summary(family, law.name(), &all));
    }
    Ok(found)
}

/// How a law tells a body whose true place is known.
fn miss(law: &Law, s: &LawSample) -> Option<Miss> {
    let told = law.estimate(&s.features)?;
    let off = told.value - s.place;
    let tapes = s
        .tape(law.place, told.value)
        .zip(s.tape(law.place, s.place));
    Some(Miss {
        mm: off * s.unit_mm,
        inside: off.abs() <= NINE_IN_TEN * told.sigma,
        tape: tapes.map(|(got, want)| got / want - 1.0),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    /// Laws of the middle of the upper arm, the one that is used first.
    const UPPER_ARM: [Place; 4] = [
        Place::UpperArmBentByShoulder,
        Place::UpperArmBent,
        Place::UpperArmByShoulder,
        Place::UpperArm,
    ];

    /// Upper arms of a family as laws tell them that were fitted without it.
    fn left_out(family: &str, laws: &[(Place, Vec<LawSample>)]) -> Vec<Miss> {
        let mut told = BTreeSet::new();
        let mut all = Vec::new();
        for (place, samples) in laws {
            let rest: Vec<&LawSample> = samples.iter().filter(|s| s.family != family).collect();
            let law = fit_law(*place, &rest).unwrap();
            for s in samples.iter().filter(|s| s.family == family) {
                if told.insert(&s.id) {
                    all.extend(miss(&law, s));
                }
            }
        }
        all
    }

    #[test]
    fn upper_arms_of_families_left_out_have_intervals_that_hold() {
        let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../models/tables/arms.csv");
        let table = Table::read("arms.csv", &std::fs::read(file).unwrap()).unwrap();
        let laws = UPPER_ARM.map(|place| (place, samples(place, &table).unwrap()));
        let mut all = Vec::new();
        for family in ["range", "survey", "reach", "poses"] {
            let own = left_out(family, &laws);
            eprintln!("{}", summary(family, "upper_arm", &own).lines());
            if fitted(family) {
                all.extend(own);
            }
        }
        let all = summary("all", "upper_arm", &all);
        eprintln!("{}", all.lines());
        assert!(all.bodies > 1300, "{}", all.bodies);
        assert!((0.87..=0.94).contains(&all.coverage), "{}", all.coverage);
        assert!(all.tape_middle < 0.6, "{}", all.tape_middle);
        assert!(all.tape_nine < 2.6, "{}", all.tape_nine);
    }
}
