//! What small windows of a photo leave of the ground that is expected there, at the best light.
//!
//! Windows of a row are looked at in whole lanes, each sum in a fixed order, so that the bytes are the same on every machine.

use crate::likelihood::background::slack;
use crate::raster::raster;
use nalgebra::{Matrix3, Vector3};
use shape::{Image, Rgb};
use stage::machine::widest;

/// Half the side of the window in which the light is a plane (structural: samples). \[px of the reduced photo\]
const REACH: usize = 3;
/// Pixels of a window (derived).
const WINDOW: usize = (2 * REACH + 1) * (2 * REACH + 1);
/// Least share of a window that must be on the ground. By hand: looked at scene 131 with a plate, at 0.7 and 1.4 of it:
/// mean IoU 0 and +0.0000.
const LEAST_ON_GROUND: f32 = 0.5;
/// Windows side by side (structural: whole registers).
const LANES: usize = 8;

/// A number of each of the windows that are looked at together.
type Lanes = [f32; LANES];

/// What is left of each pixel that the ground may show (where `on` is so), at the best light of the window that explains
/// it best: the mean square of the window or the pixel's own square, whichever is more, all channels
/// together. \[levels²\] Infinite where no window is on the ground far enough. `map` is what the ground would show;
/// windows are `apart` pixels from each other.
pub(super) fn left_over(
    photo: &Rgb,
    map: &Rgb,
    apart: usize,
    on: impl Fn(usize) -> bool,
) -> Image<f32> {
    let laid = Laid::new(photo, map, apart, on);
    let mut least = vec![f32::MAX; laid.on.len()];
    widest(
        #[inline(always)]
        || laid.explain(&mut least),
    );
    let (width, height) = (photo.width, photo.height);
    let of = |i: usize| match laid.place(i % width, i / width) {
        place if laid.on[place] > 0.0 => least[place],
        _ => f32::MAX,
    };
    raster(width, height, (0..width * height).map(of).collect())
}

/// A photo on what the ground would show there: numbers of pixels by [`Laid::place`], all 0 where that is not known.
///
/// Columns that are a window's middle are beside each other, then those that are one pixel right of one, and so on. A
/// margin is around all of them.
struct Laid {
    apart: usize,
    /// Windows along a row, and rows of the photo.
    windows: usize,
    height: usize,
    /// Places of columns that are as far from a window's middle, and of a row.
    phase: usize,
    stride: usize,
    /// 1 where the ground may be shown.
    on: Vec<f32>,
    /// What a pixel shows.
    shown: [Vec<f32>; 3],
    /// Darkest and brightest that the ground would show there when edges move by a part of a pixel.
    lo: [Vec<f32>; 3],
    hi: [Vec<f32>; 3],
    /// Products of what the ground would show with itself and with what is shown, channels summed.
    square: Vec<f32>,
    product: Vec<f32>,
}

impl Laid {
    fn new(photo: &Rgb, map: &Rgb, apart: usize, on: impl Fn(usize) -> bool) -> Self {
        let windows = photo.width.div_ceil(apart);
        let phase = windows.next_multiple_of(LANES) + 2 * REACH;
        let stride = apart * phase;
        let all = || vec![0.0; stride * (photo.height + 2 * REACH)];
        let three = || [all(), all(), all()];
        let mut laid = Laid {
            apart,
            windows,
            height: photo.height,
            phase,
            stride,
            on: all(),
            shown: three(),
            lo: three(),
            hi: three(),
            square: all(),
            product: all(),
        };
        for i in (0..photo.data.len()).filter(|i| on(*i)) {
            let (x, y) = (i % photo.width, i / photo.width);
            let (lo, hi) = slack(map, x, y);
            let (shown, map) = (photo.data[i].map(f32::from), map.data[i].map(f32::from));
            let place = laid.place(x, y);
            laid.on[place] = 1.0;
            laid.square[place] = dot(map, map);
            laid.product[place] = dot(map, shown);
            for c in 0..3 {
                laid.shown[c][place] = shown[c];
                (laid.lo[c][place], laid.hi[c][place]) = (lo[c], hi[c]);
            }
        }
        laid
    }

    fn place(&self, x: usize, y: usize) -> usize {
        (y + REACH) * self.stride + x % self.apart * self.phase + REACH + x / self.apart
    }

    /// The pixels of a window, row by row: places from its middle, and how far from it they are in halves of the window.
    fn window(&self) -> [(isize, [f32; 2]); WINDOW] {
        let (side, reach) = (2 * REACH + 1, REACH as isize);
        std::array::from_fn(|i| {
            let [dx, dy] = [i % side, i / side].map(|d| d as isize - reach);
            let apart = self.apart as isize;
            let column = dx.rem_euclid(apart) * self.phase as isize + dx.div_euclid(apart);
            let far = [dx, dy].map(|d| d as f32 / REACH as f32);
            (dy * self.stride as isize + column, far)
        })
    }

    /// Lowers what is left of each pixel to what the windows leave of it.
    #[inline(always)]
    fn explain(&self, least: &mut [f32]) {
        let window = self.window();
        let mut left = [[0.0; LANES]; WINDOW];
        for y in (0..self.height).step_by(self.apart) {
            for first in (0..self.windows).step_by(LANES) {
                let middle = self.place(first * self.apart, y);
                let Some((light, count)) = self.light(middle, &window) else {
                    continue;
                };
                let mut mean = [0.0; LANES];
                for ((step, [x, y]), left) in window.iter().zip(&mut left) {
                    let at = middle.wrapping_add_signed(*step);
                    let mut here = [0.0; LANES];
                    for l in 0..LANES {
                        here[l] = (light[0][l] + light[1][l] * x + light[2][l] * y).max(0.0);
                    }
                    *left = self.left(at, here);
                    (0..LANES).for_each(|l| mean[l] += left[l]);
                }
                for l in 0..LANES {
                    // Where a window has no light it explains nothing.
                    mean[l] = match count[l] > 0.0 {
                        true => mean[l] / count[l],
                        false => f32::MAX,
                    };
                }
                for ((step, _), left) in window.iter().zip(&left) {
                    let least = &mut least[middle.wrapping_add_signed(*step)..][..LANES];
                    for l in 0..LANES {
                        least[l] = least[l].min(left[l].max(mean[l]));
                    }
                }
            }
        }
    }

    /// The square that lights leave of pixels side by side, all channels together. \[levels²\]
    #[inline(always)]
    fn left(&self, at: usize, light: Lanes) -> Lanes {
        let mut squares = [[0.0; LANES]; 3];
        for (c, square) in squares.iter_mut().enumerate() {
            let (lo, hi) = (lanes(&self.lo[c], at), lanes(&self.hi[c], at));
            let shown = lanes(&self.shown[c], at);
            for l in 0..LANES {
                let below = lo[l] * light[l] - shown[l];
                let off = below.max(shown[l] - hi[l] * light[l]).max(0.0);
                square[l] = off * off;
            }
        }
        let [mut sum, b, c] = squares;
        for l in 0..LANES {
            sum[l] = sum[l] + b[l] + c[l];
        }
        sum
    }

    /// The best planes of light of windows side by side, and how many pixels each has on the ground: 0 where it has none in
    /// its middle, or too few. `None` if that is so of all.
    #[inline(always)]
    fn light(
        &self,
        middle: usize,
        window: &[(isize, [f32; 2]); WINDOW],
    ) -> Option<([Lanes; 3], Lanes)> {
        let on = lanes(&self.on, middle);
        if on == [0.0; LANES] {
            return None;
        }
        // Least squares of photo = (a + b x + c y) map; slopes are kept small, for a window may be thin.
        let mut normal = [
            [1e-3; LANES],
            [0.0; LANES],
            [0.0; LANES],
            [1e-2; LANES],
            [0.0; LANES],
            [1e-2; LANES],
        ];
        let (mut wanted, mut count) = ([[0.0; LANES]; 3], [0.0; LANES]);
        for (step, [x, y]) in window {
            let at = middle.wrapping_add_signed(*step);
            let (on, square, product) = (
                lanes(&self.on, at),
                lanes(&self.square, at),
                lanes(&self.product, at),
            );
            let by = [1.0, *x, *y, x * x, x * y, y * y];
            for l in 0..LANES {
                count[l] += on[l];
                (0..6).for_each(|k| normal[k][l] += by[k] * square[l]);
                (0..3).for_each(|k| wanted[k][l] += by[k] * product[l]);
            }
        }
        let mut light = [[0.0; LANES]; 3];
        for l in 0..LANES {
            let [a, b, c, d, e, f] = normal.map(|n| n[l]);
            let enough = on[l] > 0.0 && count[l] >= LEAST_ON_GROUND * WINDOW as f32;
            let solved = || {
                Matrix3::new(a, b, c, b, d, e, c, e, f)
                    .lu()
                    .solve(&Vector3::from(wanted.map(|w| w[l])))
            };
            match enough.then(solved).flatten() {
                Some(best) => (0..3).for_each(|k| light[k][l] = best[k]),
                None => count[l] = 0.0,
            }
        }
        (count != [0.0; LANES]).then_some((light, count))
    }
}

/// Numbers of places side by side.
#[inline(always)]
fn lanes(of: &[f32], at: usize) -> Lanes {
    of[at..].first_chunk().copied().unwrap_or_default()
}

fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What a light leaves of a pixel.
    fn left(photo: &Rgb, map: &Rgb, i: usize, light: f32) -> f32 {
        let (lo, hi) = slack(map, i % map.width, i / map.width);
        let shown = photo.data[i].map(f32::from);
        let off = |c: usize| (lo[c] * light - shown[c]).max(shown[c] - hi[c] * light);
        let square = |c: usize| off(c).max(0.0) * off(c).max(0.0);
        square(0) + square(1) + square(2)
    }

    #[test]
    fn windows_side_by_side_leave_what_each_leaves_alone() {
        let (width, height) = (37, 15);
        let mut dice = proof::Dice(4);
        let mut image = || {
            let mut image = Rgb::filled(width, height, [0; 3]);
            (image.data.iter_mut())
                .for_each(|p| *p = [0; 3].map(|_| dice.within(0.0, 255.9) as u8));
            image
        };
        let (photo, map) = (image(), image());
        let on: Vec<bool> = map.data.iter().map(|p| p[0] < 170).collect();
        for apart in 1..=3 {
            let mut wanted = vec![f32::MAX; on.len()];
            let places = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
            for (x, y) in places.filter(|(x, y)| x % apart + y % apart == 0 && on[y * width + x]) {
                let far = |v: usize, middle: usize| (v as f32 - middle as f32) / REACH as f32;
                let at = |i: usize| Vector3::new(1.0, far(i % width, x), far(i / width, y));
                let inside = |i: &usize| at(*i).amax() <= 1.0 && on[*i];
                let window: Vec<usize> = (0..on.len()).filter(inside).collect();
                let mut normal = Matrix3::from_diagonal(&Vector3::new(1e-3, 1e-2, 1e-2));
                let mut sum = Vector3::zeros();
                for i in &window {
                    let (m, shown) = (map.data[*i].map(f32::from), photo.data[*i].map(f32::from));
                    normal += at(*i) * at(*i).transpose() * dot(m, m);
                    sum += at(*i) * dot(m, shown);
                }
                let best = normal.lu().solve(&sum).unwrap();
                let left = |i: &usize| left(&photo, &map, *i, best.dot(&at(*i)).max(0.0));
                let mean = window.iter().map(left).sum::<f32>() / window.len() as f32;
                if window.len() as f32 >= LEAST_ON_GROUND * WINDOW as f32 {
                    (window.iter()).for_each(|i| wanted[*i] = wanted[*i].min(left(i).max(mean)));
                }
            }
            assert!(wanted.iter().filter(|w| **w < f32::MAX).count() > 200);
            let found = left_over(&photo, &map, apart, |i| on[i]).data;
            assert_eq!(found, wanted, "{apart}");
        }
    }
}
