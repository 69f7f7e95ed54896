//! Colours as a mixture of Gaussians (Rother, Kolmogorov and Blake 2004, §2.1).

use nalgebra::{Matrix3, Vector3};
use shape::MixtureRow;
use stage::machine::widest;

/// One cluster of colours.
#[derive(Debug, Clone, Copy)]
struct Cluster {
    mean: Vector3<f64>,
    inverse: Matrix3<f64>,
    /// ln(weight) - ln(norm).
    log_scale: f64,
}

/// A mixture of colours.
#[derive(Debug, Clone)]
pub struct Gmm {
    clusters: Vec<Cluster>,
}

/// Least variance of a cluster: sensor noise and rounding. By hand: looked at scene 131 with a plate, at 0.7 and 1.4 of
/// it: mean IoU +0.0000 and −0.0001. \[levels²\]
const LEAST_VARIANCE: f64 = 6.0;

/// Colours that are looked at side by side (structural: whole registers).
const LANES: usize = 8;

impl Gmm {
    /// Fits clusters to colours: seeds farthest from each other, then Lloyd's iterations, then
    /// moments. Deterministic. `None` without colours.
    pub fn fit(colors: &[[u8; 3]], clusters: usize) -> Option<Gmm> {
        let colors: Vec<Vector3<f64>> = colors.iter().map(|c| c.map(f64::from).into()).collect();
        let first = *colors.first()?;
        let mut means = vec![first];
        let mut nearest: Vec<f64> = colors.iter().map(|c| (c - first).norm_squared()).collect();
        while means.len() < clusters {
            // The colour in the middle of the far tenth: the very farthest is an outlier.
            let mut order: Vec<usize> = (0..colors.len()).collect();
            let rank = colors.len() * 19 / 20;
            order.select_nth_unstable_by(rank.min(colors.len() - 1), |a, b| {
                nearest[*a].total_cmp(&nearest[*b]).then(a.cmp(b))
            });
            let seed = colors[order[rank.min(colors.len() - 1)]];
            means.push(seed);
            for (n, c) in nearest.iter_mut().zip(&colors) {
                *n = n.min((c - seed).norm_squared());
            }
        }
        let mut of = vec![0usize; colors.len()];
        for _ in 0..8 {
            let mut sums = vec![(Vector3::zeros(), 0.0); means.len()];
            for (of, c) in of.iter_mut().zip(&colors) {
                let far = means.iter().map(|mean| (mean - c).norm_squared());
                let nearer = |best: (usize, f64), this: (usize, f64)| match this.1 < best.1 {
                    true => this,
                    false => best,
                };
                *of = far.enumerate().fold((0, f64::INFINITY), nearer).0;
                let (sum, count) = &mut sums[*of];
                *sum += c;
                *count += 1.0;
            }
            for (mean, (sum, count)) in means.iter_mut().zip(sums) {
                if count > 0.0 {
                    *mean = sum / count;
                }
            }
        }
        let clusters = means.iter().enumerate().filter_map(|(k, mean)| {
            let (mut spread, mut count) = (Matrix3::zeros(), 0.0);
            of.iter()
                .zip(&colors)
                .filter(|(o, _)| **o == k)
                .for_each(|(_, c)| {
                    spread += (c - mean) * (c - mean).transpose();
                    count += 1.0;
                });
            if count < 1.0 {
                return None;
            }
            let spread = spread / count + Matrix3::identity() * LEAST_VARIANCE;
            let norm = ((std::f64::consts::TAU).powi(3) * spread.determinant()).sqrt();
            let weight: f64 = count / colors.len() as f64;
            Some(Cluster {
                mean: *mean,
                inverse: spread.try_inverse()?,
                log_scale: libm::log(weight) - libm::log(norm),
            })
        });
        Some(Gmm {
            clusters: clusters.collect(),
        })
    }

    /// As it is stored.
    pub(crate) fn rows(&self) -> Vec<MixtureRow> {
        let row = |c: &Cluster| {
            let mut row = [c.log_scale; 13];
            row[..3].copy_from_slice(c.mean.as_slice());
            row[3..12].copy_from_slice(c.inverse.as_slice());
            row
        };
        self.clusters.iter().map(row).collect()
    }

    /// From what is stored.
    pub(crate) fn from_rows(rows: &[MixtureRow]) -> Gmm {
        let cluster = |row: &MixtureRow| Cluster {
            mean: Vector3::from_column_slice(&row[..3]),
            inverse: Matrix3::from_column_slice(&row[3..12]),
            log_scale: row[12],
        };
        Gmm {
            clusters: rows.iter().map(cluster).collect(),
        }
    }

    /// -ln of the density of a colour, by its likeliest cluster.
    pub fn cost(&self, color: [u8; 3]) -> f64 {
        self.side_by_side([color; 1])[0]
    }

    /// The same of each of some colours.
    pub(crate) fn costs(&self, colors: &[[u8; 3]]) -> Vec<f64> {
        let mut costs = vec![0.0; colors.len()];
        widest(
            #[inline(always)]
            || {
                let (whole, rest) = colors.as_chunks::<LANES>();
                let (to, last) = costs.as_chunks_mut();
                for (to, colors) in to.iter_mut().zip(whole) {
                    *to = self.side_by_side(*colors);
                }
                for (to, color) in last.iter_mut().zip(rest) {
                    *to = self.cost(*color);
                }
            },
        );
        costs
    }

    #[inline(always)]
    fn side_by_side<const N: usize>(&self, colors: [[u8; 3]; N]) -> [f64; N] {
        let mut least = [f64::MAX; N];
        for k in &self.clusters {
            for (least, color) in least.iter_mut().zip(&colors) {
                let off = [0, 1, 2].map(|c| f64::from(color[c]) - k.mean[c]);
                let row = |r: usize| {
                    let of = |c: usize| k.inverse[(r, c)] * off[c];
                    (of(0) + of(1) + of(2)) * off[r]
                };
                let cost = 0.5 * (row(0) + row(1) + row(2)) - k.log_scale;
                *least = least.min(cost);
            }
        }
        least
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_heaps_of_colours_are_distinguished() {
        let mut dice = proof::Dice(5);
        let mut around =
            |mean: [f64; 3]| mean.map(|m| (m + 6.0 * dice.normal()).clamp(0.0, 255.0) as u8);
        let colors: Vec<_> = (0..2000)
            .map(|i| {
                around(if i % 2 == 0 {
                    [200.0, 60.0, 50.0]
                } else {
                    [40.0, 90.0, 180.0]
                })
            })
            .collect();
        let gmm = Gmm::fit(&colors, 3).unwrap();
        assert!(gmm.cost([200, 60, 50]) < 13.0 && gmm.cost([40, 90, 180]) < 13.0);
        assert!(gmm.cost([120, 75, 115]) > 25.0);
        assert!(Gmm::fit(&[], 3).is_none());
    }
}
