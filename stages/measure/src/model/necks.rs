//! Necks of made bodies, and how the neck's level does on those that no fit has seen.

use super::held_out::{HeldOut, Miss, summary};
use super::larynx::larynx;
use super::law_fit::Fold;
use super::table::{Table, TableError};
use super::tapes::Tapes;
use shape::NINE_IN_TEN;

/// One row of `models/tables/neck.csv`; lengths are shares of the neck's diameter.
#[derive(Debug, Clone)]
pub(crate) struct Neck {
    /// The true larynx above the tightest section, along the neck's axis.
    pub larynx: Option<f64>,
    /// The angle of the throat that shows, in the same way.
    angle: Option<f64>,
    /// The neck's diameter. \[mm\]
    unit_mm: f64,
    /// Tapes square to the axis.
    pub tapes: Tapes,
}

/// Where the tapes begin, and their step (structural: samples).
const TAPES: (f64, f64) = (-0.6, 0.05);

/// All rows.
pub(crate) fn necks(table: &Table) -> Result<Vec<Neck>, TableError> {
    let (truth, angle) = (table.optional("larynx")?, table.optional("f.angle")?);
    let unit = table.numbers("unit_mm")?;
    let tapes = table.starting_with("t")?;
    let one = |i: usize| Neck {
        larynx: truth[i],
        angle: angle[i],
        unit_mm: unit[i],
        tapes: Tapes {
            from: TAPES.0,
            step: TAPES.1,
            all: tapes.iter().map(|t| t[i]).collect(),
        },
    };
    Ok((0..table.len()).map(one).collect())
}

/// Each family by a notch that was fitted without it.
pub(crate) fn larynx_held_out(folds: &[Fold<'_>], necks: &[Neck]) -> Vec<HeldOut> {
    let miss = |fold: &Fold<'_>, row: usize| -> Option<Miss> {
        let (neck, sample) = (&necks[row], fold.out.iter().find(|s| s.row == row)?);
        let reported = larynx(fold.law.estimate(&sample.features)?, neck.angle?);
        let off = reported.value - neck.larynx?;
        let tapes = neck
            .tapes
            .at(reported.value)
            .zip(neck.tapes.at(neck.larynx?));
        Some(Miss {
            mm: off * neck.unit_mm,
            inside: off.abs() <= NINE_IN_TEN * reported.sigma,
            tape: tapes.map(|(got, want)| got / want - 1.0),
        })
    };
    let of = |fold: &Fold<'_>| {
        let rows = fold.out.iter().map(|s| s.row);
        let all: Vec<Miss> = rows.filter_map(|row| miss(fold, row)).collect();
        summary(&fold.family, "larynx", &all)
    };
    folds.iter().map(of).collect()
}
