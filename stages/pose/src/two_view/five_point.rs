//! Essential matrices of five pairs of rays (Nistér 2004: "An efficient solution to the five-point
//! relative pose problem").
//!
//! The five pairs leave E = x X + y Y + z Z + W. `det E = 0` and `2 E Eᵀ E - tr(E Eᵀ) E = 0` are ten
//! cubics in x, y, z; elimination leaves a polynomial of degree ten in z.

use nalgebra::{DMatrix, Matrix3, SMatrix, Vector3};

/// Where a point is on two photos.
pub type Both = [[f64; 2]; 2];

/// Monomials x^i y^j z^k, those that are eliminated first (Nistér 2004, §3).
const MONOMIALS: [[usize; 3]; 20] = [
    [3, 0, 0],
    [0, 3, 0],
    [2, 1, 0],
    [1, 2, 0],
    [2, 0, 1],
    [2, 0, 0],
    [0, 2, 1],
    [0, 2, 0],
    [1, 1, 1],
    [1, 1, 0],
    [1, 0, 2],
    [1, 0, 1],
    [1, 0, 0],
    [0, 1, 2],
    [0, 1, 1],
    [0, 1, 0],
    [0, 0, 3],
    [0, 0, 2],
    [0, 0, 1],
    [0, 0, 0],
];

/// A cubic in x, y, z.
type Cubic = [f64; 20];

/// The column of each monomial, by its exponents.
fn places() -> [[[usize; 4]; 4]; 4] {
    let mut places = [[[usize::MAX; 4]; 4]; 4];
    for (at, [i, j, k]) in MONOMIALS.into_iter().enumerate() {
        places[i][j][k] = at;
    }
    places
}

fn times(a: &Cubic, b: &Cubic, places: &[[[usize; 4]; 4]; 4]) -> Cubic {
    let mut product = [0.0; 20];
    for (p, a) in MONOMIALS.iter().zip(a).filter(|(_, a)| **a != 0.0) {
        for (q, b) in MONOMIALS.iter().zip(b).filter(|(_, b)| **b != 0.0) {
            product[places[p[0] + q[0]][p[1] + q[1]][p[2] + q[2]]] += a * b;
        }
    }
    product
}

fn plus(a: &mut Cubic, b: &Cubic, factor: f64) {
    a.iter_mut().zip(b).for_each(|(a, b)| *a += factor * b);
}

/// The four matrices that five pairs leave: an orthonormal basis of what they do not see.
fn left(pairs: &[Both]) -> [Matrix3<f64>; 4] {
    let mut normal = SMatrix::<f64, 9, 9>::zeros();
    for [a, b] in pairs {
        let (a, b) = ([a[0], a[1], 1.0], [b[0], b[1], 1.0]);
        let row = SMatrix::<f64, 9, 1>::from_fn(|i, _| b[i / 3] * a[i % 3]);
        normal += row * row.transpose();
    }
    let eigen = normal.symmetric_eigen();
    let mut order: [usize; 9] = std::array::from_fn(|i| i);
    order.sort_by(|a, b| eigen.eigenvalues[*a].total_cmp(&eigen.eigenvalues[*b]));
    [0, 1, 2, 3].map(|k| Matrix3::from_row_slice(eigen.eigenvectors.column(order[k]).as_slice()))
}

/// The ten cubics, a row each.
fn cubics(basis: &[Matrix3<f64>; 4]) -> SMatrix<f64, 10, 20> {
    let places = places();
    let entry = |r: usize, c: usize| {
        let mut e = [0.0; 20];
        for (at, m) in [12, 15, 18, 19].into_iter().zip(basis) {
            e[at] = m[(r, c)];
        }
        e
    };
    let e: [[Cubic; 3]; 3] = std::array::from_fn(|r| std::array::from_fn(|c| entry(r, c)));
    let product = |a: &Cubic, b: &Cubic| times(a, b, &places);
    // E Eᵀ - tr(E Eᵀ)/2.
    let mut square = [[[0.0; 20]; 3]; 3];
    for r in 0..3 {
        for c in 0..3 {
            (0..3).for_each(|k| plus(&mut square[r][c], &product(&e[r][k], &e[c][k]), 1.0));
        }
    }
    let mut trace = [0.0; 20];
    (0..3).for_each(|i| plus(&mut trace, &square[i][i], 1.0));
    (0..3).for_each(|i| plus(&mut square[i][i], &trace, -0.5));
    let mut rows = SMatrix::<f64, 10, 20>::zeros();
    for (r, squares) in square.iter().enumerate() {
        for c in 0..3 {
            let mut cubic = [0.0; 20];
            (0..3).for_each(|k| plus(&mut cubic, &product(&squares[k], &e[k][c]), 1.0));
            (0..20).for_each(|i| rows[(3 * r + c, i)] = cubic[i]);
        }
    }
    let mut det = [0.0; 20];
    for c in 0..3 {
        let (i, j) = ((c + 1) % 3, (c + 2) % 3);
        let mut minor = product(&e[1][i], &e[2][j]);
        plus(&mut minor, &product(&e[1][j], &e[2][i]), -1.0);
        plus(&mut det, &product(&e[0][c], &minor), 1.0);
    }
    (0..20).for_each(|i| rows[(9, i)] = det[i]);
    rows
}

/// The product of polynomials of one unknown, lowest first.
fn product(a: &[f64], b: &[f64]) -> Vec<f64> {
    let mut out = vec![0.0; a.len() + b.len() - 1];
    for (i, a) in a.iter().enumerate() {
        b.iter().enumerate().for_each(|(j, b)| out[i + j] += a * b);
    }
    out
}

/// Real roots, by the eigenvalues of the companion matrix.
pub(crate) fn roots(polynomial: &[f64]) -> Vec<f64> {
    let largest = polynomial.iter().fold(0.0f64, |m, c| m.max(c.abs()));
    let degree = polynomial.iter().rposition(|c| c.abs() > 1e-12 * largest);
    let Some(n) = degree.filter(|n| *n > 0 && largest.is_finite()) else {
        return vec![];
    };
    let companion = DMatrix::from_fn(n, n, |r, c| match (r, c) {
        (r, c) if c + 1 == n => -polynomial[r] / polynomial[n],
        (r, c) if r == c + 1 => 1.0,
        _ => 0.0,
    });
    let Some(schur) = nalgebra::linalg::Schur::try_new(companion, 1e-14, 500) else {
        return vec![];
    };
    let real =
        |z: &nalgebra::Complex<f64>| (z.im.abs() < 1e-7 * (1.0 + z.re.abs())).then_some(z.re);
    schur
        .complex_eigenvalues()
        .iter()
        .filter_map(real)
        .collect()
}

/// The essential matrices, at most ten, with which five pairs of rays agree: `bᵀ E a = 0`. Rays are
/// pixels from the principal point over the focal length. None for pairs that do not determine it.
pub fn essentials(pairs: &[Both]) -> Vec<Matrix3<f64>> {
    if pairs.len() < 5 {
        return vec![];
    }
    let basis = left(&pairs[..5]);
    let rows = cubics(&basis);
    let first = rows.fixed_columns::<10>(0).into_owned();
    let Some(solved) = first.lu().solve(&rows.fixed_columns::<10>(10).into_owned()) else {
        return vec![];
    };
    // Rows come as: leading monomial + solved row = 0. Three pairs of them, the second times z, leave
    // x · p + y · q + r = 0 with polynomials of z, lowest first.
    let pair = |upper: usize| {
        let (a, b) = (solved.row(upper), solved.row(upper + 1));
        let part = |at: usize, n: usize| {
            let high = |k: usize| a[at + n - 1 - k];
            let low = |k: usize| b[at + n - 1 - k];
            (0..=n)
                .map(|k| if k < n { high(k) } else { 0.0 } - if k > 0 { low(k - 1) } else { 0.0 })
                .collect::<Vec<f64>>()
        };
        [part(0, 3), part(3, 3), part(6, 4)]
    };
    let b = [pair(4), pair(6), pair(8)];
    let mut det = vec![0.0; 11];
    for c in 0..3 {
        let (i, j) = ((c + 1) % 3, (c + 2) % 3);
        let (one, two) = (product(&b[1][i], &b[2][j]), product(&b[1][j], &b[2][i]));
        let minor: Vec<f64> = one.iter().zip(&two).map(|(a, b)| a - b).collect();
        let term = product(&b[0][c], &minor);
        det.iter_mut().zip(term).for_each(|(d, t)| *d += t);
    }
    let solution = |z: f64| {
        let at = |p: &[f64]| p.iter().rev().fold(0.0, |sum, c| sum * z + c);
        let rows = [0, 1, 2].map(|r| Vector3::from_fn(|c, _| at(&b[r][c])));
        let crossed = [(0, 1), (1, 2), (2, 0)].map(|(i, j)| rows[i].cross(&rows[j]));
        let best = crossed
            .iter()
            .max_by(|a, b| a.norm().total_cmp(&b.norm()))?;
        let (x, y) = (best.x / best.z, best.y / best.z);
        let e = basis[0] * x + basis[1] * y + basis[2] * z + basis[3];
        let size = e.norm();
        (size.is_finite() && size > 0.0).then(|| e / size)
    };
    roots(&det).into_iter().filter_map(solution).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Rotation3;

    #[test]
    fn the_true_motion_is_among_the_solutions() {
        let mut dice = proof::Dice(11);
        for trial in 0..50 {
            let turn = Rotation3::from_euler_angles(
                dice.within(-0.3, 0.3),
                dice.within(-0.5, 0.5),
                dice.within(-0.3, 0.3),
            );
            let shift = Vector3::new(dice.normal(), dice.normal(), dice.normal());
            let pairs: Vec<Both> = (0..5)
                .map(|_| {
                    let x = Vector3::new(dice.normal(), dice.normal(), 6.0 + dice.normal());
                    let y = turn * x + shift * 0.5;
                    [[x.x / x.z, x.y / x.z], [y.x / y.z, y.y / y.z]]
                })
                .collect();
            let truth = shift.cross_matrix() * turn.matrix();
            let truth = truth / truth.norm();
            let found = essentials(&pairs);
            assert!(found.len() <= 10);
            let off = |e: &Matrix3<f64>| (e - truth).norm().min((e + truth).norm());
            let best = found.iter().map(off).fold(f64::MAX, f64::min);
            assert!(best < 1e-5, "trial {trial}: {best} of {}", found.len());
            for e in &found {
                for [a, b] in &pairs {
                    let (a, b) = (Vector3::new(a[0], a[1], 1.0), Vector3::new(b[0], b[1], 1.0));
                    proof::near(b.dot(&(e * a)), 0.0, 1e-9);
                }
                let square = e * e.transpose();
                let off = square * e * 2.0 - e * square.trace();
                assert!(off.norm() < 1e-5, "{off}");
            }
        }
    }

    #[test]
    fn five_times_the_same_pair_is_no_motion_and_no_panic() {
        assert!(essentials(&[[[0.1, 0.2], [0.3, 0.1]]; 5]).len() <= 10);
        assert!(essentials(&[[[0.1, 0.2], [0.3, 0.1]]; 4]).is_empty());
    }
}
