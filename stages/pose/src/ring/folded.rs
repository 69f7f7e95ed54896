//! Whether cameras that came out near each other see the same: photos of two sides of a body may else be laid on each other.

use crate::adjust::scene::PointObservation;
use crate::ring::error::TracksError;
use crate::ring::pairs::LEAST_FEATURES;
use nalgebra::{Point3, Vector3};

/// An error where more than a quarter of the pairs of cameras near each other share fewer than [`LEAST_FEATURES`]
/// features; what is missing between photos is evidence as what is there (Zach, Irschara, Bischof 2008). Near is
/// as near as half of all pairs of observations of a feature are.
///
/// `centres` are those of the observations' cameras, `middle` is the ring's.
pub(crate) fn unfolded(
    centres: &[Point3<f64>],
    middle: Point3<f64>,
    observations: &[PointObservation],
) -> Result<(), TracksError> {
    let shared = shared(centres.len(), observations);
    let from: Vec<Vector3<f64>> = centres.iter().map(|c| c - middle).collect();
    let mut pairs: Vec<(f64, usize)> = (0..from.len())
        .flat_map(|i| (0..i).map(move |j| (i, j)))
        .map(|(i, j)| (from[i].angle(&from[j]), shared[i][j]))
        .collect();
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
    let all: usize = pairs.iter().map(|(_, shared)| shared).sum();
    let mut so_far = 0;
    let near = pairs.iter().take_while(|(_, shared)| {
        let before = so_far;
        so_far += shared;
        2 * before < all
    });
    let near: Vec<&(f64, usize)> = near.collect();
    let strange = near.iter().filter(|(_, s)| *s < LEAST_FEATURES).count();
    if 4 * strange <= near.len() {
        return Ok(());
    }
    Err(TracksError::Folded {
        pairs: strange,
        of: near.len(),
        least: LEAST_FEATURES as u32,
        apart: near.last().map_or(0.0, |p| p.0.to_degrees()),
    })
}

/// How many features two cameras have in common.
fn shared(cameras: usize, observations: &[PointObservation]) -> Vec<Vec<usize>> {
    let points = observations.iter().map(|o| o.point + 1).max().unwrap_or(0);
    let mut seen: Vec<Vec<usize>> = vec![Vec::new(); points];
    observations
        .iter()
        .for_each(|o| seen[o.point].push(o.camera));
    let mut shared = vec![vec![0; cameras]; cameras];
    for cameras in &seen {
        for a in cameras {
            cameras.iter().for_each(|b| shared[*a][*b] += 1);
        }
    }
    shared
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    /// Twelve cameras on a ring, where each shares twenty features with either neighbour in turning order; `place` is where each
    /// one came out.
    fn found(place: impl Fn(usize) -> f64) -> Result<(), TracksError> {
        let centre = |i: usize| {
            let (s, c) = libm::sincos(place(i) * TAU / 12.0);
            Point3::new(c, s, 0.0)
        };
        let centres: Vec<Point3<f64>> = (0..12).map(centre).collect();
        let seen = |point: usize, camera: usize| PointObservation {
            camera,
            point,
            at_px: [0.0; 2],
            sigma_px: 1.0,
        };
        let between = |i: usize| (20 * i..20 * (i + 1)).map(move |p| (i, p));
        let all: Vec<PointObservation> = (0..12)
            .flat_map(between)
            .flat_map(|(i, p)| [seen(p, i), seen(p, (i + 1) % 12)])
            .collect();
        unfolded(&centres, Point3::origin(), &all)
    }

    #[test]
    fn a_ring_passes_and_one_whose_halves_are_laid_on_each_other_does_not() {
        assert_eq!(found(|i| i as f64).err().map(|e| e.to_string()), None);
        let folded = found(|i| (i as f64).min(12.3 - i as f64));
        assert!(matches!(folded, Err(TracksError::Folded { .. })));
    }
}
