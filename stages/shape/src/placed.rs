//! How a photo of a fixed camera is aligned to another: a stabiliser shifts and rolls the picture.

use crate::{Camera, Gray, Image, Rgb};
use nalgebra::{Rotation3, Vector3};
use rayon::prelude::*;
use stage::machine::widest;

/// How a picture is aligned to another of the same camera.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Placed {
    /// How far to the right and below this picture shows what the other shows. \[px\]
    pub shift: [f64; 2],
    /// How far it is turned about the picture's middle, clockwise as one looks at it. \[rad\]
    pub roll: f64,
    /// How much brighter it is.
    pub gain: f64,
    /// And by how much besides. \[levels\]
    pub bias: f64,
}

impl Placed {
    /// Just as the other.
    pub const SAME: Placed = Placed {
        shift: [0.0; 2],
        roll: 0.0,
        gain: 1.0,
        bias: 0.0,
    };

    /// Where a pixel of the other is on the picture, of a size. \[px\]
    #[inline]
    pub fn of(&self, [x, y]: [f64; 2], [width, height]: [usize; 2]) -> [f64; 2] {
        let (dx, dy) = (
            x - (width as f64 - 1.0) / 2.0,
            y - (height as f64 - 1.0) / 2.0,
        );
        // A small turn: its cosine is one.
        [
            x + self.shift[0] - self.roll * dy,
            y + self.shift[1] + self.roll * dx,
        ]
    }

    /// The longest way of a corner. \[px\]
    pub fn way(&self, width: usize, height: usize) -> f64 {
        let half = libm::hypot(width as f64, height as f64) / 2.0;
        libm::hypot(self.shift[0], self.shift[1]) + self.roll.abs() * half
    }

    /// Whether it is just where the other is.
    pub fn is_identity(&self) -> bool {
        self.shift == [0.0; 2] && self.roll == 0.0
    }

    /// The same for pictures so many times as large.
    pub fn enlarged(&self, factor: f64) -> Placed {
        Placed {
            shift: self.shift.map(|s| s * factor),
            ..*self
        }
    }

    /// A level of the picture as the other is exposed.
    #[inline]
    pub fn levelled(&self, level: f32) -> f32 {
        (level - self.bias as f32) / self.gain as f32
    }

    /// From the picture to the other.
    pub fn inverse(&self) -> Placed {
        Placed {
            shift: self.shift.map(|s| -s),
            roll: -self.roll,
            gain: 1.0 / self.gain,
            bias: -self.bias / self.gain,
        }
    }

    /// What a picture in colours shows where the other shows it (Catmull and Rom's cubic).
    pub fn brought(&self, picture: &Rgb) -> Rgb {
        let mut out = Image::filled(picture.width, picture.height, [0; 3]);
        let rows = out.data.par_chunks_mut(picture.width.max(1)).enumerate();
        rows.for_each(|(y, row)| {
            widest(
                #[inline(always)]
                || self.bring_row(picture, y, row),
            );
        });
        out
    }

    #[inline(always)]
    fn bring_row(&self, picture: &Rgb, y: usize, row: &mut [[u8; 3]]) {
        let size = [picture.width, picture.height];
        for (x, to) in row.iter_mut().enumerate() {
            let at = self.of([x as f64, y as f64], size);
            *to = cubic(picture, at.map(|v| v as f32));
        }
    }

    /// The same in one channel, linear between pixels.
    pub fn brought_gray(&self, picture: &Gray) -> Gray {
        let size = [picture.width, picture.height];
        let mut out = picture.clone();
        for (y, row) in out.data.chunks_mut(size[0].max(1)).enumerate() {
            for (x, to) in row.iter_mut().enumerate() {
                let at = self.of([x as f64, y as f64], size);
                *to = picture.sample(at[0] as f32, at[1] as f32);
            }
        }
        out
    }

    /// The camera of the picture, as it would be where the other was taken.
    pub fn brought_camera(&self, camera: &Camera) -> Camera {
        let mut lens = camera.lens;
        let size = [lens.width as usize, lens.height as usize];
        let [dx, dy] = [0, 1].map(|i| lens.centre[i] - (size[i] as f64 - 1.0) / 2.0);
        // The middle of the lens goes back by the shift, and turns about the picture's.
        lens.centre = [
            lens.centre[0] - self.shift[0] + self.roll * dy,
            lens.centre[1] - self.shift[1] - self.roll * dx,
        ];
        let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), -self.roll);
        let mut pose = camera.pose;
        pose.rotation = turn * pose.rotation;
        pose.translation = turn * pose.translation;
        Camera { lens, pose }
    }
}

/// Weights of four neighbours for a place so far from the second (Catmull and Rom 1974).
#[inline]
pub fn cubic_weights(t: f32) -> [f32; 4] {
    let (t2, t3) = (t * t, t * t * t);
    [
        -0.5 * t + t2 - 0.5 * t3,
        1.0 - 2.5 * t2 + 1.5 * t3,
        0.5 * t + 2.0 * t2 - 1.5 * t3,
        -0.5 * t2 + 0.5 * t3,
    ]
}

/// A colour between pixels; outside, that of the nearest border pixel.
#[inline(always)]
fn cubic(image: &Rgb, at: [f32; 2]) -> [u8; 3] {
    let base = at.map(f32::floor);
    let weights = [0, 1].map(|i| cubic_weights(at[i] - base[i]));
    let inner = |v: f32, size: usize| v >= 1.0 && v + 3.0 < size as f32;
    let sum = match inner(base[0], image.width) && inner(base[1], image.height) {
        true => cubic_inside(image, base.map(|v| v as usize - 1), weights),
        false => cubic_beside(image, base, weights),
    };
    // As `round` does of what is not below zero, without a call.
    sum.map(|s| {
        let s = s.clamp(0.0, 255.0);
        let whole = s as u8;
        whole + u8::from(s - f32::from(whole) >= 0.5)
    })
}

/// The sum over four by four pixels from a left upper one on. A fifth is to their right: four numbers of a row are read at
/// once, of which a pixel has three.
#[inline(always)]
fn cubic_inside(image: &Rgb, [x, y]: [usize; 2], [across, down]: [[f32; 4]; 2]) -> [f32; 3] {
    let mut sum = [0.0_f32; 4];
    for (j, v) in down.iter().enumerate() {
        let row = image.data[(y + j) * image.width + x..][..5].as_flattened();
        for (i, u) in across.iter().enumerate() {
            let p = [row[3 * i], row[3 * i + 1], row[3 * i + 2], row[3 * i + 3]];
            let weight = u * v;
            for c in 0..4 {
                sum[c] += weight * f32::from(p[c]);
            }
        }
    }
    [sum[0], sum[1], sum[2]]
}

/// The same anywhere.
fn cubic_beside(image: &Rgb, base: [f32; 2], [across, down]: [[f32; 4]; 2]) -> [f32; 3] {
    let inside = |v: f32, size: usize| v.clamp(0.0, (size - 1) as f32) as usize;
    let mut sum = [0.0_f32; 3];
    for (j, v) in down.iter().enumerate() {
        let row = image.row(inside(base[1] + j as f32 - 1.0, image.height));
        for (i, u) in across.iter().enumerate() {
            let p = row[inside(base[0] + i as f32 - 1.0, image.width)];
            (0..3).for_each(|c| sum[c] += u * v * f32::from(p[c]));
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Intrinsics, Pose};
    use nalgebra::Point3;

    #[test]
    fn a_point_is_where_the_brought_camera_sees_it() {
        let mut lens = Intrinsics::simple(600, 800, 900.0);
        lens.centre = [310.0, 380.0];
        let rotation = Rotation3::from_euler_angles(0.1, -0.2, 0.05);
        let translation = Vector3::new(30.0, -20.0, 1500.0);
        let pose = Pose {
            rotation,
            translation,
        };
        let camera = Camera { lens, pose };
        let placed = Placed {
            shift: [3.0, -2.0],
            roll: 0.002,
            ..Placed::SAME
        };
        let other = placed.brought_camera(&camera);
        for at in [
            [0.0, 0.0, 0.0],
            [300.0, -200.0, 100.0],
            [-200.0, 400.0, -50.0],
        ] {
            let point = Point3::from(at);
            let (p, q) = (camera.project(&point), other.project(&point));
            let (p, q) = (p.unwrap(), q.unwrap());
            let there = placed.of([q.x, q.y], [600, 800]);
            assert!(
                libm::hypot(there[0] - p.x, there[1] - p.y) < 0.01,
                "{there:?} {p}"
            );
            let back = placed.inverse().of(there, [600, 800]);
            assert!(libm::hypot(back[0] - q.x, back[1] - q.y) < 0.01);
        }
    }

    #[test]
    fn a_picture_is_brought_as_one_pixel_after_the_other_is() {
        let mut dice = proof::Dice(8);
        let mut picture = Rgb::filled(37, 29, [0; 3]);
        for p in &mut picture.data {
            *p = [0; 3].map(|_| (127.0 + 90.0 * dice.normal()).clamp(0.0, 255.0) as u8);
        }
        let placed = Placed {
            shift: [1.3, -2.6],
            roll: 0.01,
            ..Placed::SAME
        };
        let brought = placed.brought(&picture);
        for (i, found) in brought.data.iter().enumerate() {
            let at = placed.of([(i % 37) as f64, (i / 37) as f64], [37, 29]);
            let at = at.map(|v| v as f32);
            let base = at.map(f32::floor);
            let weights = [0, 1].map(|k| cubic_weights(at[k] - base[k]));
            let plain = cubic_beside(&picture, base, weights);
            assert_eq!(*found, plain.map(|s| s.round().clamp(0.0, 255.0) as u8));
        }
    }
}
