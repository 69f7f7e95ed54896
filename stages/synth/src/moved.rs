//! The stage that tells the true cameras of a body that moves.

use rayon::prelude::*;
use shape::{Camera, Cameras, PhotoId, Pose, Sway, View};
use stage::{Ctx, Stage, Stop};
use std::sync::Arc;

stage::inputs! {
    /// Cameras, and how a body moved before them.
    pub struct MovedInput {
        /// The cameras around a body that does not move.
        cameras: Arc<Cameras>,
        /// How the body moved between photos.
        sway: Arc<Sway>,
    }
}

/// `synth.moved`: cameras, sway → cameras.
pub struct MovedCameras;

impl Stage for MovedCameras {
    const NAME: &'static str = "synth.moved";
    const VERSION: u32 = 1;
    const ABOUT: &'static str =
        "Gives the true cameras as a body that sways, turns and steps saw them.";
    type Params = ();
    type Input = MovedInput;
    type Output = Cameras;

    fn run(_: &(), input: MovedInput, _: &Ctx<'_>) -> Result<Cameras, Stop> {
        let seen = |(id, view): &(PhotoId, View)| {
            let moved = |motion: &Pose| seen_from(&view.camera, motion);
            let camera = input.sway.views.get(*id).map_or(view.camera, moved);
            let view = View {
                camera,
                ..view.clone()
            };
            (*id, view)
        };
        let views = input.cameras.views.as_slice();
        Ok(Cameras {
            views: views
                .par_iter()
                .map(seen)
                .collect::<Vec<_>>()
                .into_iter()
                .collect(),
            ..Cameras::clone(&input.cameras)
        })
    }
}

/// A camera as a body saw it that moved so from rest.
fn seen_from(camera: &Camera, motion: &Pose) -> Camera {
    Camera {
        lens: camera.lens,
        pose: Pose {
            rotation: camera.pose.rotation * motion.rotation,
            translation: camera.pose.rotation * motion.translation + camera.pose.translation,
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ring::{MakeRing, RingInput, RingParams};
    use crate::sway::{MakeSway, SwayInput, SwayParams};
    use nalgebra::Point3;

    #[test]
    fn a_point_at_rest_is_seen_where_the_moved_one_is() {
        let ctx = Ctx::alone();
        let cameras = Arc::new(MakeRing::run(&RingParams::default(), RingInput {}, &ctx).unwrap());
        let p = SwayParams {
            sway_mm: 40.0,
            shuffle_mm: 30.0,
            ..SwayParams::default()
        };
        let input = SwayInput {
            cameras: cameras.clone(),
        };
        let sway = Arc::new(MakeSway::run(&p, input, &ctx).unwrap());
        let input = MovedInput {
            cameras: cameras.clone(),
            sway: sway.clone(),
        };
        let moved = MovedCameras::run(&(), input, &ctx).unwrap();
        let x = Point3::new(120.0, -80.0, 1100.0);
        for (id, view) in cameras.views.iter() {
            let there = Point3::from(sway.views.get(id).unwrap().apply(&x));
            let [a, b] = [
                view.camera.project(&there).unwrap(),
                moved.views.get(id).unwrap().camera.project(&x).unwrap(),
            ];
            assert!((a - b).norm() < 1e-6);
        }
    }
}
