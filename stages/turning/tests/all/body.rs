//! A body of posts and joints that turns before a standing camera, as a network and a mask would show it.

use nalgebra::Vector3;
use shape::{Crop, Found, Image, Joint, Mask, People, Photo, PhotoId, Photos, Rig};
use stage::{Ctx, Host, Metric, Stage, Stop};
use std::f64::consts::{SQRT_2, TAU};
use std::sync::{Arc, Mutex};
use turning::scene::{Motion, Step, seen};
use turning::{FindMotion, MotionInput, MotionParams};

/// Pixels of a photo, square as the network's crop, and its focal length.
const SIDE: usize = 240;
const FOCAL: f64 = 210.0;

/// Posts: where they are, half their breadth and depth, from which height to which. [distance to the axis]
type Post = ([f64; 2], [f64; 2], [f64; 2]);
const POSTS: [Post; 6] = [
    ([0.0, -0.02], [0.035, 0.045], [0.13, 0.25]),
    ([0.0, 0.0], [0.07, 0.042], [-0.1, 0.13]),
    ([0.13, 0.01], [0.016, 0.02], [-0.08, 0.12]),
    ([-0.125, -0.02], [0.017, 0.018], [-0.08, 0.12]),
    ([0.045, 0.01], [0.028, 0.036], [-0.44, -0.1]),
    ([-0.045, 0.0], [0.028, 0.036], [-0.44, -0.1]),
];
/// Joints by their places in [`Found::JOINTS`]; the rest is not seen.
const JOINTS: [(usize, [f64; 3]); 21] = [
    (0, [0.0, -0.065, 0.18]),
    (7, [0.03, 0.0, 0.18]),
    (8, [-0.03, 0.0, 0.18]),
    (11, [0.068, 0.0, 0.1]),
    (12, [-0.068, 0.0, 0.1]),
    (13, [0.13, 0.01, 0.02]),
    (14, [-0.125, -0.02, 0.02]),
    (15, [0.13, 0.01, -0.06]),
    (16, [-0.125, -0.02, -0.06]),
    (19, [0.13, 0.01, -0.08]),
    (20, [-0.125, -0.02, -0.08]),
    (23, [0.036, 0.0, -0.09]),
    (24, [-0.036, 0.0, -0.09]),
    (25, [0.045, 0.01, -0.24]),
    (26, [-0.045, 0.0, -0.24]),
    (27, [0.045, 0.01, -0.4]),
    (28, [-0.045, 0.0, -0.4]),
    (29, [0.045, 0.03, -0.43]),
    (30, [-0.045, 0.03, -0.43]),
    (31, [0.05, -0.05, -0.43]),
    (32, [-0.05, -0.05, -0.43]),
];

/// What is done to a place on a photo after it was taken.
pub(crate) type Change = fn([f64; 2]) -> [f64; 2];

/// A capture: how the body turned, what was done to the photos, and photos with another body.
pub(crate) struct Turn {
    pub(crate) azimuths: Vec<f64>,
    pub(crate) change: Change,
    /// Whether left is named right, as of a mirrored picture.
    pub(crate) mirrored: bool,
    /// The photo on which somebody stouter is who faces elsewhere, if any.
    pub(crate) other: Option<usize>,
    /// How far joints are off, one standard deviation.
    pub(crate) noise_px: f64,
    /// How far the picture is elsewhere on each photo, one standard deviation, as of a camera in the hand.
    pub(crate) shake_px: f64,
}

impl Turn {
    /// Photos at even steps from one azimuth to another. \[°\]
    pub(crate) fn even(photos: usize, degrees: f64) -> Turn {
        let at = |i: usize| (degrees * i as f64 / photos as f64).to_radians();
        Turn {
            azimuths: (0..photos).map(at).collect(),
            change: |at| at,
            mirrored: false,
            other: None,
            noise_px: 0.0,
            shake_px: 0.0,
        }
    }

    /// The true motion: the body is some centimetres elsewhere on each photo.
    fn motion(&self) -> Motion {
        let step = |(i, azimuth): (usize, &f64)| Step {
            azimuth: *azimuth,
            off: [
                0.008 * libm::sin(3.0 * i as f64),
                0.008 * libm::sin(5.0 * i as f64),
            ],
            ..Step::default()
        };
        Motion {
            pitch: 0.0,
            steps: self.azimuths.iter().enumerate().map(step).collect(),
        }
    }

    /// How far the picture is elsewhere on a photo.
    fn shaken(&self, photo: usize) -> [f64; 2] {
        [31.0, 17.0].map(|k| self.shake_px * SQRT_2 * libm::sin(k * (1.0 + photo as f64)))
    }

    /// How much a pixel shows of the body.
    fn mask(&self, photo: usize, step: &Step) -> Mask {
        let stout = if self.other == Some(photo) { 1.5 } else { 1.0 };
        let mut mask = Mask::filled(SIDE, SIDE, 0);
        let by = self.shaken(photo);
        for ([x, y], [a, b], [low, high]) in POSTS {
            let around = (0..360).map(|k| {
                let (s, c) = libm::sincos(f64::from(k) / 360.0 * TAU);
                let there = step.to_fixed(&Vector3::new(x + stout * a * c, y + stout * b * s, 0.0));
                FOCAL * there.x / there.y
            });
            let (left, right) = around.fold((f64::MAX, f64::MIN), |(l, h), x| (l.min(x), h.max(x)));
            let away = step.to_fixed(&Vector3::new(x, y, 0.0)).y;
            let (top, bottom) = (-FOCAL * high / away, -FOCAL * low / away);
            let covered =
                |at: f64, lo: f64, hi: f64| (hi.min(at + 0.5) - lo.max(at - 0.5)).clamp(0.0, 1.0);
            for u in 0..SIDE {
                for v in 0..SIDE {
                    let at = [u as f64 - by[0], v as f64 - by[1]];
                    let [x, y] = (self.change)(at.map(|p| p - MIDDLE));
                    let share = covered(x, left, right) * covered(y, top, bottom);
                    let pixel = mask.at_mut(u, v);
                    *pixel = (*pixel).max((255.0 * share).round() as u8);
                }
            }
        }
        mask
    }

    /// What the network sees on a photo.
    fn found(&self, photo: usize, step: &Step, mask: &Mask) -> Found {
        let by = self.shaken(photo);
        let mut joints = vec![
            Joint {
                at_px: [-1e6, -1e6],
                visibility: 0.0,
                presence: 0.0
            };
            Found::JOINTS.len()
        ];
        let mut step = *step;
        if self.other == Some(photo) {
            step.azimuth += TAU / 4.0;
        }
        for (joint, at) in JOINTS {
            let at = seen(0.0, &step.to_fixed(&Vector3::from(at))).unwrap().0 * FOCAL;
            let phase = (1.0 + joint as f64) * (1.0 + 977.0 * step.azimuth);
            let noise = |k: f64| self.noise_px * SQRT_2 * libm::sin(k * phase);
            let [x, y] = (self.change)([at.x + noise(12.9), at.y + noise(78.2)]);
            let name = match self.mirrored && joint > 0 {
                true if joint % 2 == 0 => joint - 1,
                true => joint + 1,
                false => joint,
            };
            joints[name].at_px = [x + by[0], y + by[1]].map(|p| (p + MIDDLE) as f32);
        }
        Found {
            score: 0.9,
            presence: 1.0,
            head_px: [0.0; 4],
            crop: Crop {
                centre_px: [MIDDLE as f32; 2],
                side_px: SIDE as f32,
                angle: 0.0,
            },
            body: Image {
                width: SIDE,
                height: SIDE,
                data: mask
                    .data
                    .iter()
                    .map(|p| (i16::from(*p) - 128).clamp(-127, 127) as i8)
                    .collect(),
            },
            joints,
        }
    }

    /// What the stage makes of it: azimuths as the cameras have them, by the photos' names, and its warnings.
    pub(crate) fn taken(&self, masked: bool) -> Result<(Vec<(String, f64)>, String), Stop> {
        let motion = self.motion();
        let photos: Vec<Photo> = (0..motion.steps.len()).map(photo).collect();
        let ids = || (0..motion.steps.len()).map(|i| PhotoId(i as u32));
        let masks: Vec<Mask> = motion
            .steps
            .iter()
            .enumerate()
            .map(|(i, step)| self.mask(i, step))
            .collect();
        let found = motion.steps.iter().zip(&masks).enumerate();
        let found = found.map(|(i, (step, mask))| vec![self.found(i, step, mask)]);
        let input = MotionInput {
            photos: Arc::new(Photos {
                photos,
                plate: None,
                rig: Rig {
                    focal_px: Some(FOCAL),
                    ..Rig::default()
                },
            }),
            people: Arc::new(People {
                views: ids().zip(found).collect(),
                person: true,
            }),
            masks: masked.then(|| Arc::new(ids().zip(&masks).collect())),
            tracks: None,
        };
        let params = MotionParams {
            rounds: 8,
            ..MotionParams::default()
        };
        let heard = Heard::default();
        let nothing = stage::Hash::from_bytes([0; 32]);
        let cameras = FindMotion::run(&params, input, &Ctx::new(&heard, nothing, nothing))?;
        let azimuth = |view: &shape::View| {
            let right = view.camera.pose.rotation * Vector3::x();
            (view.name.clone(), libm::atan2(right.z, right.x))
        };
        let all = cameras.views.values().map(azimuth).collect();
        Ok((all, heard.0.into_inner().unwrap().join("\n")))
    }
}

/// The middle of a photo. \[px\]
const MIDDLE: f64 = (SIDE as f64 - 1.0) / 2.0;

fn photo(i: usize) -> Photo {
    Photo::of(
        format!("{i:04}.jpg"),
        [SIDE as u32, SIDE as u32],
        Vec::new(),
    )
}

#[derive(Default)]
struct Heard(Mutex<Vec<String>>);

impl Host for Heard {
    fn warn(&self, text: &stage::Message) {
        self.0.lock().unwrap().push(text.to_string());
    }
    fn metric(&self, _: Metric) {}
}
