//! The normal equations of lenses, shots and points, points eliminated (the Schur complement; Triggs,
//! McLauchlan, Hartley and Fitzgibbon 1999, §6.1).

use crate::adjust::lens::LENS;
use crate::adjust::residual::{Derivatives, derivatives};
use crate::walk::model::{Model, Spot};
use nalgebra::{DMatrix, DVector, Matrix3, Point3, SMatrix, Vector3};
use rayon::prelude::*;
use shape::Camera;

/// Unknowns of a shot: rotation, translation, zoom.
pub(crate) const SHOT: usize = 7;
/// Into how many parts points are split, whatever the number of threads.
const PARTS: usize = 8;

type ByLens = SMatrix<f64, LENS, 3>;
type ByShot = SMatrix<f64, SHOT, 3>;

/// Where unknowns stand in the system; what has no place is held.
pub(crate) struct Places {
    pub(crate) lenses: Vec<Option<usize>>,
    pub(crate) shots: Vec<Option<usize>>,
    pub(crate) count: usize,
}

impl Places {
    /// Lenses first, then shots.
    pub(crate) fn new(lenses: &[bool], shots: &[bool]) -> Places {
        let mut count = 0;
        let mut place = |free: &bool, size: usize| {
            free.then(|| {
                count += size;
                count - size
            })
        };
        Places {
            lenses: lenses.iter().map(|f| place(f, LENS)).collect(),
            shots: shots.iter().map(|f| place(f, SHOT)).collect(),
            count,
        }
    }
}

/// A point that was eliminated: what its own step follows from.
struct Eliminated {
    inverse: Matrix3<f64>,
    right: Vector3<f64>,
    lenses: Vec<(usize, ByLens)>,
    shots: Vec<(usize, ByShot)>,
}

/// The reduced system, lower half.
pub(crate) struct Reduced {
    pub(crate) matrix: DMatrix<f64>,
    pub(crate) right: DVector<f64>,
    points: Vec<Eliminated>,
}

/// Residual of an observation in standard deviations, with derivatives by the lens, the shot, the point.
pub(crate) struct Look {
    pub(crate) plain: Derivatives,
    pub(crate) by_lens: SMatrix<f64, 2, LENS>,
    pub(crate) by_shot: SMatrix<f64, 2, SHOT>,
}

/// That of an observation; `camera` is the shot's, its focal length zoomed.
pub(crate) fn look(
    camera: &Camera,
    zoom: f64,
    at: &Point3<f64>,
    px: [f64; 2],
    sigma_px: f64,
) -> Option<Look> {
    let plain = derivatives(camera, at, px, sigma_px)?;
    let mut by_lens = plain.by_unknown.fixed_columns::<LENS>(0).into_owned();
    let mut by_shot = SMatrix::<f64, 2, SHOT>::zeros();
    by_shot
        .fixed_columns_mut::<6>(0)
        .copy_from(&plain.by_unknown.fixed_columns::<6>(LENS));
    // f = (1 + zoom) · lens' f
    let own = plain.by_unknown.column(0).into_owned();
    by_shot.set_column(6, &(own * (camera.lens.focal[0] / (1.0 + zoom))));
    by_lens.set_column(0, &(own * (1.0 + zoom)));
    Some(Look {
        plain,
        by_lens,
        by_shot,
    })
}

/// Builds the reduced system; `loss` is Cauchy's c, `damping` that of the points' own blocks.
pub(crate) fn reduce(
    model: &Model,
    places: &Places,
    sigma_px: f64,
    loss: f64,
    damping: f64,
) -> Reduced {
    let cameras = model.cameras();
    let stride = model.spots.len().div_ceil(PARTS).max(1);
    let part = |spots: &[Spot]| {
        let mut part = Reduced {
            matrix: DMatrix::zeros(places.count, places.count),
            right: DVector::zeros(places.count),
            points: Vec::with_capacity(spots.len()),
        };
        for spot in spots {
            let point = part.add(model, &cameras, places, spot, [sigma_px, loss, damping]);
            point.eliminate(&mut part.matrix, &mut part.right);
            part.points.push(point);
        }
        part
    };
    let parts: Vec<Reduced> = model.spots.par_chunks(stride).map(part).collect();
    let mut sum = Reduced {
        matrix: DMatrix::zeros(places.count, places.count),
        right: DVector::zeros(places.count),
        points: Vec::with_capacity(model.spots.len()),
    };
    for part in parts {
        sum.matrix += part.matrix;
        sum.right += part.right;
        sum.points.extend(part.points);
    }
    for i in 0..places.count {
        (0..i).for_each(|j| sum.matrix[(j, i)] = sum.matrix[(i, j)]);
    }
    sum
}

/// Adds to what stands at a place of a list.
fn gather<const N: usize>(
    list: &mut Vec<(usize, SMatrix<f64, N, 3>)>,
    at: usize,
    block: SMatrix<f64, N, 3>,
) {
    match list.iter_mut().find(|(place, _)| *place == at) {
        Some((_, sum)) => *sum += block,
        None => list.push((at, block)),
    }
}

impl Reduced {
    /// Adds a point's observations, the point still in.
    fn add(
        &mut self,
        model: &Model,
        cameras: &[Camera],
        places: &Places,
        spot: &Spot,
        [sigma_px, loss, damping]: [f64; 3],
    ) -> Eliminated {
        let c2 = loss * loss;
        let (mut v, mut right) = (Matrix3::zeros(), Vector3::zeros());
        let (mut lenses, mut shots) = (Vec::with_capacity(1), Vec::with_capacity(8));
        for (s, px) in &spot.observations {
            let shot = &model.shots[*s];
            let Some(look) = look(&cameras[*s], shot.zoom, &spot.at, *px, sigma_px) else {
                continue;
            };
            let (r, by_point) = (look.plain.residual, look.plain.by_point);
            let weight = 1.0 / (1.0 + r.norm_squared() / c2);
            let (by_lens, by_shot) = (look.by_lens, look.by_shot);
            v += by_point.transpose() * by_point * weight;
            right -= by_point.transpose() * r * weight;
            if let Some(at) = places.lenses[shot.lens] {
                let mut own = self.matrix.fixed_view_mut::<LENS, LENS>(at, at);
                own += by_lens.transpose() * by_lens * weight;
                let mut own = self.right.fixed_rows_mut::<LENS>(at);
                own -= by_lens.transpose() * r * weight;
                gather(&mut lenses, at, by_lens.transpose() * by_point * weight);
                if let Some(row) = places.shots[*s] {
                    let mut side = self.matrix.fixed_view_mut::<SHOT, LENS>(row, at);
                    side += by_shot.transpose() * by_lens * weight;
                }
            }
            if let Some(at) = places.shots[*s] {
                let mut own = self.matrix.fixed_view_mut::<SHOT, SHOT>(at, at);
                own += by_shot.transpose() * by_shot * weight;
                let mut own = self.right.fixed_rows_mut::<SHOT>(at);
                own -= by_shot.transpose() * r * weight;
                gather(&mut shots, at, by_shot.transpose() * by_point * weight);
            }
        }
        (0..3).for_each(|i| v[(i, i)] = v[(i, i)] * (1.0 + damping) + 1e-15);
        Eliminated {
            inverse: v.try_inverse().unwrap_or_default(),
            right,
            lenses,
            shots,
        }
    }

    /// The step of each point that follows from a step of the reduced unknowns.
    pub(crate) fn point_steps(&self, step: &DVector<f64>) -> Vec<Vector3<f64>> {
        let one = |point: &Eliminated| {
            let mut right = point.right;
            for (at, w) in &point.lenses {
                right -= w.transpose() * step.fixed_rows::<LENS>(*at);
            }
            for (at, w) in &point.shots {
                right -= w.transpose() * step.fixed_rows::<SHOT>(*at);
            }
            point.inverse * right
        };
        self.points.iter().map(one).collect()
    }
}

/// Subtracts W V⁻¹ Wᵀ of two blocks where it lies in the lower half.
fn subtract<const A: usize, const B: usize>(
    matrix: &mut DMatrix<f64>,
    (row, wv): (usize, &SMatrix<f64, A, 3>),
    (column, w): (usize, &SMatrix<f64, B, 3>),
) {
    if column <= row {
        let mut block = matrix.fixed_view_mut::<A, B>(row, column);
        block -= wv * w.transpose();
    }
}

impl Eliminated {
    /// Subtracts W V⁻¹ Wᵀ and W V⁻¹ g, in the lower half.
    fn eliminate(&self, matrix: &mut DMatrix<f64>, right: &mut DVector<f64>) {
        let solved = self.inverse * self.right;
        for (row, w) in &self.lenses {
            let mut r = right.fixed_rows_mut::<LENS>(*row);
            r -= w * solved;
            let wv = w * self.inverse;
            for (column, other) in &self.lenses {
                subtract(matrix, (*row, &wv), (*column, other));
            }
        }
        for (row, w) in &self.shots {
            let mut r = right.fixed_rows_mut::<SHOT>(*row);
            r -= w * solved;
            let wv = w * self.inverse;
            for (column, other) in &self.lenses {
                subtract(matrix, (*row, &wv), (*column, other));
            }
            for (column, other) in &self.shots {
                subtract(matrix, (*row, &wv), (*column, other));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Rotation3, Vector2};
    use shape::{Intrinsics, Pose};

    #[test]
    fn derivatives_are_those_of_the_projection() {
        let mut lens = Intrinsics::simple(1600, 2400, 3300.0);
        lens.radial = [-0.12, 0.04];
        let pose = Pose {
            rotation: Rotation3::from_euler_angles(1.4, -0.2, 0.7),
            translation: Vector3::new(40.0, 700.0, 1700.0),
        };
        let at = Point3::new(80.0, -300.0, 55.0);
        let seen = |lens: &Intrinsics, zoom: f64| {
            let camera = Camera {
                lens: Intrinsics {
                    focal: lens.focal.map(|f| f * (1.0 + zoom)),
                    ..*lens
                },
                pose,
            };
            look(&camera, zoom, &at, [800.0, 1200.0], 0.7).unwrap()
        };
        // Zoom of the shot, focal length of the lens: the two that a single camera does not have.
        proof::jacobian(Vector2::new(0.02, 3300.0), 1e-4, |x: Vector2<f64>| {
            let mut lens = lens;
            lens.focal = [x.y; 2];
            let look = seen(&lens, x.x);
            let columns = [look.by_shot.column(6), look.by_lens.column(0)];
            (
                look.plain.residual,
                SMatrix::<f64, 2, 2>::from_columns(&columns.map(|c| c.into_owned())),
            )
        });
    }
}
