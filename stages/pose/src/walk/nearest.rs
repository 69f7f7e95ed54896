//! Features of two photos that are each other's nearest by description, all against all.
//!
//! Likenesses are products of matrices in single precision. Descriptions are whole numbers of length
//! 512, so that no sum reaches 2²⁴ and every machine finds the same numbers in whatever order it adds.

use crate::features::best::{Best, PLACE_PX};
use crate::features::matching::Pairs;
use nalgebra::DMatrix;
use shape::Features;

/// How many features are compared at once (structural: speed alone).
const STRIDE: usize = 128;

/// Descriptions, one a column.
fn columns(features: &Features, which: &[u32]) -> DMatrix<f32> {
    let descriptions = &features.descriptors;
    DMatrix::from_fn(128, which.len(), |r, c| {
        f32::from(descriptions[which[c] as usize][r])
    })
}

/// Pairs among some features of each photo that are each other's nearest, and nearer than `ratio`
/// times the next one of `b` that is elsewhere.
pub(crate) fn nearest([a, b]: [&Features; 2], [of_a, of_b]: [&[u32]; 2], ratio: f64) -> Pairs {
    if of_a.is_empty() || of_b.is_empty() {
        return vec![];
    }
    let (left, right) = (columns(a, of_a), columns(b, of_b).transpose());
    let mut back = vec![(f32::MIN, usize::MAX); of_b.len()];
    let mut there: Vec<(usize, usize)> = Vec::new();
    let place = |j: usize| &b.points[of_b[j] as usize];
    let elsewhere = |i: usize, j: usize| {
        let (p, q) = (place(i), place(j));
        libm::hypotf(p.x - q.x, p.y - q.y) >= PLACE_PX
    };
    let mut alike = DMatrix::<f32>::zeros(of_b.len(), STRIDE);
    for from in (0..of_a.len()).step_by(STRIDE) {
        let count = STRIDE.min(of_a.len() - from);
        let mut part = alike.columns_mut(0, count);
        part.gemm(1.0, &right, &left.columns(from, count), 0.0);
        for (k, column) in part.column_iter().enumerate() {
            let i = from + k;
            let mut best = Best::default();
            for ((j, &s), back) in column.iter().enumerate().zip(&mut back) {
                if s > back.0 {
                    *back = (s, i);
                }
                best.see(j, s, &elsewhere);
            }
            if best.ahead(ratio) {
                there.push((i, best.at));
            }
        }
    }
    there.retain(|(i, j)| back[*j].1 == *i);
    let of = |(i, j): (usize, usize)| (of_a[i], of_b[j]);
    there.into_iter().map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::features::matching::mutual;
    use crate::features::matching::tests::features;

    #[test]
    fn it_finds_what_comparing_one_by_one_finds() {
        let dice = &mut proof::Dice(12);
        let (a, mut b) = (features(dice, 300), features(dice, 200));
        // Half of the first, a little changed.
        for i in 0..150 {
            let mut d = a.descriptors[i];
            (0..128).for_each(|k| d[k] = d[k].saturating_add(((i + k) % 7) as u8));
            b.descriptors.push(d);
            b.points.push(a.points[149 - i]);
        }
        let all = |f: &Features| (0..f.points.len() as u32).collect::<Vec<_>>();
        for ratio in [0.7, 0.9, 1.0] {
            let found = nearest([&a, &b], [&all(&a), &all(&b)], ratio);
            let wanted = mutual(&a, &b, ratio, 1e6, &[vec![], vec![]]);
            assert_eq!(found, wanted);
            assert!(found.len() >= 150, "{}", found.len());
        }
    }
}
