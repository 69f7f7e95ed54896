//! A patch of the surface, and which pictures are compared on it.
//!
//! The paper carries a patch of `I_j` onto the surface and from there into `I_i` (eq. 1). Here the
//! patch lives on the surface: each picture is read at the same points of it, which is the same
//! dual projection without preferring one picture's grid. The patch is not flat but bends as the
//! surface does, by its shape operator: a flat one would pull a limb inward.

use nalgebra::{Point3, Vector3};

/// Numbers that are worked on side by side (structural: speed alone).
pub const LANES: usize = 8;
/// Most points of a patch (structural: the length of arrays, whole lanes).
pub const MOST_POINTS: usize = 128;

/// Most pictures that are compared at a vertex (structural: a cap on memory and work).
pub const MOST_VIEWS: usize = 10;

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
            weights[k] = libm::expf(-(u * u + v * v) / (2.0 * sigma * sigma));
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

    /// Whether it has no points, which no window has.
    pub fn is_empty(&self) -> bool {
        self.weights.is_empty()
    }
}

/// Where a patch is and how it bends. Fixed while the vertex moves along the normal.
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
pub struct VisibleView {
    /// The picture.
    pub picture: u16,
    /// How much it counts.
    pub weight: f32,
    /// Unit vector towards the camera.
    pub toward: [f32; 3],
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

    /// Those whose lines of sight are between two angles apart. \[°\]
    pub fn between(from_deg: f64, to_deg: f64) -> Self {
        Pairing {
            cosine: [to_deg, from_deg].map(|d| libm::cos(d.to_radians()) as f32),
        }
    }

    /// Whether two pictures are compared.
    #[inline]
    pub fn takes(&self, a: &VisibleView, b: &VisibleView) -> bool {
        let cosine: f32 = (0..3).map(|i| a.toward[i] * b.toward[i]).sum();
        cosine >= self.cosine[0] && cosine <= self.cosine[1]
    }
}
