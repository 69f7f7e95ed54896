//! Fits laws on a table of made bodies, and how they do on families left out.

use super::fit_error::FitError;
use super::held_out::{HeldOut, Miss, quantile, summary, tenth};
use super::law::{Law, Place};
use super::line_up::{LEAST_BODIES, repeat, rounded};
use super::normal::Normal;
use super::samples::fitted;
use super::table::{Table, TableError};
use super::tapes::Tapes;
use nalgebra::DMatrix;
use shape::NINE_IN_TEN;

/// One body: features of a law and, where known, the true place.
#[derive(Debug, Clone)]
pub(crate) struct LawSample {
    /// Its row in the table.
    pub row: usize,
    /// Its own name in the table.
    id: String,
    family: String,
    /// The body that this is another capture of.
    repeats: Option<String>,
    /// In the order of [`Place::features`].
    pub features: Vec<f64>,
    place: Option<f64>,
    /// The law's unit on this body. \[mm\]
    unit_mm: f64,
    /// Tapes over places, where the law's place is that of a tape.
    tapes: Option<Tapes>,
}

/// Rows of a law's table that have all its features and are not refused.
pub(crate) fn samples(law: Place, table: &Table) -> Result<Vec<LawSample>, TableError> {
    let features = law.features().into_iter().map(|f| format!("f.{f}"));
    let features: Vec<Vec<Option<f64>>> = features
        .map(|column| table.optional(&column))
        .collect::<Result<_, _>>()?;
    let (id, family) = (table.text("id")?, table.text("family")?);
    let repeats = table.text("repeats")?;
    let place = table.optional(law.column())?;
    let (unit, refused) = (table.numbers("unit_mm")?, table.numbers("refused")?);
    let columns = match law.tapes() {
        Some(_) => table.starting_with("t")?,
        None => vec![],
    };
    let tapes = |row: usize| {
        let (from, step) = law.tapes()?;
        let all = columns.iter().map(|t| t[row]).collect();
        Some(Tapes { from, step, all })
    };
    let one = |row: usize| -> Option<LawSample> {
        let whole: Option<Vec<f64>> = features.iter().map(|f| f[row]).collect();
        (refused[row] == 0.0).then_some(LawSample {
            row,
            id: id[row].into(),
            family: family[row].into(),
            repeats: Some(repeats[row])
                .filter(|r| !r.is_empty())
                .map(str::to_owned),
            features: whole?,
            place: place[row],
            unit_mm: unit[row],
            tapes: tapes(row),
        })
    };
    Ok((0..table.len()).filter_map(one).collect())
}

/// Fits a law. Its sigma is what nine in ten of the bodies of families left out in turn are missed by, as a
/// standard deviation: a stranger is of none of them.
pub(crate) fn fit_law(law: Place, samples: &[&LawSample]) -> Result<Law, FitError> {
    let own: Vec<&LawSample> = samples
        .iter()
        .copied()
        .filter(|s| s.repeats.is_none() && s.place.is_some() && fitted(&s.family))
        .collect();
    let all = of_one_family(law, &own)?;
    let mut missed = Vec::new();
    for family in families(&own) {
        let (out, rest): (Vec<_>, Vec<_>) = own.iter().partition(|s| s.family == family);
        if rest.len() >= LEAST_BODIES {
            let without = of_one_family(law, &rest)?;
            missed.extend(out.iter().filter_map(|s| off(&without, s)));
        }
    }
    // One family shows nothing of the rest.
    let sigma = match missed.is_empty() {
        true => all.sigma,
        false => quantile(missed.into_iter(), 0.9) / NINE_IN_TEN,
    };
    Ok(Law {
        sigma: rounded(sigma),
        repeat: repeat(
            samples,
            |s| &s.id,
            |s| s.repeats.as_deref(),
            law.features().len(),
            |s, k| Some(s.features[k]),
        ),
        ..all
    })
}

/// What a law tells less the truth, in its unit.
fn off(law: &Law, s: &LawSample) -> Option<f64> {
    Some(law.estimate(&s.features)?.value - s.place?)
}

/// The families of samples, in order.
fn families<'a>(samples: &[&'a LawSample]) -> Vec<&'a str> {
    let mut all: Vec<&str> = samples.iter().map(|s| s.family.as_str()).collect();
    all.sort_unstable();
    all.dedup();
    all
}

/// The law of samples as if all the rest were like them: sigma is what they scatter by.
fn of_one_family(law: Place, own: &[&LawSample]) -> Result<Law, FitError> {
    if own.len() < LEAST_BODIES {
        return Err(FitError::Few {
            reading: law.name(),
            rows: own.len(),
            least: LEAST_BODIES,
        });
    }
    let n = law.features().len();
    let rows = DMatrix::from_fn(own.len(), n + 1, |i, j| match j < n {
        true => own[i].features[j],
        false => own[i].place.unwrap_or(f64::NAN),
    });
    let singular = || FitError::Singular(law.name());
    let normal = Normal::of(&rows).ok_or_else(singular)?;
    let normal = Normal {
        mean: normal.mean.map(rounded),
        covariance: normal.covariance.map(rounded),
    };
    let given = |s: &&LawSample| {
        let observed: Vec<(usize, f64)> = s.features.iter().copied().enumerate().collect();
        normal.given(&observed, n)
    };
    let given: Option<Vec<_>> = own.iter().map(given).collect();
    let given = given.ok_or_else(singular)?;
    let mut distances: Vec<f64> = given.iter().map(|g| g.distance).collect();
    distances.sort_by(f64::total_cmp);
    Ok(Law {
        place: law,
        sigma: rounded(given[0].variance.max(0.0).sqrt()),
        limit: rounded(distances[(distances.len() - 1) * 99 / 100]),
        repeat: None,
        normal,
    })
}

/// A family and the law that was fitted without it.
pub(crate) struct Fold<'a> {
    /// The family.
    pub family: String,
    /// Fitted without it and a tenth of the rest.
    pub law: Law,
    /// The family's bodies.
    pub out: Vec<&'a LawSample>,
}

/// Fits a law without each family in turn and a tenth of the rest.
pub(crate) fn folds(law: Place, samples: &[LawSample]) -> Result<Vec<Fold<'_>>, FitError> {
    let first: Vec<&LawSample> = samples
        .iter()
        .filter(|s| s.repeats.is_none() && s.place.is_some())
        .collect();
    let fold = |family: &str| -> Result<Fold<'_>, FitError> {
        let (out, rest): (Vec<_>, Vec<_>) = first.iter().partition(|s| s.family == family);
        let kept = rest.into_iter().filter(|s: &&LawSample| !tenth(s.row));
        Ok(Fold {
            family: family.into(),
            law: fit_law(law, &kept.collect::<Vec<_>>())?,
            out,
        })
    };
    families(&first).into_iter().map(fold).collect()
}

/// How a law does on the families that were left out.
pub(crate) fn law_held_out(folds: &[Fold<'_>]) -> Vec<HeldOut> {
    let of = |fold: &Fold<'_>| {
        let all: Vec<Miss> = fold.out.iter().filter_map(|s| miss(&fold.law, s)).collect();
        summary(&fold.family, fold.law.place.name(), &all)
    };
    folds.iter().map(of).collect()
}

/// How a law tells a body whose true place is known.
fn miss(law: &Law, s: &LawSample) -> Option<Miss> {
    let reported = law.estimate(&s.features)?;
    let off = off(law, s)?;
    let tape = |at: f64| s.tapes.as_ref()?.at(at);
    let tapes = tape(reported.value).zip(tape(s.place?));
    Some(Miss {
        mm: off * s.unit_mm,
        inside: off.abs() <= NINE_IN_TEN * reported.sigma,
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
        let mut reported = BTreeSet::new();
        let mut all = Vec::new();
        for (place, samples) in laws {
            let rest: Vec<&LawSample> = samples.iter().filter(|s| s.family != family).collect();
            let law = fit_law(*place, &rest).unwrap();
            for s in samples.iter().filter(|s| s.family == family) {
                if reported.insert(&s.id) {
                    all.extend(miss(&law, s));
                }
            }
        }
        all
    }

    #[test]
    fn upper_arms_of_families_left_out_have_intervals_that_hold() {
        let table = Table::checked_in("arms.csv");
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
