//! What all silhouettes together show of a point in space.

use nalgebra::Point3;
use rayon::prelude::*;
use shape::{Cylinder, Silhouette};

/// How deep inside of the hull a point is, `dissent` views not counted: their least depths. \[mm\]
/// Views that do not see the point do not count; a point that fewer than half see is outside.
pub fn consensus(views: &[Silhouette], x: &Point3<f64>, dissent: usize) -> f32 {
    // The least `dissent + 1` depths, ascending; few, so insertion is quick.
    let mut least = [f32::MAX; 16];
    let keep = (dissent + 1).min(least.len());
    let mut seen = 0;
    for view in views {
        let Some(depth) = view.depth_inside(x) else {
            continue;
        };
        seen += 1;
        if depth < least[keep - 1] {
            let at = least[..keep]
                .iter()
                .position(|l| depth < *l)
                .unwrap_or(keep - 1);
            least[at..keep].rotate_right(1);
            least[at] = depth;
        }
    }
    if seen * 2 < views.len() {
        -1e6
    } else {
        least[keep - 1]
    }
}

/// Whether a point is deeper than a margin outside of the silhouettes of more than `dissent` views. \[mm\]
fn far_outside(views: &[Silhouette], x: &Point3<f64>, dissent: usize, margin: f32) -> bool {
    let mut against = 0;
    for view in views {
        against += usize::from(view.depth_inside(x).is_some_and(|depth| depth < -margin));
        if against > dissent {
            return true;
        }
    }
    false
}

/// Steps across the cylinder in which the body is looked for (structural: samples).
const STEPS: i32 = 96;

/// A box around all of space that is body, found on a coarse lattice within a cylinder around the
/// axis (paper, Fig. 2 b), above a height. \[mm\]
pub fn bounds(
    views: &[Silhouette],
    dissent: usize,
    cylinder: &Cylinder,
    ground: f64,
) -> Option<(Point3<f64>, Point3<f64>)> {
    let reach = cylinder.radius;
    let step = 2.0 * reach / f64::from(STEPS);
    let tall = ((cylinder.top - ground) / step).ceil().max(0.0) as i32;
    let layer = |k: i32| {
        let (mut lo, mut hi) = ([f64::MAX; 3], [f64::MIN; 3]);
        for (i, j) in (0..=STEPS).flat_map(|i| (0..=STEPS).map(move |j| (i, j))) {
            let x = Point3::new(
                -reach + f64::from(i) * step,
                -reach + f64::from(j) * step,
                ground + f64::from(k) * step,
            );
            // What is within the box already moves none of its sides.
            let known = |a: usize| lo[a] <= x[a] - 2.0 * step && x[a] + 2.0 * step <= hi[a];
            if (0..3).all(known) {
                continue;
            }
            let out = libm::hypot(x.x, x.y) > reach || far_outside(views, &x, dissent, step as f32);
            if out || f64::from(consensus(views, &x, dissent)) < -step {
                continue;
            }
            for a in 0..3 {
                lo[a] = lo[a].min(x[a] - 2.0 * step);
                hi[a] = hi[a].max(x[a] + 2.0 * step);
            }
        }
        (lo, hi)
    };
    let layers: Vec<_> = (0..=tall).into_par_iter().map(layer).collect();
    let both = |a: ([f64; 3], [f64; 3]), b: ([f64; 3], [f64; 3])| {
        let low = [0, 1, 2].map(|i| a.0[i].min(b.0[i]));
        (low, [0, 1, 2].map(|i| a.1[i].max(b.1[i])))
    };
    let (lo, hi) = layers.into_iter().reduce(both)?;
    let low = lo[2].max(ground - 2.0 * step);
    (lo[0] < hi[0]).then(|| (Point3::new(lo[0], lo[1], low), Point3::from(hi)))
}
