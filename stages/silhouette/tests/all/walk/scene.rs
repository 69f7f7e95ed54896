//! A made scene: a figure of ellipsoids between patterned walls, a camera that walks around it,
//! what its photos show, and which of their pixels are the figure.

use crate::walk::background::{background, noise};
use nalgebra::{Matrix3, Point2, Point3, Rotation3, Vector3};
use proof::Dice;
use rayon::prelude::*;
use shape::{
    Camera, Cameras, Intrinsics, Mask, Observation, Photo, PhotoId, Photos, Pose, Rgb, Scale,
    Tracks, View, rgb_to_png,
};

/// Half of the distances between walls, and the ceiling's height. \[mm\]
const WALLS: [f64; 3] = [2900.0, 2900.0, 2700.0];

/// How a scene is made.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Made {
    /// How many photos.
    pub(crate) photos: usize,
    /// Width of a photo. \[px\] It is half as high again.
    pub(crate) width: usize,
    /// Part of the way round that is walked.
    pub(crate) round: f64,
    /// How far the figure is aside. \[mm\]
    pub(crate) aside: f64,
    /// Colours of skin, shirt and trousers.
    pub(crate) colors: [[f64; 3]; 3],
    /// Colour of the floor.
    pub(crate) floor: [f64; 3],
    /// Whether walls and floor have one colour, the shirt's.
    pub(crate) plain: bool,
    /// How near the camera comes. \[mm\]
    pub(crate) near: f64,
}

impl Default for Made {
    fn default() -> Self {
        Made {
            photos: 12,
            width: 200,
            round: 1.0,
            aside: 0.0,
            colors: [
                [205.0, 160.0, 135.0],
                [70.0, 95.0, 150.0],
                [60.0, 58.0, 66.0],
            ],
            floor: [104.0, 116.0, 108.0],
            plain: false,
            near: 2150.0,
        }
    }
}

/// A part of the figure: centre, half axes, how it leans to its side and back, and which colour.
type Part = (Point3<f64>, Vector3<f64>, [Rotation3<f64>; 2], usize);

fn figure(aside: f64) -> Vec<Part> {
    let part = |c: [f64; 3], r: [f64; 3], lean: f64, color| {
        let at = Point3::new(c[0] + aside, c[1], c[2]);
        let turn = Rotation3::from_axis_angle(&Vector3::y_axis(), f64::to_radians(lean));
        (at, Vector3::from(r), [turn, turn.inverse()], color)
    };
    let mut all = vec![
        part([0.0, 0.0, 1650.0], [78.0, 95.0, 120.0], 0.0, 0),
        part([0.0, 0.0, 1500.0], [55.0, 58.0, 90.0], 0.0, 0),
        part([0.0, 0.0, 1280.0], [185.0, 120.0, 240.0], 0.0, 1),
        part([0.0, 0.0, 1020.0], [165.0, 125.0, 180.0], 0.0, 1),
        part([0.0, 10.0, 900.0], [175.0, 135.0, 140.0], 0.0, 2),
    ];
    for s in [-1.0, 1.0] {
        all.push(part(
            [s * 95.0, 0.0, 620.0],
            [88.0, 95.0, 330.0],
            s * 3.0,
            2,
        ));
        all.push(part(
            [s * 110.0, 0.0, 260.0],
            [60.0, 66.0, 262.0],
            s * 2.0,
            2,
        ));
        all.push(part([s * 115.0, -60.0, 42.0], [48.0, 130.0, 42.0], 0.0, 2));
        all.push(part(
            [s * 265.0, 0.0, 1200.0],
            [48.0, 55.0, 210.0],
            s * -14.0,
            1,
        ));
        all.push(part(
            [s * 330.0, -20.0, 930.0],
            [40.0, 44.0, 180.0],
            s * -8.0,
            0,
        ));
    }
    all
}

/// A scene, ready to be photographed.
pub(crate) struct Scene {
    made: Made,
    figure: Vec<Part>,
    /// The cameras.
    pub(crate) cameras: Vec<Camera>,
}

/// What a ray meets.
struct Hit {
    at: Point3<f64>,
    color: [f64; 3],
    body: bool,
}

impl Scene {
    /// With cameras around it.
    pub(crate) fn new(made: Made) -> Scene {
        let mut dice = Dice(11);
        let cameras = (0..made.photos).map(|k| camera(&made, k, &mut dice));
        Scene {
            made,
            figure: figure(made.aside),
            cameras: cameras.collect(),
        }
    }

    /// The first thing along a ray.
    fn hit(&self, from: &Point3<f64>, ray: &Vector3<f64>) -> Hit {
        let (lo, hi) = ([-WALLS[0], -WALLS[1], 0.0], WALLS);
        let wall = |a: usize| {
            let end = if ray[a] > 0.0 { hi[a] } else { lo[a] };
            ((end - from[a]) / ray[a], a)
        };
        let (mut along, axis) = (0..3).map(wall).min_by(|a, b| a.0.total_cmp(&b.0)).unwrap();
        let mut met: Option<(usize, f64)> = None;
        for (centre, axes, [turn, back], color) in &self.figure {
            let o = (back * (from - centre)).component_div(axes);
            let d = (back * ray).component_div(axes);
            let (a, b, c) = (d.norm_squared(), o.dot(&d), o.norm_squared() - 1.0);
            let root = b * b - a * c;
            if root <= 0.0 {
                continue;
            }
            let t = (-b - root.sqrt()) / a;
            if t > 0.0 && t < along {
                let normal = turn * (o + d * t).component_div(axes);
                let light = normal.normalize().dot(&Vector3::new(0.45, -0.35, 0.82));
                (along, met) = (t, Some((*color, 0.66 + 0.34 * light)));
            }
        }
        let at = from + ray * along;
        if let Some((color, light)) = met {
            let cloth = 1.0 + 0.3 * (noise(&at, 9.0, 1) + noise(&at, 31.0, 2) - 1.0);
            let color = self.made.colors[color].map(|c| c * cloth * light);
            return Hit {
                at,
                color,
                body: true,
            };
        }
        Hit {
            at,
            color: background(&self.made, &at, axis),
            body: false,
        }
    }

    /// A photo, four samples a pixel, and how much of each pixel is the figure.
    pub(crate) fn photograph(&self, k: usize) -> (Rgb, Mask) {
        let (w, h) = (self.made.width, self.made.width * 3 / 2);
        let camera = &self.cameras[k];
        let from = camera.centre();
        let mut dice = Dice(90 + k as u64);
        let light = dice.within(0.92, 1.08);
        let pixel = |i: usize| {
            let (mut color, mut body) = ([0.0; 3], 0.0);
            for s in 0..4 {
                let off = |bit: usize| if s >> bit & 1 == 1 { 0.25 } else { -0.25 };
                let px = Point2::new((i % w) as f64 + off(0), (i / w) as f64 + off(1));
                let hit = self.hit(&from, &camera.ray(px));
                (0..3).for_each(|c| color[c] += hit.color[c] * light / 4.0);
                body += f64::from(u8::from(hit.body)) / 4.0;
            }
            (color, body)
        };
        let all: Vec<([f64; 3], f64)> = (0..w * h).into_par_iter().map(pixel).collect();
        let (mut photo, mut mask) = (Rgb::filled(w, h, [0; 3]), Mask::filled(w, h, 0));
        for (i, (color, body)) in all.into_iter().enumerate() {
            photo.data[i] =
                color.map(|c| (c + 2.0 * dice.normal()).round().clamp(0.0, 255.0) as u8);
            mask.data[i] = (body * 255.0).round() as u8;
        }
        (photo, mask)
    }

    /// All photos, the true masks.
    pub(crate) fn photos(&self) -> (Photos, Vec<Mask>) {
        let (mut photos, mut masks) = (Photos::default(), vec![]);
        for k in 0..self.made.photos {
            let (pixels, mask) = self.photograph(k);
            photos.photos.push(Photo::of(
                format!("{k:04}.png"),
                [pixels.width as u32, pixels.height as u32],
                rgb_to_png(&pixels),
            ));
            masks.push(mask);
        }
        (photos, masks)
    }

    /// The true cameras; the ground at z = 0.
    pub(crate) fn truth(&self) -> Cameras {
        let view = |(k, camera): (usize, &Camera)| {
            let view = View {
                name: format!("{k:04}.png"),
                camera: *camera,
                sigma_mm: None,
                rms_px: None,
                points: 0,
            };
            (PhotoId(k as u32), view)
        };
        Cameras {
            views: self.cameras.iter().enumerate().map(view).collect(),
            scale: Scale::Nothing,
            scale_sigma: None,
            disk_radius_mm: None,
            ground_mm: 0.0,
            points: vec![],
        }
    }

    /// Features: points that a thrown ray of a photo meets, where the other photos see them.
    pub(crate) fn tracks(&self, count: usize) -> Tracks {
        let mut dice = Dice(23);
        let (w, h) = (self.made.width as f64, self.made.width as f64 * 1.5);
        let mut points = vec![];
        for t in 0..count {
            let camera = &self.cameras[t % self.cameras.len()];
            let px = Point2::new(dice.within(0.0, w - 1.0), dice.within(0.0, h - 1.0));
            let at = self.hit(&camera.centre(), &camera.ray(px)).at;
            let mut sights = vec![];
            for (k, camera) in self.cameras.iter().enumerate() {
                let to = at - camera.centre();
                let Some(px) = camera.project(&at).filter(|px| camera.holds(*px)) else {
                    continue;
                };
                let met = self.hit(&camera.centre(), &to.normalize());
                if (met.at - at).norm() < 1.0 {
                    sights.push(Observation {
                        photo: PhotoId(k as u32),
                        at_px: [px.x, px.y].map(|v| (v + 0.2 * dice.normal()) as f32),
                        scale_px: 2.0,
                    });
                }
            }
            if sights.len() > 1 {
                points.push(sights);
            }
        }
        Tracks { points }
    }
}

/// The camera of a photo: around the origin, by hand.
fn camera(made: &Made, k: usize, dice: &mut Dice) -> Camera {
    let part = (k as f64 + dice.within(-0.25, 0.25)) / made.photos as f64;
    let angle = part * made.round * std::f64::consts::TAU;
    let far = made.near * dice.within(0.9, 1.1);
    let from = Vector3::new(
        far * libm::sin(angle),
        -far * libm::cos(angle),
        dice.within(1200.0, 1500.0),
    );
    let to = Vector3::new(
        dice.within(-50.0, 50.0),
        dice.within(-50.0, 50.0),
        dice.within(830.0, 930.0),
    );
    let forward = (to - from).normalize();
    let right = forward.cross(&Vector3::z()).normalize();
    let rows = [right, forward.cross(&right), forward].map(|r| r.transpose());
    let roll = Rotation3::from_euler_angles(0.0, 0.0, dice.within(-0.03, 0.03));
    let rotation = roll * Rotation3::from_matrix_unchecked(Matrix3::from_rows(&rows));
    let width = made.width as u32;
    Camera {
        lens: Intrinsics::simple(width, width * 3 / 2, 1.38 * f64::from(width)),
        pose: Pose {
            rotation,
            translation: -(rotation * from),
        },
    }
}
