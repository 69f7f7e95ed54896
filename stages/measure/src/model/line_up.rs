//! How readings follow from the measures of a survey, estimated by made bodies: r = A v + c + e.

use super::fit_error::FitError;
use super::normal::Normal;
use super::samples::{ANATOMY, Made, Person};
use crate::features::readings::Reading;
use nalgebra::{DMatrix, DVector};

/// How many readings there are.
pub(crate) const READINGS: usize = Reading::ALL.len();

/// The measures that a reading is lined up with.
fn basis(reading: Reading) -> &'static [&'static str] {
    match reading {
        Reading::LnStature => &["ln_stature"],
        Reading::Buttock => &["buttock"],
        Reading::Neck => &["cervicale"],
        Reading::NeckTape => &["neck_girth"],
        Reading::HipTape => &["hip_girth"],
        Reading::BellyTape => &[
            "navel_girth",
            "hip_girth",
            "chest_girth",
            "navel",
            "buttock",
        ],
        Reading::WaistTape => &["navel_girth", "chest_girth", "hip_girth", "navel", "chest"],
        Reading::ChestDepth => &["chest_girth", "navel_girth", "hip_girth"],
        Reading::Bust => &["chest", "cervicale"],
        Reading::Apex => &["chest"],
    }
}

/// How readings follow from measures: r = A v + c + e.
#[derive(Debug, Clone)]
pub(crate) struct LineUp {
    pub slope: DMatrix<f64>,
    pub offset: DVector<f64>,
    /// Covariance of e.
    pub error: DMatrix<f64>,
}

/// Measures whose place on made bodies is a picked vertex or a joint, not a palpated mark.
const PICKED: [&str; 1] = ["cervicale"];
/// Measures that mean the same on made bodies as in the survey.
const SHARED: [&str; 3] = ["ln_stature", "crotch", "buttock"];
/// What a made body's average build may differ from people's in picked measures, as a share of stature: 8 mm at 1700
/// mm. By hand: not on record.
const BUILD_SIGMA: f64 = 0.0047;

fn index(measure: &str) -> usize {
    ANATOMY
        .iter()
        .position(|a| *a == measure)
        .expect("bug: no such measure")
}

/// By how much picked measures of made bodies are above people's of the same stature, crotch and
/// buttocks, in the mean, as shares of stature.
pub(crate) fn picked_bias(people: &[&Person], made: &[&Made]) -> Option<Vec<(usize, f64)>> {
    let rows = DMatrix::from_fn(people.len(), ANATOMY.len(), |i, j| people[i].anatomy[j]);
    let survey = Normal::of(&rows)?;
    let bias = |k: usize| -> Option<f64> {
        let off = |m: &&Made| -> Option<f64> {
            let seen: Option<Vec<(usize, f64)>> = SHARED
                .iter()
                .map(|s| Some((index(s), m.anatomy[index(s)]?)))
                .collect();
            Some(m.anatomy[k]? - survey.given(&seen?, k)?.mean)
        };
        let all: Vec<f64> = made.iter().filter_map(off).collect();
        (!all.is_empty()).then(|| rounded(all.iter().sum::<f64>() / all.len() as f64))
    };
    PICKED
        .iter()
        .map(|p| Some((index(p), bias(index(p))?)))
        .collect()
}

/// Whether a made body could be one of the people, by the measures that mean the same on both.
fn like_people(body: &Made, populations: &[Normal]) -> bool {
    let shared = ANATOMY
        .iter()
        .enumerate()
        .filter(|(_, a)| !PICKED.contains(a));
    let seen: Option<Vec<(usize, f64)>> =
        shared.map(|(k, _)| Some((k, body.anatomy[k]?))).collect();
    let Some(seen) = seen else { return false };
    let far = |p: &Normal| p.given(&seen, index(PICKED[0])).map(|g| g.distance);
    let nearest = populations.iter().filter_map(far).reduce(f64::min);
    nearest.is_some_and(|d| d <= chi_square_99(seen.len()))
}

/// Bodies that show a reading, at least, to line it up (structural: a count of samples; what fewer show is noise).
pub(crate) const LEAST_BODIES: usize = 30;
/// Least standard deviation of a reading, as a share of stature: half a millimetre at 1700 mm (derived: a survey's
/// numbers are whole millimetres).
pub(crate) const GRAIN_SIGMA: f64 = 0.0003;

/// Lines readings up with measures on made bodies, by least squares.
pub(crate) fn line_up(made: &[&Made], bias: &[(usize, f64)]) -> Result<LineUp, FitError> {
    let of = |k: usize| bias.iter().find(|b| b.0 == k).map_or(0.0, |b| b.1);
    let mut slope = DMatrix::zeros(READINGS, ANATOMY.len());
    let mut offset = DVector::zeros(READINGS);
    let mut residuals: Vec<Vec<Option<f64>>> = Vec::new();
    let mut unknown = Vec::new();
    for (k, reading) in Reading::ALL.into_iter().enumerate() {
        let name = reading.name();
        let at: Vec<usize> = basis(reading)
            .iter()
            .filter_map(|b| ANATOMY.iter().position(|a| a == b))
            .collect();
        let row = |m: &Made| -> Option<(Vec<f64>, f64)> {
            let mut row: Vec<f64> = at
                .iter()
                .map(|a| Some(m.anatomy[*a]? - of(*a)))
                .collect::<Option<_>>()?;
            row.push(1.0);
            Some((row, m.readings.get(reading)?))
        };
        let rows: Vec<(Vec<f64>, f64)> = made.iter().filter_map(|m| row(m)).collect();
        // What too few bodies show is noise.
        if rows.len() < LEAST_BODIES {
            unknown.push(k);
            residuals.push(vec![None; made.len()]);
            continue;
        }
        let law = least_squares(&rows).ok_or(FitError::Singular(name))?;
        for (j, a) in at.iter().enumerate() {
            slope[(k, *a)] = law[j];
        }
        offset[k] = law[at.len()];
        let off = |(row, y): (Vec<f64>, f64)| {
            y - row.iter().zip(law.iter()).map(|(x, b)| x * b).sum::<f64>()
        };
        residuals.push(made.iter().map(|m| row(m).map(off)).collect());
    }
    let mut error = pairwise(&residuals);
    for i in 0..READINGS {
        for j in 0..READINGS {
            let build = bias.iter().map(|(k, _)| slope[(i, *k)] * slope[(j, *k)]);
            error[(i, j)] += build.sum::<f64>() * BUILD_SIGMA * BUILD_SIGMA;
        }
        error[(i, i)] += GRAIN_SIGMA * GRAIN_SIGMA;
    }
    for k in unknown {
        error[(k, k)] = 1.0;
    }
    Ok(LineUp {
        slope,
        offset,
        error,
    })
}

impl LineUp {
    /// The readings of a body of some measures, as they come out on average.
    #[cfg(test)]
    pub(crate) fn mean(&self, anatomy: &[f64]) -> DVector<f64> {
        &self.slope * DVector::from_row_slice(anatomy) + &self.offset
    }

    /// A triangle that turns independent errors of variance one into those of readings.
    #[cfg(test)]
    pub(crate) fn scatter(&self) -> DMatrix<f64> {
        self.error
            .clone()
            .cholesky()
            .expect("positive definite")
            .l()
    }
}

/// Least squares by the normal equations, columns scaled to unit length.
fn least_squares(rows: &[(Vec<f64>, f64)]) -> Option<DVector<f64>> {
    let width = rows.first()?.0.len();
    let design = DMatrix::from_fn(rows.len(), width, |i, j| rows[i].0[j]);
    let want = DVector::from_iterator(rows.len(), rows.iter().map(|r| r.1));
    let scale = DVector::from_fn(width, |j, _| design.column(j).norm().max(1e-12));
    let design = DMatrix::from_fn(rows.len(), width, |i, j| design[(i, j)] / scale[j]);
    let normal = design.transpose() * &design;
    let law = normal.cholesky()?.solve(&(design.transpose() * want));
    let law = DVector::from_fn(width, |j, _| law[j] / scale[j]);
    law.iter().all(|b| b.is_finite()).then_some(law)
}

/// Second moments about zero of columns with gaps, each pair over the rows that have both, made
/// positive semidefinite.
pub(crate) fn pairwise(columns: &[Vec<Option<f64>>]) -> DMatrix<f64> {
    let n = columns.len();
    let moment = |i: usize, j: usize| {
        let both = columns[i].iter().zip(&columns[j]);
        let products: Vec<f64> = both.filter_map(|(a, b)| Some((*a)? * (*b)?)).collect();
        products.iter().sum::<f64>() / products.len().max(1) as f64
    };
    semidefinite(&DMatrix::from_fn(n, n, |i, j| moment(i.max(j), i.min(j))))
}

/// The nearest matrix without negative eigenvalues, of the same variances.
fn semidefinite(matrix: &DMatrix<f64>) -> DMatrix<f64> {
    let n = matrix.nrows();
    let sigma = DVector::from_fn(n, |i, _| matrix[(i, i)].max(1e-18).sqrt());
    let correlation = DMatrix::from_fn(n, n, |i, j| matrix[(i, j)] / (sigma[i] * sigma[j]));
    let mut eigen = correlation.symmetric_eigen();
    eigen.eigenvalues.apply(|l| *l = l.max(1e-6));
    let sound = eigen.recompose();
    let unit = DVector::from_fn(n, |i, _| sound[(i, i)].sqrt());
    DMatrix::from_fn(n, n, |i, j| {
        sigma[i] * sigma[j] * (sound[(i, j)] + sound[(j, i)]) / (2.0 * unit[i] * unit[j])
    })
}

/// Grown made bodies that could be some of the people: what readings are lined up on.
pub(crate) fn like<'a>(people: &[&Person], made: &[&'a Made]) -> Vec<&'a Made> {
    let of = |woman: bool| {
        let own: Vec<&&Person> = people.iter().filter(|p| p.woman == woman).collect();
        Normal::of(&DMatrix::from_fn(own.len(), ANATOMY.len(), |i, j| {
            own[i].anatomy[j]
        }))
    };
    let populations: Vec<Normal> = [true, false].into_iter().filter_map(of).collect();
    let grown = made.iter().copied().filter(|m| m.grown && m.fitted());
    grown.filter(|m| like_people(m, &populations)).collect()
}

/// To nine digits, so that machines whose last bit differs write the same file.
pub(crate) fn rounded(x: f64) -> f64 {
    format!("{x:.8e}")
        .parse()
        .expect("bug: a number that was just written")
}

/// Covariance of what is read between two captures of one body: half of what their differences scatter.
/// `repeats` names the body that one is another capture of, `read` gives each of so many columns. `None`
/// with fewer than [`LEAST_BODIES`] pairs.
pub(crate) fn repeat<T>(
    all: &[&T],
    id: impl Fn(&T) -> &str,
    repeats: impl Fn(&T) -> Option<&str>,
    columns: usize,
    read: impl Fn(&T, usize) -> Option<f64>,
) -> Option<DMatrix<f64>> {
    let first = |name: &str| all.iter().copied().find(|o| id(o) == name);
    let pairs: Vec<(&T, &T)> = all
        .iter()
        .filter_map(|again| Some((first(repeats(again)?)?, *again)))
        .collect();
    if pairs.len() < LEAST_BODIES {
        return None;
    }
    let half = |k: usize| -> Vec<Option<f64>> {
        let off = |(a, b): &(&T, &T)| Some((read(a, k)? - read(b, k)?) / 2f64.sqrt());
        pairs.iter().map(off).collect()
    };
    let columns: Vec<Vec<Option<f64>>> = (0..columns).map(half).collect();
    Some(pairwise(&columns).map(rounded))
}

/// The value below which 99 in 100 of a χ² distribution are (Wilson and Hilferty 1931), with the
/// survey's own excess: 22.0 of its people at eight measures against 20.1.
pub(crate) fn chi_square_99(degrees: usize) -> f64 {
    const EXCESS: f64 = 22.0 / 20.1;
    let k = degrees as f64;
    let third = 2.0 / (9.0 * k);
    rounded(EXCESS * k * (1.0 - third + 2.326_348 * third.sqrt()).powi(3))
}
