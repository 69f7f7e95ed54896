//! Matches that agree with one motion: the fundamental matrix by locally optimised RANSAC
//! (Chum, Matas and Kittler 2003; normalised eight-point algorithm, Hartley 1997), or the essential
//! matrix where the lens is known (Nistér 2004).

use crate::two_view::five_point::{Both, essentials};
use nalgebra::{DMatrix, Matrix3, Vector3};
use shape::Intrinsics;

/// Similarity that puts points around the origin at mean distance √2.
fn normaliser(points: &[[f64; 2]]) -> Matrix3<f64> {
    let n = points.len() as f64;
    let mean = [0, 1].map(|i| points.iter().map(|p| p[i]).sum::<f64>() / n);
    let far = points
        .iter()
        .map(|p| libm::hypot(p[0] - mean[0], p[1] - mean[1]))
        .sum::<f64>()
        / n;
    let s = std::f64::consts::SQRT_2 / far.max(1e-9);
    Matrix3::new(s, 0.0, -s * mean[0], 0.0, s, -s * mean[1], 0.0, 0.0, 1.0)
}

/// The normalisers of both sides.
fn normalisers(pairs: &[Both]) -> (Matrix3<f64>, Matrix3<f64>) {
    let side = |i: usize| pairs.iter().map(|p| p[i]).collect::<Vec<_>>();
    (normaliser(&side(0)), normaliser(&side(1)))
}

/// The fundamental matrix of at least eight pairs: `bᵀ F a = 0`.
pub fn fundamental(pairs: &[Both]) -> Option<Matrix3<f64>> {
    if pairs.len() < 8 {
        return None;
    }
    let (ta, tb) = normalisers(pairs);
    let mut rows = DMatrix::zeros(pairs.len().max(9), 9);
    for (r, [a, b]) in pairs.iter().enumerate() {
        let (a, b) = (
            ta * Vector3::new(a[0], a[1], 1.0),
            tb * Vector3::new(b[0], b[1], 1.0),
        );
        for i in 0..3 {
            for j in 0..3 {
                rows[(r, 3 * i + j)] = b[i] * a[j];
            }
        }
    }
    let normal = rows.transpose() * &rows;
    let eigen = normal.symmetric_eigen();
    let least = eigen.eigenvalues.imin();
    let f = Matrix3::from_row_slice(eigen.eigenvectors.column(least).as_slice());
    let mut svd = f.svd(true, true);
    svd.singular_values[2] = 0.0;
    Some(tb.transpose() * svd.recompose().ok()? * ta)
}

/// First-order distance of a pair from the epipolar constraint (Sampson 1982). \[px\]
pub fn sampson(f: &Matrix3<f64>, [a, b]: &Both) -> f64 {
    let (a, b) = (Vector3::new(a[0], a[1], 1.0), Vector3::new(b[0], b[1], 1.0));
    let (fa, fb) = (f * a, f.transpose() * b);
    let slope = fa.x * fa.x + fa.y * fa.y + fb.x * fb.x + fb.y * fb.y;
    b.dot(&fa).abs() / slope.sqrt().max(1e-12)
}

/// What a motion is fitted to pairs by.
struct Model<'a> {
    /// How many pairs a sample has.
    size: usize,
    /// The fundamental matrices of a sample.
    of_few: &'a dyn Fn(&[Both]) -> Vec<Matrix3<f64>>,
    /// The fundamental matrix nearest to many.
    of_many: &'a dyn Fn(&[Both]) -> Option<Matrix3<f64>>,
}

/// Which pairs agree with the motion that most agree with, within `most_px`; samples of eight.
/// Deterministic by `seed`.
pub fn agreeing(pairs: &[Both], most_px: f64, rounds: usize, seed: u64) -> Vec<bool> {
    let model = Model {
        size: 8,
        of_few: &|sample| fundamental(sample).into_iter().collect(),
        of_many: &fundamental,
    };
    within(
        pairs,
        sampled(pairs, &model, most_px, rounds, seed),
        most_px,
    )
}

/// As [`agreeing`] where the lens is known: samples of five, and only motions of rigid things.
/// Planes, which leave the fundamental matrix open, are no trouble.
pub fn agreeing_through(
    lens: &Intrinsics,
    pairs: &[Both],
    most_px: f64,
    rounds: usize,
    seed: u64,
) -> Vec<bool> {
    within(
        pairs,
        motion_through(lens, pairs, most_px, rounds, seed),
        most_px,
    )
}

/// The motion that most pairs agree with, as a fundamental matrix.
pub(crate) fn motion_through(
    lens: &Intrinsics,
    pairs: &[Both],
    most_px: f64,
    rounds: usize,
    seed: u64,
) -> Option<Matrix3<f64>> {
    let (f, [cx, cy]) = (lens.focal[0], lens.centre);
    let to_ray = Matrix3::new(1.0 / f, 0.0, -cx / f, 0.0, 1.0 / f, -cy / f, 0.0, 0.0, 1.0);
    let in_px = |e: Matrix3<f64>| to_ray.transpose() * e * to_ray;
    let rays = |pairs: &[Both]| -> Vec<Both> {
        let ray = |p: [f64; 2]| [(p[0] - cx) / f, (p[1] - cy) / f];
        pairs.iter().map(|both| both.map(ray)).collect()
    };
    let rigid = |pairs: &[Both]| {
        let mut svd = fundamental(&rays(pairs))?.svd(true, true);
        let mean = (svd.singular_values[0] + svd.singular_values[1]) / 2.0;
        svd.singular_values = Vector3::new(mean, mean, 0.0);
        Some(in_px(svd.recompose().ok()?))
    };
    let model = Model {
        size: 5,
        of_few: &|sample| essentials(&rays(sample)).into_iter().map(in_px).collect(),
        of_many: &rigid,
    };
    sampled(pairs, &model, most_px, rounds, seed)
}

/// Which pairs are within `most_px` of a motion.
fn within(pairs: &[Both], motion: Option<Matrix3<f64>>, most_px: f64) -> Vec<bool> {
    let near = |p: &Both| motion.is_some_and(|f| sampson(&f, p) < most_px);
    pairs.iter().map(near).collect()
}

/// Places below `n`, drawn by a seed (a linear congruential generator; Knuth 1997, §3.3.4).
pub(crate) fn draws(seed: u64, n: usize) -> impl FnMut() -> usize {
    let mut state = seed;
    move || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        ((state >> 33) as usize) % n
    }
}

fn sampled(
    pairs: &[Both],
    model: &Model<'_>,
    most_px: f64,
    rounds: usize,
    seed: u64,
) -> Option<Matrix3<f64>> {
    let count = |f: &Matrix3<f64>| pairs.iter().filter(|p| sampson(f, p) < most_px).count();
    let (mut best, mut most) = (None, 0);
    let mut draw = draws(seed, pairs.len());
    let mut need = rounds;
    let mut done = 0;
    while done < need.min(rounds) && pairs.len() >= 12 {
        done += 1;
        let sample: Vec<Both> = (0..model.size).map(|_| pairs[draw()]).collect();
        for f in (model.of_few)(&sample) {
            let own = count(&f);
            if own <= most {
                continue;
            }
            let (f, own) = bettered(pairs, model, most_px, f, own, &count);
            (best, most) = (Some(f), own);
            let share = (own as f64 / pairs.len() as f64)
                .powi(model.size as i32)
                .clamp(1e-9, 0.999_999);
            need = (libm::log(1e-3f64) / libm::log(1.0 - share))
                .ceil()
                .max(20.0) as usize;
        }
    }
    best
}

/// Local optimisation: fits to all that agree, with a narrowing bound.
fn bettered(
    pairs: &[Both],
    model: &Model<'_>,
    most_px: f64,
    mut f: Matrix3<f64>,
    mut own: usize,
    count: &dyn Fn(&Matrix3<f64>) -> usize,
) -> (Matrix3<f64>, usize) {
    for widen in [3.0, 2.0, 1.0, 1.0] {
        let inside: Vec<Both> = pairs
            .iter()
            .filter(|p| sampson(&f, p) < most_px * widen)
            .copied()
            .collect();
        match (model.of_many)(&inside) {
            Some(better) if count(&better) >= own => {
                own = count(&better);
                f = better;
            }
            _ => {}
        }
    }
    (f, own)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two hundred pairs of a turned scene, every second wrong; `flat` for points of one plane.
    fn pairs(flat: bool) -> Vec<Both> {
        let mut dice = proof::Dice(9);
        let turn = nalgebra::Rotation3::from_euler_angles(0.02, 0.3, -0.01);
        let mut pairs = Vec::new();
        for i in 0..200 {
            let (x, y) = (dice.within(-1.0, 1.0), dice.within(-1.0, 1.0));
            let z = dice.within(4.0, 6.0);
            let x = Vector3::new(x, y, if flat { 5.0 + 0.3 * x - 0.8 * y } else { z });
            let y = turn * x + Vector3::new(-1.5, 0.1, 0.4);
            let mut px = |v: Vector3<f64>| {
                [
                    1000.0 * v.x / v.z + 0.2 * dice.normal(),
                    1000.0 * v.y / v.z + 0.2 * dice.normal(),
                ]
            };
            let (a, b) = (px(x), px(y));
            let mut wrong = || dice.within(-300.0, 300.0);
            pairs.push(if i % 2 == 0 {
                [a, b]
            } else {
                [a, [b[0] + wrong(), b[1] + wrong()]]
            });
        }
        pairs
    }

    fn lens() -> Intrinsics {
        let mut lens = Intrinsics::simple(2000, 2000, 1000.0);
        lens.centre = [0.0, 0.0];
        lens
    }

    #[test]
    fn half_of_the_pairs_may_be_wrong() {
        let pairs = pairs(false);
        for kept in [
            agreeing(&pairs, 1.5, 5000, 1),
            agreeing_through(&lens(), &pairs, 1.5, 5000, 1),
        ] {
            let right = (0..200).step_by(2).filter(|i| kept[*i]).count();
            let wrong = (1..200).step_by(2).filter(|i| kept[*i]).count();
            assert!(right >= 95 && wrong <= 12, "{right} right, {wrong} wrong");
        }
    }

    #[test]
    fn a_plane_is_no_trouble_where_the_lens_is_known() {
        let pairs = pairs(true);
        let kept = agreeing_through(&lens(), &pairs, 1.5, 5000, 1);
        let right = (0..200).step_by(2).filter(|i| kept[*i]).count();
        let wrong = (1..200).step_by(2).filter(|i| kept[*i]).count();
        assert!(right >= 95 && wrong <= 12, "{right} right, {wrong} wrong");
    }
}
