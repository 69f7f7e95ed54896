//! The normal equations of a walk's lenses and shots, points eliminated.

use crate::adjust::lens::LENS;
use crate::adjust::normal::{Block, Normal, Point};
use crate::adjust::residual::{Derivatives, derivatives};
use crate::walk::model::{Model, Spot};
use nalgebra::{Point3, SMatrix};
use rayon::prelude::*;
use shape::Camera;

/// Unknowns of a shot: rotation, translation, zoom (structural: 3 + 3 + 1).
pub(crate) const SHOT: usize = 7;
/// Into how many parts points are split, whatever the number of threads (structural: the order of sums).
const PARTS: usize = 8;

/// Where unknowns are in the system; what has no place is fixed.
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
) -> Normal {
    let cameras = model.cameras();
    let stride = model.spots.len().div_ceil(PARTS).max(1);
    let part = |spots: &[Spot]| {
        let mut part = Normal::new(places.count);
        for spot in spots {
            let mut point = Point::default();
            for (s, px) in &spot.observations {
                let shot = &model.shots[*s];
                let Some(look) = look(&cameras[*s], shot.zoom, &spot.at, *px, sigma_px) else {
                    continue;
                };
                let lens = places.lenses[shot.lens].map(|at| Block::new(at, &look.by_lens));
                let own = places.shots[*s].map(|at| Block::new(at, &look.by_shot));
                let blocks: Vec<Block> = lens.into_iter().chain(own).collect();
                let seen = Some((&mut point, &look.plain.by_point));
                part.observe(&look.plain.residual, &blocks, seen, loss * loss);
            }
            part.eliminate(point, damping);
        }
        part
    };
    let parts: Vec<Normal> = model.spots.par_chunks(stride).map(part).collect();
    parts
        .into_iter()
        .fold(Normal::new(places.count), Normal::join)
        .complete()
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Rotation3, Vector2, Vector3};
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
