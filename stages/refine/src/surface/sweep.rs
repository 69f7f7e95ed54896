//! Looks along each vertex' normal for the place where the pictures agree best: what a gradient
//! cannot see because another agreement lies between.

use crate::evidence::agreement::{Agreement, agreement};
use crate::surface::energy::Forces;
use crate::surface::step::DataTerm;
use rayon::prelude::*;
use shape::Adjacency;

/// For each vertex the best place along its normal \[mm\] and how sure that is (0..=1).
///
/// Scores are gathered over two rings of neighbours, so that a lone coincidence does not win; the
/// place is the top of the parabola through the best step and its neighbours.
pub fn sweep(
    forces: &Forces<'_>,
    around: &Adjacency,
    inward: usize,
    outward: usize,
    step_mm: f64,
) -> Vec<(f64, f64)> {
    let count = forces.visible.frames.len();
    let steps = inward + outward + 1;
    let mut scores: Vec<f32> = (0..count)
        .into_par_iter()
        .with_min_len(64)
        .flat_map_iter(|v| {
            let (visible, frame) = (forces.visible.of(v), &forces.visible.frames[v]);
            (0..steps).map(move |k| {
                if visible.len() < 2 {
                    return 0.0;
                }
                let offset = (k as f64 - inward as f64) * step_mm;
                let a = agreement::<0>(
                    forces.pictures,
                    visible,
                    frame,
                    offset,
                    forces.window,
                    forces.rules.pairing,
                );
                a.score as f32
            })
        })
        .collect();
    for _ in 0..2 {
        scores = (0..count)
            .into_par_iter()
            .with_min_len(256)
            .flat_map_iter(|v| {
                let ring = around.vertices(v as u32);
                let scores = &scores;
                (0..steps).map(move |k| {
                    let beside: f32 = ring.iter().map(|j| scores[*j as usize * steps + k]).sum();
                    (2.0 * scores[v * steps + k] + beside) / (2.0 + ring.len() as f32)
                })
            })
            .collect();
    }
    (0..count)
        .map(|v| {
            let row = &scores[v * steps..(v + 1) * steps];
            let best = (0..steps)
                .max_by(|a, b| row[*a].total_cmp(&row[*b]))
                .unwrap_or(inward);
            let top = f64::from(row[best]);
            if top <= 0.0 || best == 0 || best + 1 == steps {
                return (0.0, 0.0);
            }
            let (l, r) = (f64::from(row[best - 1]), f64::from(row[best + 1]));
            let shift = 0.5 * (l - r) / (l - 2.0 * top + r).min(-1e-12);
            // Sure where no place farther off comes close.
            let rival = (0..steps)
                .filter(|k| k.abs_diff(best) > 2)
                .map(|k| f64::from(row[k]))
                .fold(0.0, f64::max);
            let sure = (1.0 - rival / top).clamp(0.0, 1.0);
            let offset = (best as f64 - inward as f64 + shift.clamp(-0.5, 0.5)) * step_mm;
            (offset, sure)
        })
        .collect()
}

/// Replaces the photos' pull by one to the place that a search along the normals found.
pub fn follow(
    forces: &Forces<'_>,
    around: &Adjacency,
    reach_px: f64,
    seen: &[Agreement],
    data_term: &mut DataTerm,
) {
    let step = forces.footprint;
    let places = sweep(
        forces,
        around,
        reach_px.ceil() as usize,
        (reach_px / 2.0).ceil() as usize,
        step,
    );
    for (v, (offset, sure)) in places.iter().enumerate() {
        let photo = forces.area(v) * seen[v].slope;
        let stiff = forces.area(v) * seen[v].stiffness;
        data_term.pull[v] += stiff * sure * offset - photo;
        data_term.stiffness[v] += stiff * (sure - 1.0);
    }
}
