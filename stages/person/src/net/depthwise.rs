//! Convolution of each channel by itself.

use super::convolve::{LANES, Window};
use super::tensor::Tensor;

/// Weights by place in the window and channel.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Depthwise {
    pub(super) window: Window,
    pub(super) weights: Vec<f32>,
    /// One a channel; a multiple of `LANES` channels.
    pub(super) bias: Vec<f32>,
    /// Whether the output is clamped to 0 to 6.
    pub(super) relu6: bool,
}

impl Depthwise {
    /// Of an image that the window fits, with as many channels as weights.
    #[inline(always)]
    pub(super) fn of(&self, image: &Tensor) -> Tensor {
        let window = &self.window;
        let [height, width] = window.out(image.height, image.width).unwrap_or_default();
        let mut out = Tensor::zeros(height, width, image.channels);
        let [top, left, ..] = window.pads;
        // The places of the window, from and to, that meet the image.
        let meets = |at: usize, before: usize, size: usize, n: usize| {
            let from = before.saturating_sub(at * window.stride);
            let to = (n + before).saturating_sub(at * window.stride).min(size);
            from..to
        };
        for y in 0..height {
            let rows = meets(y, top, window.size[0], image.height);
            for x in 0..width {
                let columns = meets(x, left, window.size[1], image.width);
                let (first_x, first_y) = (x * window.stride, y * window.stride);
                let to = out.pixel_mut(x, y);
                for (lanes, to) in to.chunks_exact_mut(LANES).enumerate() {
                    let first = lanes * LANES;
                    let mut sums: [f32; LANES] = std::array::from_fn(|k| self.bias[first + k]);
                    for ky in rows.clone() {
                        let row = (first_y + ky - top) * image.width;
                        for kx in columns.clone() {
                            let at = (row + first_x + kx - left) * image.channels + first;
                            let tap = (ky * window.size[1] + kx) * image.channels + first;
                            let from = &image.data[at..at + LANES];
                            let weights = &self.weights[tap..tap + LANES];
                            for lane in 0..LANES {
                                sums[lane] += from[lane] * weights[lane];
                            }
                        }
                    }
                    if self.relu6 {
                        sums = sums.map(|v| v.clamp(0.0, 6.0));
                    }
                    to.copy_from_slice(&sums);
                }
            }
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_channel_is_convolved_by_itself() {
        let number = |i: usize| ((i * 7919 + 13) % 101) as f32 / 50.0 - 1.0;
        let mut image = Tensor::zeros(5, 6, 16);
        (0..image.data.len()).for_each(|i| image.data[i] = number(i));
        let one = Depthwise {
            window: Window {
                size: [3, 3],
                stride: 2,
                pads: [0, 1, 1, 1],
            },
            weights: (0..9 * 16).map(number).collect(),
            bias: (0..16).map(number).collect(),
            relu6: false,
        };
        let out = one.of(&image);
        assert_eq!((out.height, out.width, out.channels), (2, 3, 16));
        for i in 0..out.data.len() {
            let (c, x, y) = (i % 16, i / 16 % 3, i / 48);
            let mut sum = one.bias[c];
            for tap in 0..9 {
                let (ix, iy) = ((2 * x + tap % 3).wrapping_sub(1), 2 * y + tap / 3);
                if ix < 6 && iy < 5 {
                    sum += image.pixel(ix, iy)[c] * one.weights[tap * 16 + c];
                }
            }
            assert_eq!(out.data[i], sum);
        }
    }
}
