//! The normal equations of an adjustment with its points eliminated (the Schur complement; Triggs,
//! McLauchlan, Hartley and Fitzgibbon 1999, §6.1), whatever its other unknowns are.

use crate::adjust::belief::Term;
use crate::adjust::damped::weight;
use crate::adjust::places::Way;
use crate::adjust::residual::SHOT;
use nalgebra::{DMatrix, DVector, Matrix2x3, Matrix3, SMatrix, Vector2, Vector3};

/// Added to the diagonal of a point's own block, so that a point seen once has an inverse.
/// It is structural: above what doubles round.
const POINT_FLOOR: f64 = 1e-15;

/// Derivatives of a residual by unknowns that are side by side in the system.
pub(crate) struct Block {
    at: usize,
    count: usize,
    by: SMatrix<f64, 2, SHOT>,
}

impl Block {
    /// By the unknowns from `at` on.
    pub(crate) fn new<const N: usize>(at: usize, by: &SMatrix<f64, 2, N>) -> Block {
        let mut wide = SMatrix::<f64, 2, SHOT>::zeros();
        wide.fixed_columns_mut::<N>(0).copy_from(by);
        Block {
            at,
            count: N,
            by: wide,
        }
    }

    /// By unknowns that move a shot, from the derivatives by what they move.
    pub(crate) fn of_shot(way: &Way, by: &SMatrix<f64, 2, SHOT>) -> Block {
        Block {
            at: way.at,
            count: way.count,
            by: way.by(by),
        }
    }
}

/// Products of a point's and a block's derivatives, summed over its observations.
struct Coupling {
    at: usize,
    count: usize,
    w: SMatrix<f64, SHOT, 3>,
}

/// A free point: what its own step follows from.
#[derive(Default)]
pub(crate) struct Point {
    /// Its own block, or, once eliminated, the inverse of that.
    own: Matrix3<f64>,
    right: Vector3<f64>,
    /// By place.
    couplings: Vec<Coupling>,
}

impl Point {
    fn couple(&mut self, block: &Block, w: SMatrix<f64, SHOT, 3>) {
        match self.couplings.binary_search_by_key(&block.at, |c| c.at) {
            Ok(known) => self.couplings[known].w += w,
            Err(place) => self.couplings.insert(
                place,
                Coupling {
                    at: block.at,
                    count: block.count,
                    w,
                },
            ),
        }
    }
}

/// The reduced system.
pub(crate) struct Normal {
    /// Its lower half; both halves once [`Normal::complete`].
    pub(crate) matrix: DMatrix<f64>,
    pub(crate) right: DVector<f64>,
    points: Vec<Point>,
}

impl Normal {
    /// Of unknowns of which nothing is known.
    pub(crate) fn new(unknowns: usize) -> Normal {
        Normal {
            matrix: DMatrix::zeros(unknowns, unknowns),
            right: DVector::zeros(unknowns),
            points: Vec::new(),
        }
    }

    /// Adds an observation: its residual in standard deviations and the derivatives of that; those by
    /// its point where the point is free. Cauchy's loss by reweighting, `c2` the square of its c.
    pub(crate) fn observe(
        &mut self,
        residual: &Vector2<f64>,
        blocks: &[Block],
        point: Option<(&mut Point, &Matrix2x3<f64>)>,
        c2: f64,
    ) {
        let weight = weight(residual.norm_squared(), c2);
        for a in blocks {
            let step = a.by.transpose() * residual * weight;
            (0..a.count).for_each(|i| self.right[a.at + i] -= step[i]);
            for b in blocks.iter().filter(|b| b.at <= a.at) {
                let product = a.by.transpose() * b.by * weight;
                let mut view = self.matrix.view_mut((a.at, b.at), (a.count, b.count));
                view += product.view((0, 0), (a.count, b.count));
            }
        }
        if let Some((point, by_point)) = point {
            point.own += by_point.transpose() * by_point * weight;
            point.right -= by_point.transpose() * residual * weight;
            for block in blocks {
                point.couple(block, block.by.transpose() * by_point * weight);
            }
        }
    }

    /// Takes a point out: subtracts W V⁻¹ Wᵀ and W V⁻¹ g. `damping` is that of its own block.
    pub(crate) fn eliminate(&mut self, mut point: Point, damping: f64) {
        (0..3).for_each(|i| {
            let d = &mut point.own[(i, i)];
            *d = *d * (1.0 + damping) + POINT_FLOOR;
        });
        point.own = point.own.try_inverse().unwrap_or_default();
        let solved = point.own * point.right;
        for (i, a) in point.couplings.iter().enumerate() {
            let step = a.w * solved;
            (0..a.count).for_each(|k| self.right[a.at + k] -= step[k]);
            let wv = a.w * point.own;
            for b in &point.couplings[..=i] {
                let product = wv * b.w.transpose();
                let mut view = self.matrix.view_mut((a.at, b.at), (a.count, b.count));
                view -= product.view((0, 0), (a.count, b.count));
            }
        }
        self.points.push(point);
    }

    /// The sum with a part whose points come after these.
    pub(crate) fn join(mut self, part: Normal) -> Normal {
        self.matrix += part.matrix;
        self.right += part.right;
        self.points.extend(part.points);
        self
    }

    /// With its upper half.
    pub(crate) fn complete(mut self) -> Normal {
        self.matrix.fill_upper_triangle_with_lower_triangle();
        self
    }

    /// Adds what is believed.
    pub(crate) fn believe(&mut self, term: &Term) {
        for (i, a) in &term.by {
            self.right[*i] -= term.weight * term.off * a;
            for (j, b) in &term.by {
                self.matrix[(*i, *j)] += a * b * term.weight;
            }
        }
    }

    /// The step of each free point that follows from a step of the reduced unknowns.
    pub(crate) fn point_steps(&self, step: &DVector<f64>) -> Vec<Vector3<f64>> {
        let one = |point: &Point| {
            let mut right = point.right;
            for c in &point.couplings {
                let rows = c.w.rows(0, c.count);
                right -= rows.tr_mul(&step.rows(c.at, c.count));
            }
            point.own * right
        };
        self.points.iter().map(one).collect()
    }
}
