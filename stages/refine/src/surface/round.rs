//! One round of the optimization: who sees what is looked at anew, then steps are taken while the energy falls.

use crate::evidence::agreement::{Agreement, compared};
use crate::evidence::contours::{Pull, pulls};
use crate::evidence::outside::outside;
use crate::evidence::patch::{MOST_VIEWS, Pairing};
use crate::evidence::visibility::{Scene, Visibility, VisibilityRules};
use crate::geometry::curvature::Laplacian;
use crate::geometry::remesh::relax;
use crate::mend::crossing::part;
use crate::pictures::picture::Picture;
use crate::pictures::prepare::RefineError;
use crate::surface::energy::Forces;
use crate::surface::params::{Flow, OptimizeSurfaceParams};
use crate::surface::smooth::ring_median;
use crate::surface::step::{DataTerm, Rest, displacements};
use crate::surface::sweep;
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

/// Looks anew, then steps while the energy falls.
pub(crate) fn one_round(
    p: &OptimizeSurfaceParams,
    mesh: &mut Mesh,
    pictures: &[Picture],
    footprint: f64,
    begin: bool,
) -> Result<RoundStats, RefineError> {
    let window = p.patches.window();
    let pairing = Pairing::between(p.pair_from_deg, p.pair_to_deg);
    let rules = VisibilityRules::new(p.patches.tilt_deg, pairing, p.noise_gain);
    let around = Adjacency::new(mesh);
    let start = mesh.positions.clone();
    let mut stats = RoundStats::default();
    let searches = usize::from(begin && p.reach_px > 0.0);
    for step in 0..p.steps as usize + searches {
        let searching = step < searches;
        let scene = Scene::new(mesh, &around, pictures, &window, &rules);
        let (visible, seen) = looked(&scene);
        stats.seen = visible.share();
        if stats.seen == 0.0 {
            return Err(RefineError::Unseen);
        }
        let pulls = pulls(&scene, 3.0);
        let Scene { normals, maps, .. } = scene;
        drop(maps);
        let outside = match p.hull_weight > 0.0 {
            true => outside(mesh, &normals, pictures, p.slack_px, footprint),
            false => vec![],
        };
        let laplacian = Laplacian::new(mesh, &around);
        let bending = bending_weight(p.smooth_px, footprint);
        let x = positions(mesh);
        let rest = Rest::new(&laplacian, &x, &normals, p.rest_rings as usize);
        let forces = Forces {
            rest: &rest,
            pictures,
            visible: &visible,
            rules: &rules,
            window: &window,
            pulls: &pulls,
            outside: &outside,
            laplacian: &laplacian,
            footprint,
            contour_weight: p.contour_weight,
            hull_weight: p.hull_weight,
            bending,
            anchor: 1e-4,
        };
        let still = vec![0.0; x.len()];
        stats.consistency = consistency(&seen);
        if step == 0 {
            stats.before = stats.consistency;
        }
        stats.gap_px = gap(&pulls) / footprint;
        let before = forces.energy(&seen, &still, &x);
        let data_term = match searching {
            true => searched(p, &forces, &around, &seen),
            false => sloped(p, &forces, &around, &seen, mesh, &normals),
        };
        let d = displacements(&data_term, &laplacian, &x, &normals, &rest, bending, 60);
        let most = if searching { p.reach_px } else { 3.0 } * footprint;
        let d: Vec<f64> = d.iter().map(|d| d.clamp(-most, most)).collect();
        let share = match searching {
            true => 1.0,
            false => forces.falls(&x, &d, before),
        };
        if share == 0.0 {
            break;
        }
        step_along(mesh, &x, &normals, &d, share);
        relax(mesh, &around);
    }
    part(mesh, &start, &around);
    Ok(stats)
}

/// Who sees whom, and how the pictures agree at each vertex, with derivatives.
fn looked(scene: &Scene<'_>) -> (Visibility, Vec<Agreement>) {
    let all = [true; MOST_VIEWS];
    Visibility::with(
        scene,
        |frame, _| [frame.normal],
        #[inline(always)]
        |_, visible, looks| {
            compared::<1>(
                visible,
                looks,
                &all,
                scene.window.len(),
                scene.rules.pairing,
            )
        },
    )
}

/// Weight of the bending term: a typical pair-stiffness of 0.04 a pixel² balances it at the length asked
/// for. \[mm²\]
fn bending_weight(smooth_px: f64, footprint: f64) -> f64 {
    0.04 * smooth_px.powi(4) * footprint.powi(2)
}

/// What photos ask of the vertices where a search along the normals finds them to agree best.
fn searched(
    p: &OptimizeSurfaceParams,
    forces: &Forces<'_>,
    around: &Adjacency,
    seen: &[Agreement],
) -> DataTerm {
    let mut data_term = forces.data_term(seen);
    sweep::follow(forces, around, p.reach_px, seen, &mut data_term);
    data_term
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

/// Moves the vertices along their normals by a share of `d`. \[mm\]
fn step_along(
    mesh: &mut Mesh,
    x: &[Vector3<f64>],
    normals: &[Vector3<f64>],
    d: &[f64],
    share: f64,
) {
    for (v, d) in d.iter().enumerate() {
        let to = x[v] + normals[v] * (d * share);
        mesh.positions[v] = [to.x as f32, to.y as f32, to.z as f32];
    }
}

/// Where the vertices are. \[mm\]
fn positions(mesh: &Mesh) -> Vec<Vector3<f64>> {
    let vertices = 0..mesh.positions.len() as u32;
    vertices.map(|v| mesh.point(v).coords).collect()
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
