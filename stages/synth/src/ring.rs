//! The stage that sets up cameras: one fixed camera before a disk that turns.

use crate::dice::Dice;
use crate::paced::paced;
use nalgebra::{Matrix3, Point3, Rotation3, Vector3};
use shape::{Camera, Cameras, Intrinsics, PhotoId, Pose, Scale, View, film_to_px};
use stage::{Ctx, Stage, Stop};

stage::params! {
    /// The camera's place and lens, and how the disk turns.
    pub struct RingParams {
        /// How many photos of one turn.
        #[range(1..=720)]
        #[source(structural)]
        views: u32 = 18,
        /// Width of a photo in pixels.
        #[range(16..=8000)]
        #[source(structural)]
        width: u32 = 800,
        /// Height of a photo in pixels.
        #[range(16..=8000)]
        #[source(structural)]
        height: u32 = 1200,
        /// Focal length as if on 36 × 24 mm film, by the diagonal.
        #[range(10.0..=500.0)]
        #[source(structural)]
        focal_35mm: f64 = 50.0,
        /// Distance of the camera from the axis.
        #[range(50.0..=20000.0)]
        #[source(structural)]
        distance_mm: f64 = 3200.0,
        /// Height of the camera above the disk.
        #[range(-5000.0..=10000.0)]
        #[source(structural)]
        camera_mm: f64 = 1300.0,
        /// Height on the axis that the camera looks at.
        #[range(-5000.0..=10000.0)]
        #[source(structural)]
        look_mm: f64 = 800.0,
        /// Standard deviation of the disk's angle about the even step.
        #[range(0.0..=5.0)]
        #[source(structural)]
        jitter_deg: f64 = 0.1,
        /// How many photos are from step to step of somebody who turns on the spot, and who turns smoothly from one to the
        /// next, as in a film; 1: each photo is a step.
        #[range(1..=720)]
        #[source(structural)]
        pace: u32 = 1,
        /// By how much the principal point is right of and below the photo's middle, as a share
        /// of the longer side.
        #[range(-0.1..=0.1)]
        #[source(structural)]
        off_centre: f64 = 0.002,
        /// First radial coefficient of the lens.
        #[range(-0.3..=0.3)]
        #[source(structural)]
        k1: f64 = 0.0,
        /// Second radial coefficient of the lens.
        #[range(-0.3..=0.3)]
        #[source(structural)]
        k2: f64 = 0.0,
        /// Whether the disk turns clockwise seen from above.
        clockwise: bool = false,
        /// Radius of the disk; 0 for no disk.
        #[range(0.0..=5000.0)]
        #[source(structural)]
        disk_mm: f64 = 350.0,
        /// Seed of what is by chance.
        #[chance(seed)]
        #[source(structural)]
        seed: u32 = 1,
    }
}

stage::inputs! {
    /// A made ring needs no inputs.
    pub struct RingInput {}
}

/// `synth.ring`: nothing → cameras.
pub struct MakeRing;

impl Stage for MakeRing {
    const NAME: &'static str = "synth.ring";
    const VERSION: u32 = 3;
    const ABOUT: &'static str =
        "Sets up the true cameras of one turn: one fixed camera before a disk that turns.";
    type Params = RingParams;
    type Input = RingInput;
    type Output = Cameras;

    fn run(p: &RingParams, _: RingInput, _: &Ctx<'_>) -> Result<Cameras, Stop> {
        let longer = f64::from(p.width.max(p.height));
        let mut lens = Intrinsics::simple(
            p.width,
            p.height,
            film_to_px(p.focal_35mm, p.width, p.height),
        );
        lens.centre = lens.centre.map(|c| c + p.off_centre * longer);
        lens.radial = [p.k1, p.k2];
        let fixed = looking(
            Point3::new(0.0, -p.distance_mm, p.camera_mm),
            Point3::new(0.0, 0.0, p.look_mm),
        );
        let mut dice = Dice::new(p.seed, 1);
        let sign = if p.clockwise { -1.0 } else { 1.0 };
        let step = |k: u32| {
            let even = f64::from(k * p.pace) / f64::from(p.views) * std::f64::consts::TAU;
            let jitter = if k == 0 { 0.0 } else { dice.normal() };
            [sign * even + jitter * p.jitter_deg.to_radians()]
        };
        let steps: Vec<[f64; 1]> = (0..=p.views).map(step).collect();
        let view = |i: u32| {
            let [angle] = paced(f64::from(i), p.pace, |k| steps[k as usize]);
            // What is on the disk turns with it: x_fixed = turn * x_world.
            let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), angle);
            let pose = Pose {
                rotation: fixed.rotation * turn,
                translation: fixed.translation,
            };
            let view = View {
                name: photo_name(i),
                camera: Camera { lens, pose },
                sigma_mm: None,
                rms_px: None,
                points: 0,
            };
            (PhotoId(i), view)
        };
        Ok(Cameras {
            views: (0..p.views).map(view).collect(),
            scale: Scale::Given,
            scale_sigma: None,
            disk_radius_mm: (p.disk_mm > 0.0).then_some(p.disk_mm),
            ground_mm: 0.0,
            points: vec![],
        })
    }
}

/// The name of a photo.
pub(crate) fn photo_name(i: u32) -> String {
    format!("{i:04}.jpg")
}

/// The pose of an upright camera that looks at a point.
pub fn looking(from: Point3<f64>, at: Point3<f64>) -> Pose {
    let z = (at - from).normalize();
    let x = z
        .cross(&Vector3::z())
        .try_normalize(1e-9)
        .unwrap_or(Vector3::x());
    let y = z.cross(&x);
    let rows = Matrix3::from_rows(&[x.transpose(), y.transpose(), z.transpose()]);
    let rotation = Rotation3::from_matrix_unchecked(rows);
    Pose {
        rotation,
        translation: -(rotation * from.coords),
    }
}
