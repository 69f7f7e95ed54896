//! A body in another's pose: each segment its own rigid motion, fixed at its joint, going over smoothly into the next.

use crate::rigid::{Halves, Target, Tie, refined, rigid, samples};
use crate::segments::Segments;
use nalgebra::Isometry3;
use rayon::prelude::*;
use shape::{Adjacency, Mesh};

/// Points of a segment (structural: samples).
const MOST: usize = 1500;
/// Scales of weights for the trunk, from coarse to fine. By hand: not on record. \[mm\]
const TRUNK_SCALES_MM: [f64; 4] = [12.0, 6.0, 4.0, 3.0];
/// The same for limbs, which may be far off. By hand: not on record. \[mm\]
const LIMB_SCALES_MM: [f64; 7] = [60.0, 40.0, 25.0, 12.0, 6.0, 4.0, 3.0];
/// How strongly a joint keeps its place, as a share of all that a segment's points weigh. By hand: not on record.
const JOINT_SHARE: f64 = 0.3;
/// How wide motions go over into each other at a joint. By hand: not on record. \[mm\]
const OVER_MM: f64 = 25.0;

/// A surface in the pose of another.
#[derive(Debug, Clone)]
pub struct Posed {
    /// The same vertices and faces, moved.
    pub mesh: Mesh,
    /// How the trunk moved.
    pub trunk: Isometry3<f64>,
}

/// The first surface in the pose of the other. Of the first's points only some may be taken, to see how much hangs on them.
pub fn posed(first: &Mesh, segments: &Segments, target: &Target<'_>, halves: Halves) -> Posed {
    let whole = rigid(first, target, halves);
    let mut motions: Vec<Isometry3<f64>> = Vec::new();
    for (i, segment) in segments.all.iter().enumerate() {
        let own = samples(first, |v| segments.of[v] == i, MOST, halves);
        motions.push(match segment.hangs {
            None => refined(&own, target, whole, &[], &TRUNK_SCALES_MM),
            Some((on, joint)) => {
                let tie = Tie {
                    from: joint,
                    to: motions[on] * joint,
                    share: JOINT_SHARE,
                };
                refined(&own, target, motions[on], &[tie], &LIMB_SCALES_MM)
            }
        });
    }
    let shares = shares(first, segments);
    let moved = |(v, shares): (usize, &Vec<f32>)| {
        let at = first.point(v as u32);
        let parts = shares.iter().zip(&motions).filter(|(s, _)| **s > 0.0);
        let sum = parts.map(|(s, m)| (m * at).coords * f64::from(*s));
        sum.sum::<nalgebra::Vector3<f64>>().map(|x| x as f32).into()
    };
    Posed {
        mesh: Mesh {
            positions: shares.par_iter().enumerate().map(moved).collect(),
            ..first.clone()
        },
        trunk: motions[0],
    }
}

/// How much each vertex moves with each segment: all with its own, mixed with its neighbours' in rounds, so that over about
/// [`OVER_MM`] one motion goes over into the next.
fn shares(mesh: &Mesh, segments: &Segments) -> Vec<Vec<f32>> {
    let count = segments.all.len();
    let one = |s: &usize| {
        let mut shares = vec![0.0; count];
        shares[*s] = 1.0;
        shares
    };
    let mut shares: Vec<Vec<f32>> = segments.of.iter().map(one).collect();
    let around = Adjacency::new(mesh);
    // A random walk of n steps comes √n edges far.
    let rounds = (OVER_MM / mesh.mean_edge().max(1e-6))
        .powi(2)
        .ceil()
        .clamp(1.0, 60.0) as usize;
    for _ in 0..rounds {
        let mixed = |v: u32| {
            let beside = around.vertices(v);
            let mut sum = shares[v as usize].clone();
            for w in beside {
                sum.iter_mut()
                    .zip(&shares[*w as usize])
                    .for_each(|(s, o)| *s += o);
            }
            let by = 1.0 / (1.0 + beside.len() as f32);
            sum.iter_mut().for_each(|s| *s *= by);
            sum
        };
        shares = (0..mesh.positions.len() as u32)
            .into_par_iter()
            .map(mixed)
            .collect();
    }
    shares
}
