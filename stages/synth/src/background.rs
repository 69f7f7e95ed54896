//! The background: walls with pictures and a boarded floor, as a formula of the place.

use crate::drawn::Palette;
use crate::noise::{chance, octaves, three};
use nalgebra::{Point3, Vector3};

/// A box seen from within; its axes are the world's, turned about z. \[mm\]
#[derive(Debug, Clone, Copy)]
pub(crate) struct Background {
    /// Least corner.
    pub(crate) low: [f64; 3],
    /// Greatest corner.
    pub(crate) high: [f64; 3],
    /// Size of things in it, relative to those around a grown person.
    pub(crate) scale: f64,
    /// Which of all such backgrounds.
    pub(crate) seed: u32,
    /// Its colours.
    pub(crate) palette: Palette,
}

/// Where a ray meets a wall, the floor or the ceiling.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Hit {
    /// The place. \[mm\]
    pub(crate) at: Point3<f64>,
    /// How far along the ray, in its lengths.
    pub(crate) way: f64,
    /// The axis that is square to it, and on which side it is: -1 or 1.
    pub(crate) wall: (usize, f64),
}

impl Background {
    /// The background around a turntable for a camera, in axes in which the camera is at -y; the floor is
    /// so much below the disk's top, or under the camera.
    pub(crate) fn around(camera: &Point3<f64>, below: f64, seed: u32, palette: Palette) -> Self {
        let far = camera.coords.norm().max(1.0);
        let scale = far / 3200.0;
        let floor = (-below).min(camera.z - 0.1 * far);
        Background {
            low: [-2600.0 * scale, -6000.0 * scale, floor],
            high: [2600.0 * scale, 1700.0 * scale, 4200.0 * scale],
            scale,
            seed,
            palette,
        }
    }

    /// The colour that a ray from within meets, linear; `spread` is the angle of a pixel. \[rad\]
    pub(crate) fn color(&self, from: &Point3<f64>, along: &Vector3<f64>, spread: f64) -> [f32; 3] {
        let Hit { at: hit, way, wall } = self.met(from, along);
        let at = [0, 1, 2].map(|i| (hit[i] / self.scale) as f32);
        let pixel = (way * spread / self.scale) as f32;
        match wall {
            (2, side) if side < 0.0 => self.floor(at, pixel),
            (2, _) => [0.7; 3],
            (axis, _) => self.wall(at, axis, pixel),
        }
    }

    /// Where a ray from within meets it.
    pub(crate) fn met(&self, from: &Point3<f64>, along: &Vector3<f64>) -> Hit {
        // The first wall on the way out.
        let (mut way, mut wall) = (f64::MAX, (2, -1.0));
        for axis in 0..3 {
            let side = if along[axis] > 0.0 { 1.0 } else { -1.0 };
            let plane = if side > 0.0 {
                self.high[axis]
            } else {
                self.low[axis]
            };
            let t = (plane - from[axis]) / along[axis];
            if t > 0.0 && t < way {
                (way, wall) = (t, (axis, side));
            }
        }
        Hit {
            at: from + along * way,
            way,
            wall,
        }
    }

    fn floor(&self, at: [f32; 3], pixel: f32) -> [f32; 3] {
        let board = [(at[1] / 130.0).floor() as i32, 0, 5];
        let run = at[0] + 900.0 * chance(board, self.seed);
        let piece = [board[0], (run / 1100.0).floor() as i32, 6];
        let tone = 0.6 + 0.6 * chance(piece, self.seed);
        let grain = octaves([at[0] * 0.12, at[1], 0.0], 40.0, 5.0, pixel, self.seed + 3);
        let gap = (at[1] / 130.0 - board[0] as f32) < 0.03;
        let shade = if gap {
            0.4
        } else {
            tone * (1.0 + 0.35 * grain)
        };
        self.palette.floor.map(|c| c * shade)
    }

    fn wall(&self, at: [f32; 3], axis: usize, pixel: f32) -> [f32; 3] {
        let (x, z) = (at[1 - axis], at[2]);
        let plaster = octaves(at, 320.0, 10.0, pixel, self.seed + 9);
        let frame = [
            (x / 620.0).floor() as i32,
            (z / 760.0).floor() as i32,
            axis as i32,
        ];
        let [u, v] = [x - frame[0] as f32 * 620.0, z - frame[1] as f32 * 760.0];
        let inside = (60.0..560.0).contains(&u) && (60.0..700.0).contains(&v);
        let hangs = inside && z > 250.0 && chance(frame, self.seed + 1) < self.palette.pictures;
        if !hangs {
            let shade = 1.0 + 0.12 * plaster;
            return self.palette.wall.map(|c| c * shade);
        }
        if !(80.0..540.0).contains(&u) || !(80.0..680.0).contains(&v) {
            return [0.03; 3];
        }
        // A mosaic: patches whose borders wander, with a grain.
        let size = 30.0 + 60.0 * chance(frame, self.seed + 2);
        let wander = octaves(at, 120.0, 30.0, pixel, self.seed + 4) * 0.6;
        let patch = [
            ((u / size) + wander).floor() as i32,
            ((v / size) - wander).floor() as i32,
            frame[0] * 31 + frame[1] * 7 + axis as i32,
        ];
        three(patch, self.seed + 5).map(|c| (0.04 + 0.7 * c * c) * (1.0 + 0.2 * plaster))
    }
}
