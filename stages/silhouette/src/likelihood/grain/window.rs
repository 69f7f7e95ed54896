//! What small windows of a photo leave of the ground that is expected there, at the best light.

use crate::likelihood::background::slack;
use nalgebra::{Matrix3, Vector3};
use shape::{Image, Rgb};

/// Half the side of the window in which the light is a plane (structural: samples). \[px of the reduced photo\]
const REACH: usize = 3;
/// Least share of a window that must be on the ground. By hand: looked at scene 131 with a plate, at 0.7 and 1.4 of it:
/// mean IoU 0 and +0.0000.
const LEAST_ON_GROUND: f32 = 0.5;

/// A photo on what the ground would show there, where that is known.
pub(super) struct Laid {
    width: usize,
    pixels: Vec<Option<Pixel>>,
}

/// What a pixel shows, and what the map has of the ground.
struct Pixel {
    shown: [f32; 3],
    map: [f32; 3],
    /// Darkest and brightest when edges move by a part of a pixel.
    lo: [f32; 3],
    hi: [f32; 3],
}

impl Pixel {
    /// The square that a light leaves, all channels together. \[levels²\]
    fn left(&self, light: f32) -> f32 {
        let off = |c: usize| {
            let below = self.lo[c] * light - self.shown[c];
            below.max(self.shown[c] - self.hi[c] * light).max(0.0)
        };
        let square = |c: usize| off(c) * off(c);
        square(0) + square(1) + square(2)
    }
}

impl Laid {
    /// A photo on a map of its size, where `on` is so.
    pub(super) fn new(photo: &Rgb, map: &Rgb, on: impl Fn(usize) -> bool) -> Self {
        let width = photo.width;
        let pixel = |i: usize| {
            on(i).then(|| {
                let (lo, hi) = slack(map, i % width, i / width);
                let (shown, map) = (photo.data[i].map(f32::from), map.data[i].map(f32::from));
                Pixel { shown, map, lo, hi }
            })
        };
        Laid {
            width,
            pixels: (0..photo.data.len()).map(pixel).collect(),
        }
    }

    /// What is left of each pixel that the ground may show, at the best light of the window that explains it
    /// best: the mean square of the window or the pixel's own square, whichever is more, all channels
    /// together. \[levels²\] Infinite where no window is on the ground far enough.
    /// Windows are `apart` pixels from each other.
    pub(super) fn left_over(&self, apart: usize) -> Image<f32> {
        let mut least = vec![f32::MAX; self.pixels.len()];
        let (mut window, mut left) = (vec![], vec![]);
        let middle = |i: usize| {
            (i % self.width).is_multiple_of(apart) && (i / self.width).is_multiple_of(apart)
        };
        for i in (0..self.pixels.len()).filter(|i| middle(*i) && self.pixels[*i].is_some()) {
            self.window(i, &mut window);
            if !self.explained(i, &window, &mut left) {
                continue;
            }
            let mean = left.iter().sum::<f32>() / left.len() as f32;
            for ((at, _), left) in window.iter().zip(&left) {
                least[*at] = least[*at].min(left.max(mean));
            }
        }
        Image {
            width: self.width,
            height: self.pixels.len() / self.width.max(1),
            data: least,
        }
    }

    /// The pixels of the window around a pixel that are on the ground, row by row.
    fn window<'a>(&'a self, i: usize, into: &mut Vec<(usize, &'a Pixel)>) {
        let (x, y) = (i % self.width, i / self.width);
        let height = self.pixels.len() / self.width;
        into.clear();
        for row in y.saturating_sub(REACH)..(y + REACH + 1).min(height) {
            let from = row * self.width;
            let across = x.saturating_sub(REACH)..(x + REACH + 1).min(self.width);
            into.extend(across.filter_map(|x| Some((from + x, self.pixels[from + x].as_ref()?))));
        }
    }

    /// The squares that the best plane of light leaves of a window around a pixel. \[levels²\] False where
    /// too little of it is on the ground.
    fn explained(&self, i: usize, window: &[(usize, &Pixel)], left: &mut Vec<f32>) -> bool {
        let side = (2 * REACH + 1) as f32;
        if (window.len() as f32) < LEAST_ON_GROUND * side * side {
            return false;
        }
        let (x, y) = (i % self.width, i / self.width);
        let at = |i: usize| {
            let place = |v: usize, middle: usize| (v as f32 - middle as f32) / REACH as f32;
            Vector3::new(1.0, place(i % self.width, x), place(i / self.width, y))
        };
        // Least squares of photo = (a + b x + c y) map; slopes are kept small, for a window may be thin.
        let mut normal = Matrix3::from_diagonal(&Vector3::new(1e-3, 1e-2, 1e-2));
        let mut wanted = Vector3::zeros();
        for (i, pixel) in window {
            let (m, u) = (pixel.map, at(*i));
            normal += u * u.transpose() * dot(m, m);
            wanted += u * dot(m, pixel.shown);
        }
        let Some(light) = normal.lu().solve(&wanted) else {
            return false;
        };
        left.clear();
        let squares = window
            .iter()
            .map(|(i, pixel)| pixel.left(light.dot(&at(*i)).max(0.0)));
        left.extend(squares);
        true
    }
}

fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
