//! One round of the optimization: who sees what is looked at anew, then steps are taken while the energy falls.

use crate::evidence::agreement::Agreement;
use crate::evidence::contours::Pull;
use crate::evidence::patch::Pairing;
use crate::evidence::scene::VisibilityRules;
use crate::geometry::curvature::Laplacian;
use crate::geometry::remesh::relax;
use crate::mend::crossing::part;
use crate::pictures::picture::Picture;
use crate::pictures::prepare::RefineError;
use crate::surface::energy::Forces;
use crate::surface::params::{Flow, OptimizeSurfaceParams};
use crate::surface::sight::{Looker, Sight};
use crate::surface::smooth::ring_median;
use crate::surface::step::{DataTerm, Rest, displacements};
use crate::surface::sweep::Search;
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};
use shape::{Adjacency, Mesh};

/// What a round found.
#[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
pub(crate) struct RoundStats {
    /// Consistency of what came in.
    pub before: f64,
    /// Consistency before the last step.
    pub consistency: f64,
    /// Share of the surface that two photos see.
    pub seen: f64,
    /// Distance of the contours from the silhouettes, root of the mean square. \[px\]
    pub gap_px: f64,
}

/// Looks anew, then steps while the energy falls. Where there is a `search`, it comes first.
pub(crate) fn one_round(
    p: &OptimizeSurfaceParams,
    mesh: &mut Mesh,
    pictures: &[Picture],
    footprint: f64,
    mut search: Option<&mut Search>,
) -> Result<RoundStats, RefineError> {
    let window = p.patches.window();
    let pairing = Pairing::between(p.pair_from_deg, p.pair_to_deg);
    let rules = VisibilityRules::new(p.patches.tilt_deg, pairing, p.noise_gain);
    let around = Adjacency::new(mesh);
    let start = mesh.positions.clone();
    let looker = Looker {
        p,
        around: &around,
        pictures,
        window: &window,
        rules: &rules,
        footprint,
    };
    let mut stats = RoundStats::default();
    let mut sight: Option<Sight> = None;
    let searches = usize::from(search.is_some());
    for step in 0..p.steps as usize + searches {
        let before = sight.take();
        let now = sight.insert(looker.look(mesh, before));
        stats.seen = now.visible.share();
        if stats.seen == 0.0 {
            return Err(RefineError::Unseen);
        }
        stats.consistency = consistency(&now.seen);
        if step == 0 {
            stats.before = stats.consistency;
        }
        stats.gap_px = gap(&now.pulls) / footprint;
        let Some(d) = one_step(&looker, mesh, now, search.take()) else {
            break;
        };
        step_along(mesh, &now.x, &now.normals, &d);
        relax(mesh, &around);
    }
    part(mesh, &start, &around);
    Ok(stats)
}

/// How far each vertex goes along its normal; [`None`] where no step lowers the energy. \[mm\]
fn one_step(
    looker: &Looker<'_>,
    mesh: &Mesh,
    now: &Sight,
    search: Option<&mut Search>,
) -> Option<Vec<f64>> {
    let (p, footprint) = (looker.p, looker.footprint);
    let laplacian = Laplacian::new(mesh, looker.around);
    let bending = bending_weight(p.smooth_px, footprint);
    let rest = Rest::new(&laplacian, &now.x, &now.normals, p.rest_rings as usize);
    let forces = Forces {
        rest: &rest,
        pictures: looker.pictures,
        visible: &now.visible,
        rules: looker.rules,
        window: looker.window,
        pulls: &now.pulls,
        outside: &now.outside,
        laplacian: &laplacian,
        footprint,
        contour_weight: p.contour_weight,
        hull_weight: p.hull_weight,
        bending,
        anchor: 1e-4,
    };
    let solved = |data_term: &DataTerm, most: f64| -> Vec<f64> {
        let (x, normals) = (&now.x, &now.normals);
        let d = displacements(data_term, &laplacian, x, normals, &rest, bending, 60);
        let most = most * footprint;
        d.iter().map(|d| d.clamp(-most, most)).collect()
    };
    if let Some(search) = search {
        let mut data_term = forces.data_term(&now.seen);
        search.follow(&forces, looker.around, p.reach_px, now, &mut data_term);
        return Some(solved(&data_term, p.reach_px));
    }
    let d = solved(
        &sloped(p, &forces, looker.around, &now.seen, mesh, &now.normals),
        3.0,
    );
    let share = forces.falls(&now.x, &d, &now.seen, (&now.off, looker.near()));
    (share > 0.0).then(|| d.iter().map(|d| d * share).collect())
}

/// Weight of the bending term: a typical pair-stiffness of 0.04 a pixel² balances it at the length asked
/// for. \[mm²\]
fn bending_weight(smooth_px: f64, footprint: f64) -> f64 {
    0.04 * smooth_px.powi(4) * footprint.powi(2)
}

/// What photos ask of the vertices by the slope of their agreement, smoothed where the flow is one of medians.
fn sloped(
    p: &OptimizeSurfaceParams,
    forces: &Forces<'_>,
    around: &Adjacency,
    seen: &[Agreement],
    mesh: &Mesh,
    normals: &[Vector3<f64>],
) -> DataTerm {
    let mut data_term = forces.data_term(seen);
    if p.flow == Flow::WeightedMedian {
        ring_median(
            mesh,
            around,
            forces.laplacian,
            normals,
            &mut data_term,
            (p.eta, p.kappa),
            forces.footprint,
        );
    }
    data_term
}

/// Moves the vertices along their normals by `d`. \[mm\]
fn step_along(mesh: &mut Mesh, x: &[Vector3<f64>], normals: &[Vector3<f64>], d: &[f64]) {
    for (v, d) in d.iter().enumerate() {
        let to = x[v] + normals[v] * *d;
        mesh.positions[v] = [to.x as f32, to.y as f32, to.z as f32];
    }
}

/// Mean agreement of the photos over the surface.
fn consistency(seen: &[Agreement]) -> f64 {
    let sum = |s: (f64, f64), a: &Agreement| (s.0 + a.score, s.1 + a.weight);
    let (score, weight) = seen.iter().fold((0.0, 0.0), sum);
    score / f64::max(weight, 1e-9)
}

/// Distance of the occluding contours from the silhouettes, root of the mean square. \[mm\]
fn gap(pulls: &[Pull]) -> f64 {
    let gaps: f64 = pulls.iter().map(|p| p.weight * p.gap * p.gap).sum();
    let weight: f64 = pulls.iter().map(|p| p.weight).sum();
    (gaps / weight.max(1e-9)).sqrt()
}
