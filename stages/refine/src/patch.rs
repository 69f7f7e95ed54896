//! A patch of the surface, carried into the pictures that see it, and how well they agree there.
//!
//! The paper carries a patch of `I_j` onto the surface and from there into `I_i` (eq. 1). Here the
//! patch lives on the surface: each picture is read at the same points of it, which is the same
//! dual projection without preferring one picture's grid. The patch is not flat but bends as the
//! surface does, by its shape operator: a flat one would pull a limb inward.

use crate::look::{LANES, Look, dot};
use crate::picture::Picture;
use nalgebra::{Point3, Vector3};

/// Most pictures that are compared at a vertex.
pub const MOST_SIGHTS: usize = 10;

/// The points of a patch, in units of its spacing, and their weights, which sum to 1. Filled up to
/// whole lanes by points in the middle of no weight.
pub struct Window {
    /// Points from the middle to a side.
    pub half: usize,
    /// Columns.
    pub across: Vec<f32>,
    /// Rows.
    pub down: Vec<f32>,
    /// A Gaussian, so that the patch has no edge.
    pub weights: Vec<f32>,
    /// Its square root.
    pub roots: Vec<f32>,
    /// Weighted mean square of a coordinate.
    pub spread: f32,
    /// Whether a linear change of brightness across the patch is taken out, like its mean: light
    /// that falls on a turning body shades it anew in each photo, and shade is nearly linear.
    pub level: bool,
}

impl Window {
    /// `2 half + 1` points a side, at most 11.
    pub fn new(half: usize, level: bool) -> Self {
        let half = half.clamp(1, 5);
        let side = 2 * half + 1;
        let count = (side * side).next_multiple_of(LANES);
        let sigma = half as f32 * 0.7;
        let at = |k: usize| k as f32 - half as f32;
        let (mut across, mut down) = (vec![0.0; count], vec![0.0; count]);
        let mut weights = vec![0.0; count];
        for k in 0..side * side {
            let (u, v) = (at(k % side), at(k / side));
            (across[k], down[k]) = (u, v);
            weights[k] = (-(u * u + v * v) / (2.0 * sigma * sigma)).exp();
        }
        let total: f32 = weights.iter().sum();
        weights.iter_mut().for_each(|w| *w /= total);
        let squares = across.iter().zip(&weights).map(|(u, w)| w * u * u);
        Window {
            half,
            spread: squares.sum(),
            roots: weights.iter().map(|w| w.sqrt()).collect(),
            across,
            down,
            weights,
            level,
        }
    }

    /// Points, those of no weight included: a multiple of [`LANES`].
    #[inline]
    pub fn len(&self) -> usize {
        self.weights.len()
    }

    /// Never.
    pub fn is_empty(&self) -> bool {
        self.weights.is_empty()
    }
}

/// Where a patch lies and how it bends. Held while the vertex moves along the normal.
#[derive(Debug, Clone, Copy)]
pub struct Frame {
    /// The vertex. \[mm\]
    pub x: Point3<f64>,
    /// Its unit normal.
    pub normal: Vector3<f64>,
    /// Two tangents, right-handed with the normal.
    pub tangents: [Vector3<f64>; 2],
    /// The shape operator in the tangents: height is `−½(l u² + 2 m u v + n v²)`. \[1/mm\]
    pub shape: [f64; 3],
    /// Distance of the patch's points. \[mm\]
    pub spacing: f64,
}

/// One picture that sees a vertex.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sight {
    /// Which.
    pub picture: u16,
    /// How much it counts.
    pub weight: f32,
    /// Unit vector towards the camera.
    pub toward: [f32; 3],
}

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

/// Which pairs are compared.
#[derive(Debug, Clone, Copy)]
pub struct Pairing {
    /// Least and greatest cosine of the angle between two lines of sight.
    pub cosine: [f32; 2],
}

impl Pairing {
    /// Every two.
    pub const ALL: Self = Pairing {
        cosine: [-1.0, 1.0],
    };

    /// Those whose lines of sight stand between two angles apart. \[°\]
    pub fn between(from_deg: f64, to_deg: f64) -> Self {
        Pairing {
            cosine: [to_deg, from_deg].map(|d| d.to_radians().cos() as f32),
        }
    }

    /// Whether two pictures are compared.
    #[inline]
    pub fn takes(&self, a: &Sight, b: &Sight) -> bool {
        let cosine: f32 = (0..3).map(|i| a.toward[i] * b.toward[i]).sum();
        cosine >= self.cosine[0] && cosine <= self.cosine[1]
    }
}

/// Compares all pairs of sights at a vertex moved outward by `offset` mm. With `SLOPE` the
/// derivative and the stiffness too: exact for this very score, weights, frame and sights held.
pub fn agreement<const SLOPE: bool>(
    pictures: &[Picture],
    sights: &[Sight],
    frame: &Frame,
    offset: f64,
    window: &Window,
    pairing: Pairing,
) -> Agreement {
    let mut looks = [Look::EMPTY; MOST_SIGHTS];
    let mut seen = [false; MOST_SIGHTS];
    for (i, sight) in sights.iter().enumerate().take(MOST_SIGHTS) {
        let picture = &pictures[sight.picture as usize];
        seen[i] = looks[i].read::<SLOPE>(picture, frame, offset, &frame.normal, window);
    }
    let mut sum = Agreement::default();
    let count = window.len();
    for i in 0..sights.len().min(MOST_SIGHTS) {
        for j in i + 1..sights.len().min(MOST_SIGHTS) {
            if !pairing.takes(&sights[i], &sights[j]) {
                continue;
            }
            let w = f64::from(sights[i].weight * sights[j].weight);
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
