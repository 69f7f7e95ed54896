//! A rigid motion that lays one surface on another: points to planes, the far ones weigh little.
//!
//! Iterative closest points with the distance to the tangent plane (Chen and Medioni 1992) and weights of Geman and McClure,
//! whose scale shrinks: what is far off at the end (limbs in another pose) does not pull.

use crate::closest::Closest;
use nalgebra::{
    Isometry3, Matrix6, Point3, Rotation3, Translation3, UnitQuaternion, Vector3, Vector6,
};
use rayon::prelude::*;
use shape::Mesh;

/// Which of the points of a surface are taken.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Halves {
    /// All.
    #[default]
    Both,
    /// Every other one, from the first on.
    Even,
    /// The other points.
    Odd,
}

/// A point of the surface that moves.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Sample {
    at: Point3<f64>,
    normal: Vector3<f64>,
}

/// A point that another must come to, and how strongly, as a share of all samples.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Tie {
    pub(crate) from: Point3<f64>,
    pub(crate) to: Point3<f64>,
    pub(crate) share: f64,
}

/// A surface prepared to be laid on.
pub struct Target<'a> {
    mesh: &'a Mesh,
    tree: Closest<'a>,
}

/// Yaws from which a search begins (structural: the width of a search).
const STARTS: u32 = 24;
/// Points of a first look, and of a fit (structural: samples).
const FEW: usize = 400;
/// Points of the last fit (structural: samples).
const MOST: usize = 3000;
/// Scales of weights with which a place is looked for, from coarse to fine, each for some rounds. By hand: not on
/// record. \[mm\]
const LOOK_SCALES_MM: [f64; 4] = [80.0, 60.0, 40.0, 30.0];
/// The same of the whole body, once its place is known. By hand: not on record. \[mm\]
const WHOLE_SCALES_MM: [f64; 6] = [40.0, 20.0, 10.0, 6.0, 4.0, 3.0];
/// Rounds of a scale (structural: a search's end).
const ROUNDS: usize = 5;
/// Least cosine between normals of points that may belong together. By hand: not on record.
const LEAST_ALIKE: f64 = 0.3;

impl<'a> Target<'a> {
    /// Of a valid mesh with at least one face.
    pub fn new(mesh: &'a Mesh) -> Self {
        Target {
            mesh,
            tree: Closest::new(mesh),
        }
    }

    /// The tree over its triangles.
    pub fn tree(&self) -> &Closest<'a> {
        &self.tree
    }
}

/// Vertices that are wanted, evenly over their order, with normals.
pub(crate) fn samples(
    mesh: &Mesh,
    wanted: impl Fn(usize) -> bool,
    most: usize,
    halves: Halves,
) -> Vec<Sample> {
    let normals = mesh.normals();
    let all: Vec<usize> = (0..mesh.positions.len()).filter(|v| wanted(*v)).collect();
    let half = |i: &usize| match halves {
        Halves::Both => true,
        Halves::Even => i.is_multiple_of(2),
        Halves::Odd => !i.is_multiple_of(2),
    };
    let step = all.len().div_ceil(most).max(1);
    let taken = (0..all.len() / step).filter(half).map(|i| all[i * step]);
    taken
        .map(|v| Sample {
            at: mesh.point(v as u32),
            normal: normals[v],
        })
        .collect()
}

/// One sample against the target: where it is, the tangent's normal, how far along it, its weight, its distance.
type Pair = (Point3<f64>, Vector3<f64>, f64, f64, f64);

fn pairs(
    samples: &[Sample],
    target: &Target<'_>,
    motion: &Isometry3<f64>,
    scale: f64,
) -> Vec<Option<Pair>> {
    let pair = |s: &Sample| {
        let at = motion * s.at;
        let hit = target.tree.to(&at)?;
        let normal = target.mesh.area_vector(hit.face).try_normalize(0.0)?;
        let alike = normal.dot(&(motion * s.normal)) > LEAST_ALIKE;
        let off = normal.dot(&(hit.point - at));
        let share = 1.0 / (1.0 + (hit.distance / scale).powi(2));
        alike.then_some((at, normal, off, share * share, hit.distance))
    };
    samples.par_iter().map(pair).collect()
}

/// A step of Gauss and Newton, about the middle of the samples; `None` where nothing is near.
fn step(pairs: &[Option<Pair>], ties: &[Tie], motion: &Isometry3<f64>) -> Option<Isometry3<f64>> {
    let near: Vec<&Pair> = pairs.iter().flatten().collect();
    if near.len() < 6 {
        return None;
    }
    let middle = near.iter().map(|p| p.0.coords).sum::<Vector3<f64>>() / near.len() as f64;
    let (mut a, mut b, mut total) = (Matrix6::zeros(), Vector6::zeros(), 0.0);
    let mut add = |at: Vector3<f64>, normal: Vector3<f64>, off: f64, weight: f64| {
        let turn = at.cross(&normal);
        let row = Vector6::new(turn.x, turn.y, turn.z, normal.x, normal.y, normal.z);
        a += row * row.transpose() * weight;
        b += row * (off * weight);
    };
    for (at, normal, off, weight, _) in &near {
        add(at.coords - middle, *normal, *off, *weight);
        total += weight;
    }
    for tie in ties {
        let at = motion * tie.from;
        for axis in [Vector3::x(), Vector3::y(), Vector3::z()] {
            add(
                at.coords - middle,
                axis,
                axis.dot(&(tie.to - at)),
                tie.share * total,
            );
        }
    }
    // A cylinder does not give its turn about its own axis: it keeps what it had.
    let [turns, ways] = [0, 3].map(|i| (a[(i, i)] + a[(i + 1, i + 1)] + a[(i + 2, i + 2)]) / 3.0);
    for i in 0..6 {
        a[(i, i)] += 1e-3 * if i < 3 { turns } else { ways };
    }
    let found = a.cholesky()?.solve(&b);
    let turn = UnitQuaternion::from_scaled_axis(Vector3::new(found[0], found[1], found[2]));
    let way = Vector3::new(found[3], found[4], found[5]) + middle - turn * middle;
    Some(Isometry3::from_parts(Translation3::from(way), turn) * motion)
}

/// The motion that lays samples on the target, from a start, by scales from coarse to fine.
pub(crate) fn refined(
    samples: &[Sample],
    target: &Target<'_>,
    start: Isometry3<f64>,
    ties: &[Tie],
    scales: &[f64],
) -> Isometry3<f64> {
    let mut motion = start;
    for scale in scales {
        for _ in 0..ROUNDS {
            let pairs = pairs(samples, target, &motion, *scale);
            match step(&pairs, ties, &motion) {
                Some(next) => motion = next,
                None => return motion,
            }
        }
    }
    motion
}

/// Mean of squares of distances, none counted beyond a bound; samples without a partner count as if at it. \[mm²\]
fn cost(samples: &[Sample], target: &Target<'_>, motion: &Isometry3<f64>, bound: f64) -> f64 {
    let pairs = pairs(samples, target, motion, bound);
    let square = |p: &Option<Pair>| p.map_or(bound, |p| p.4.min(bound)).powi(2);
    pairs.iter().map(square).sum::<f64>() / samples.len().max(1) as f64
}

/// The middle of the area, at the height of the lowest point. \[mm\]
fn foot(mesh: &Mesh) -> Point3<f64> {
    let (mut sum, mut area) = (Vector3::zeros(), 0.0);
    for f in 0..mesh.faces.len() {
        let size = mesh.area_vector(f).norm();
        let [a, b, c] = mesh.triangle(f);
        sum += (a.coords + b.coords + c.coords) * (size / 3.0);
        area += size;
    }
    let middle = sum / area.max(f64::MIN_POSITIVE);
    Point3::new(middle.x, middle.y, mesh.bounds().map_or(0.0, |b| b.0.z))
}

/// The motion that lays an upright surface on another upright one, whichever way either faces: the best of searches from
/// all around, then all points. Limbs in another pose hardly pull. Both need faces.
pub fn rigid(first: &Mesh, target: &Target<'_>, halves: Halves) -> Isometry3<f64> {
    let (from, to) = (foot(first), foot(target.mesh));
    let few = samples(first, |_| true, FEW, Halves::Both);
    let start = |i: u32| {
        let yaw = std::f64::consts::TAU * f64::from(i) / f64::from(STARTS);
        let turn: UnitQuaternion<f64> = Rotation3::from_axis_angle(&Vector3::z_axis(), yaw).into();
        Isometry3::from_parts(Translation3::from(to.coords - turn * from.coords), turn)
    };
    let look = |i: u32| {
        let found = refined(&few, target, start(i), &[], &LOOK_SCALES_MM);
        (cost(&few, target, &found, LOOK_SCALES_MM[3]), found)
    };
    let all: Vec<(f64, Isometry3<f64>)> = (0..STARTS).map(look).collect();
    let best = all.into_iter().reduce(|a, b| if b.0 < a.0 { b } else { a });
    let (_, best) = best.expect("bug: nothing to begin with");
    let many = samples(first, |_| true, MOST, halves);
    refined(&many, target, best, &[], &WHOLE_SCALES_MM)
}
