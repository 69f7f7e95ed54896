//! How the body deformed between two photos: a smooth field of offsets a photo.
//!
//! Six numbers a photo carry the body as a whole; arms that swing, a head that turns and a chest
//! that breathes are left. What is left is small and smooth, so a coarse grid over the photo holds it
//! (as in Zhou and Koltun 2014, sec. 4, there for colour). What the surface itself could explain
//! is no deformation: the share of the pulls at a vertex that its motion along the normal would still is
//! taken out first.

use crate::evidence::contours::Pull;
use crate::evidence::scene::Scene;
use crate::geometry::gradients::conjugate_gradients;
use crate::motion::normal_equations::{PointShift, VertexShifts};
use crate::pictures::picture::Picture;
use nalgebra::{Point3, Vector3};
use rayon::prelude::*;
use shape::Warp;

/// What is expected of a deformation, and how well a contour is believed.
#[derive(Debug, Clone, Copy)]
pub struct FieldPrior {
    /// Standard deviation of an offset. \[px\]
    pub shift_px: f64,
    /// Standard deviation of the difference of two neighbouring nodes. \[px\]
    pub differ_px: f64,
    /// Weight of a point of a contour against one that is known to a pixel.
    pub contour_weight: f64,
}

/// A constraint on a photo's field: what is seen at `at` should be `gap` farther along `way`.
#[derive(Debug, Clone, Copy)]
struct Constraint {
    at: [f64; 2],
    way: [f64; 2],
    gap: f64,
    stiffness: f64,
}

/// All constraints on the photos' fields, one list a picture, in pixels of the whole photos at the pictures' level.
pub struct Constraints(Vec<Vec<Constraint>>);

impl Constraints {
    /// From brightness and contours, on pictures that are undeformed as far as is known; without what the surface
    /// could explain of the shifts.
    pub fn new(
        scene: &Scene<'_>,
        mut vertices: Vec<VertexShifts>,
        contours: &[Pull],
        prior: &FieldPrior,
        footprint: f64,
    ) -> Self {
        let (mesh, pictures) = (scene.mesh, scene.pictures);
        let at_vertices = vertices.par_iter_mut().zip(&scene.normals);
        at_vertices.for_each(|(vertex, normal)| without_depth(&mut vertex.shifts, normal));
        let mut constraints = Constraints(pictures.iter().map(|_| vec![]).collect());
        for t in vertices.iter().flat_map(|v| &v.shifts) {
            constraints.add(pictures, t);
        }
        for p in contours {
            constraints.add(
                pictures,
                &PointShift {
                    picture: p.picture,
                    x: mesh.point(p.vertex),
                    direction: scene.normals[p.vertex as usize] * -p.slope,
                    gap: p.gap,
                    stiffness: p.weight * prior.contour_weight / (footprint * footprint),
                },
            );
        }
        constraints
    }

    fn add(&mut self, pictures: &[Picture], t: &PointShift) {
        let picture = &pictures[t.picture as usize];
        let Some(at) = on_whole(picture, &t.x) else {
            return;
        };
        let [x, y] = picture.jacobian(&t.x).map(|row| row.dot(&t.direction));
        let long = libm::hypot(x, y);
        if long > 0.0 {
            self.0[t.picture as usize].push(Constraint {
                at,
                way: [x / long, y / long],
                gap: t.gap * long,
                stiffness: t.stiffness / (long * long),
            });
        }
    }

    /// The fields that give in to the constraints, `now` being those that the pictures were undeformed by. All
    /// photos move at once, each to where the other photos were: only half of the way is gone.
    pub fn solve(&self, now: &[Warp], prior: &FieldPrior) -> Vec<Warp> {
        let each = self.0.par_iter().zip(now);
        each.map(|(constraints, warp)| solve(constraints, warp, prior))
            .collect()
    }
}

/// How far on fields are carried after a round, as a share of what it changed (Nesterov 1983; Beck and Teboulle 2009,
/// eq. 4.3, in its usual closed form). What photos beside each other share converges slowly without: each is compared with the
/// mean of the rest.
pub fn momentum(round: u32) -> f64 {
    f64::from(round) / f64::from(round + 3)
}

/// Fields carried on from what they were before, by a share of the change.
pub fn carried_on(now: &[Warp], before: &[Warp], share: f64) -> Vec<Warp> {
    let one = |(now, before): (&Warp, &Warp)| {
        let offsets = now.offsets.iter().zip(&before.offsets);
        let on =
            |(n, b): (&[f32; 2], &[f32; 2])| [0, 1].map(|i| n[i] + share as f32 * (n[i] - b[i]));
        Warp {
            offsets: offsets.map(on).collect(),
            ..now.clone()
        }
    };
    now.iter().zip(before).map(one).collect()
}

/// Takes the share of a vertex' pulls out that a motion of the surface along its normal explains.
fn without_depth(equations: &mut [PointShift], normal: &Vector3<f64>) {
    let (mut pull, mut stiff) = (0.0, 0.0);
    for t in equations.iter() {
        let share = normal.dot(&t.direction);
        pull += t.stiffness * share * t.gap;
        stiff += t.stiffness * share * share;
    }
    if stiff > 0.0 {
        let depth = pull / stiff;
        for t in equations {
            t.gap -= depth * normal.dot(&t.direction);
        }
    }
}

/// One photo's field: `Σ stiffness (way · o(at) − gap)² + Σ_edges |o_a − o_b|² / differ² + Σ |o|² / shift²`.
fn solve(constraints: &[Constraint], now: &Warp, prior: &FieldPrior) -> Warp {
    let nodes = now.offsets.len();
    let (columns, rows) = (now.columns, now.rows());
    let (mesh, hold) = (prior.differ_px.powi(-2), prior.shift_px.powi(-2));
    let places: Vec<_> = constraints.iter().map(|t| now.around(t.at)).collect();
    let edges = || {
        let across = (0..rows).flat_map(move |j| (1..columns).map(move |i| (j * columns + i, 1)));
        let down =
            (1..rows).flat_map(move |j| (0..columns).map(move |i| (j * columns + i, columns)));
        across.chain(down).map(|(k, back)| (k, k - back))
    };
    let mut diagonal = vec![hold; 2 * nodes];
    let mut right = vec![0.0; 2 * nodes];
    for (a, b) in edges() {
        for k in [2 * a, 2 * a + 1, 2 * b, 2 * b + 1] {
            diagonal[k] += mesh;
        }
    }
    for (constraint, place) in constraints.iter().zip(&places) {
        let so_far = now.at(constraint.at);
        let gap = constraint.gap + so_far[0] * constraint.way[0] + so_far[1] * constraint.way[1];
        for (node, share) in place {
            for k in 0..2 {
                let row = share * constraint.way[k];
                right[2 * node + k] += constraint.stiffness * row * gap;
                diagonal[2 * node + k] += constraint.stiffness * row * row;
            }
        }
    }
    let matrix = |o: &[f64]| -> Vec<f64> {
        let mut out: Vec<f64> = o.iter().map(|o| hold * o).collect();
        for (a, b) in edges() {
            for k in 0..2 {
                let apart = mesh * (o[2 * a + k] - o[2 * b + k]);
                out[2 * a + k] += apart;
                out[2 * b + k] -= apart;
            }
        }
        for (constraint, place) in constraints.iter().zip(&places) {
            let along: f64 = place
                .iter()
                .map(|(n, s)| s * (o[2 * n] * constraint.way[0] + o[2 * n + 1] * constraint.way[1]))
                .sum();
            for (node, share) in place {
                for k in 0..2 {
                    out[2 * node + k] += constraint.stiffness * along * share * constraint.way[k];
                }
            }
        }
        out
    };
    let inverse: Vec<f64> = diagonal.iter().map(|d| 1.0 / d).collect();
    let wanted = conjugate_gradients(matrix, &inverse, right, 60);
    let mut warp = now.clone();
    for (k, o) in warp.offsets.iter_mut().enumerate() {
        for i in 0..2 {
            o[i] += (0.5 * (wanted[2 * k + i] - f64::from(o[i]))) as f32;
        }
    }
    warp
}

/// Where a point is seen on the whole photo that a picture is part of. \[px\]
fn on_whole(picture: &Picture, x: &Point3<f64>) -> Option<[f64; 2]> {
    let (at, _) = picture.project(x)?;
    Some([0, 1].map(|i| at[i] + picture.corner[i] as f64))
}

/// How far a point is seen from where it would be, rms over pictures. \[px\]
pub fn seen_off(warps: &[Warp], pictures: &[Picture], x: &Point3<f64>) -> f64 {
    let off = |(w, p): (&Warp, &Picture)| {
        let at = on_whole(p, x)?;
        Some(w.at(at).iter().map(|o| o * o).sum::<f64>())
    };
    let all: Vec<f64> = warps.iter().zip(pictures).filter_map(off).collect();
    (all.iter().sum::<f64>() / all.len().max(1) as f64).sqrt()
}
