//! How well the pictures that see a patch agree there.

use crate::evidence::look::{Look, dot};
use crate::evidence::patch::{Frame, MOST_VIEWS, Pairing, VisibleView, Window};
use crate::pictures::picture::Picture;
use stage::machine::widest;

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

impl Agreement {
    /// What it is `far` mm farther out, by its slope and stiffness.
    #[must_use]
    pub fn ahead(&self, far: f64) -> Self {
        let score = self.score + (self.slope - 0.5 * self.stiffness * far) * far;
        Agreement {
            score: score.min(self.weight),
            slope: self.slope - self.stiffness * far,
            ..*self
        }
    }
}

/// Compares all pairs of visible at a vertex moved outward by `offset` mm. With `N = 1` the
/// derivative and the stiffness too: exact for this very score, weights, frame and visible fixed.
pub fn agreement<const N: usize>(
    pictures: &[Picture],
    visible: &[VisibleView],
    frame: &Frame,
    offset: f64,
    window: &Window,
    pairing: Pairing,
) -> Agreement {
    widest(
        #[inline(always)]
        || agreement_as_compiled::<N>(pictures, visible, frame, offset, window, pairing),
    )
}

/// The same in the registers that the caller is compiled for: what [`agreement`] is compared with.
#[inline(always)]
pub fn agreement_as_compiled<const N: usize>(
    pictures: &[Picture],
    visible: &[VisibleView],
    frame: &Frame,
    offset: f64,
    window: &Window,
    pairing: Pairing,
) -> Agreement {
    let mut looks = [Look::<N>::EMPTY; MOST_VIEWS];
    let mut seen = [false; MOST_VIEWS];
    for (i, view) in visible.iter().enumerate().take(MOST_VIEWS) {
        let picture = &pictures[view.picture as usize];
        let outward = [frame.normal; N];
        seen[i] = looks[i].read(picture, frame, offset, &outward, window);
    }
    compared(visible, &looks, &seen, window.len(), pairing)
}

/// Compares all pairs of looks, one a visible picture; of those that are not `seen` only the weights count.
#[inline(always)]
pub fn compared<const N: usize>(
    visible: &[VisibleView],
    looks: &[Look<N>],
    seen: &[bool],
    count: usize,
    pairing: Pairing,
) -> Agreement {
    let views = visible.len().min(MOST_VIEWS);
    let mut squares = [0.0f32; MOST_VIEWS];
    for (square, look) in squares.iter_mut().zip(&looks[..views]) {
        for slope in &look.slopes {
            *square = dot(&slope[..count], &slope[..count]);
        }
    }
    let mut sum = Agreement::default();
    for i in 0..views {
        for j in i + 1..views {
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
            for (sa, sb) in a.slopes.iter().zip(&b.slopes) {
                let (sa, sb) = (&sa[..count], &sb[..count]);
                let (cross, turn) = (dot(sa, &b.z[..count]), dot(&a.z[..count], sb));
                sum.slope += w * f64::from(cross + turn);
                let square = squares[i] + squares[j] - 2.0 * dot(sa, sb);
                sum.stiffness += w * f64::from(square.max(0.0));
            }
        }
    }
    sum
}
