//! How well the pictures that see a patch agree there.

use crate::evidence::look::{Look, dot};
use crate::evidence::patch::{Frame, MOST_VIEWS, Pairing, VisibleView, Window};
use crate::pictures::picture::Picture;

/// How well the pictures agree at a vertex (paper, eq. 1), and how that changes outward.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Agreement {
    /// Weighted sum of the correlations of all pairs, Ω of eq. 1.
    pub score: f64,
    /// Sum of the pairs' weights: the greatest score there can be.
    pub weight: f64,
    /// Derivative of the score along the normal, ψ of eq. 4. \[1/mm\]
    pub slope: f64,
    /// Its stiffness by Gauss and Newton: `Σ w |dz_i − dz_j|²`. \[1/mm²\]
    pub stiffness: f64,
}

/// Compares all pairs of visible at a vertex moved outward by `offset` mm. With `SLOPE` the
/// derivative and the stiffness too: exact for this very score, weights, frame and visible held.
pub fn agreement<const SLOPE: bool>(
    pictures: &[Picture],
    visible: &[VisibleView],
    frame: &Frame,
    offset: f64,
    window: &Window,
    pairing: Pairing,
) -> Agreement {
    let mut looks = [Look::EMPTY; MOST_VIEWS];
    let mut seen = [false; MOST_VIEWS];
    for (i, view) in visible.iter().enumerate().take(MOST_VIEWS) {
        let picture = &pictures[view.picture as usize];
        seen[i] = looks[i].read::<SLOPE>(picture, frame, offset, &frame.normal, window);
    }
    let mut sum = Agreement::default();
    let count = window.len();
    for i in 0..visible.len().min(MOST_VIEWS) {
        for j in i + 1..visible.len().min(MOST_VIEWS) {
            if !pairing.takes(&visible[i], &visible[j]) {
                continue;
            }
            let w = f64::from(visible[i].weight * visible[j].weight);
            sum.weight += w;
            if !(seen[i] && seen[j]) {
                continue;
            }
            let (a, b) = (&looks[i], &looks[j]);
            sum.score += w * f64::from(a.agrees(b, count));
            if SLOPE {
                let (sa, sb) = (&a.slope[..count], &b.slope[..count]);
                let (cross, turn) = (dot(sa, &b.z[..count]), dot(&a.z[..count], sb));
                sum.slope += w * f64::from(cross + turn);
                let square = dot(sa, sa) + dot(sb, sb) - 2.0 * dot(sa, sb);
                sum.stiffness += w * f64::from(square.max(0.0));
            }
        }
    }
    sum
}
