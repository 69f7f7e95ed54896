//! Convolution over all channels: windows laid out as rows, then a product of matrices.

use super::tensor::Tensor;

/// Output channels side by side in registers (structural: what registers hold).
pub(super) const LANES: usize = 8;
/// Output pixels that share a weight while it is in a register (structural: what registers hold).
const PIXELS: usize = 4;

/// A window that moves over an image.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Window {
    /// Rows and pixels of the window.
    pub(super) size: [usize; 2],
    /// By how many pixels it moves.
    pub(super) stride: usize,
    /// Zeros above, left, below, right of the image.
    pub(super) pads: [usize; 4],
}

impl Window {
    /// Height and width of what comes out; `None` where the window is larger than the image.
    pub(super) fn out(&self, height: usize, width: usize) -> Option<[usize; 2]> {
        let one = |n: usize, before: usize, after: usize, size: usize| {
            Some((n + before + after).checked_sub(size)? / self.stride + 1)
        };
        let [top, left, bottom, right] = self.pads;
        let rows = one(height, top, bottom, self.size[0])?;
        Some([rows, one(width, left, right, self.size[1])?])
    }

    /// Whether a window is a pixel and each pixel has one.
    fn is_pixel(&self) -> bool {
        self.size == [1, 1] && self.stride == 1 && self.pads == [0; 4]
    }
}

/// Weights of a convolution, the lanes of each block of output channels side by side.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Convolution {
    pub(super) window: Window,
    /// Channels that come out.
    channels: usize,
    /// By block of `LANES` output channels, by place in the window and input channel.
    weights: Vec<[f32; LANES]>,
    bias: Vec<[f32; LANES]>,
    /// Whether the output is clamped to 0 to 6.
    relu6: bool,
}

impl Convolution {
    /// From weights by place in the window, input channel, output channel.
    pub(super) fn new(window: Window, weights: &[f32], bias: &[f32], relu6: bool) -> Convolution {
        let channels = bias.len();
        let terms = weights.len() / channels.max(1);
        let blocks = channels.div_ceil(LANES);
        let lanes = |from: &[f32], block: usize| {
            std::array::from_fn(|lane| from.get(block * LANES + lane).copied().unwrap_or(0.0))
        };
        let rows = |block: usize| {
            weights
                .chunks_exact(channels)
                .map(move |row| lanes(row, block))
        };
        let mut packed = Vec::with_capacity(blocks * terms);
        (0..blocks).for_each(|block| packed.extend(rows(block)));
        Convolution {
            window,
            channels,
            weights: packed,
            bias: (0..blocks).map(|block| lanes(bias, block)).collect(),
            relu6,
        }
    }

    /// Of an image that the window fits.
    #[inline(always)]
    pub(super) fn of(&self, image: &Tensor) -> Tensor {
        let window = &self.window;
        let [height, width] = window.out(image.height, image.width).unwrap_or_default();
        let mut out = Tensor::zeros(height, width, self.channels);
        if window.is_pixel() {
            self.rows(&image.data, image.channels, &mut out.data);
            return out;
        }
        let terms = window.size[0] * window.size[1] * image.channels;
        let mut laid = vec![0.0; width * terms];
        for y in 0..height {
            lay_out(window, image, y, &mut laid);
            let row = &mut out.data[y * width * self.channels..][..width * self.channels];
            self.rows(&laid, terms, row);
        }
        out
    }

    /// Each row of `terms` numbers times the weights.
    #[inline(always)]
    fn rows(&self, from: &[f32], terms: usize, out: &mut [f32]) {
        let whole = from.len() / terms / PIXELS * PIXELS;
        let (inputs, last_inputs) = from.split_at(whole * terms);
        let (outputs, last_outputs) = out.split_at_mut(whole * self.channels);
        let four = outputs.chunks_exact_mut(PIXELS * self.channels);
        for (from, out) in inputs.chunks_exact(PIXELS * terms).zip(four) {
            self.some::<PIXELS>(from, terms, out);
        }
        let one = last_outputs.chunks_exact_mut(self.channels);
        for (from, out) in last_inputs.chunks_exact(terms).zip(one) {
            self.some::<1>(from, terms, out);
        }
    }

    /// `N` rows at once; each sum runs in the order of its terms, whatever `N` is.
    #[inline(always)]
    fn some<const N: usize>(&self, from: &[f32], terms: usize, out: &mut [f32]) {
        let rows: [&[f32]; N] = std::array::from_fn(|n| &from[n * terms..(n + 1) * terms]);
        let blocks = self.weights.chunks_exact(terms).zip(&self.bias);
        for (block, (weights, bias)) in blocks.enumerate() {
            let mut sums = [*bias; N];
            for (i, weights) in weights.iter().enumerate() {
                for n in 0..N {
                    let value = rows[n][i];
                    for lane in 0..LANES {
                        sums[n][lane] += value * weights[lane];
                    }
                }
            }
            let first = block * LANES;
            let count = LANES.min(self.channels - first);
            for (n, mut sums) in sums.into_iter().enumerate() {
                if self.relu6 {
                    sums = sums.map(|v| v.clamp(0.0, 6.0));
                }
                out[n * self.channels + first..][..count].copy_from_slice(&sums[..count]);
            }
        }
    }
}

/// The windows of a row of the output, each as one row of numbers; zero outside of the image.
fn lay_out(window: &Window, image: &Tensor, y: usize, to: &mut [f32]) {
    let ([rows, columns], [top, left, ..]) = (window.size, window.pads);
    let channels = image.channels;
    let terms = rows * columns * channels;
    for (x, to) in to.chunks_exact_mut(terms).enumerate() {
        for (tap, to) in to.chunks_exact_mut(channels).enumerate() {
            let at = (
                (x * window.stride + tap % columns).checked_sub(left),
                (y * window.stride + tap / columns).checked_sub(top),
            );
            match at {
                (Some(x), Some(y)) if x < image.width && y < image.height => {
                    to.copy_from_slice(image.pixel(x, y));
                }
                _ => to.fill(0.0),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The definition, term by term.
    fn plain(window: &Window, image: &Tensor, weights: &[f32], bias: &[f32]) -> Tensor {
        let [height, width] = window.out(image.height, image.width).unwrap();
        let mut out = Tensor::zeros(height, width, bias.len());
        for i in 0..out.data.len() {
            let (x, y, o) = (
                i / bias.len() % width,
                i / bias.len() / width,
                i % bias.len(),
            );
            let mut sum = bias[o];
            for tap in 0..window.size[0] * window.size[1] {
                let ix =
                    (x * window.stride + tap % window.size[1]) as isize - window.pads[1] as isize;
                let iy =
                    (y * window.stride + tap / window.size[1]) as isize - window.pads[0] as isize;
                for c in 0..image.channels {
                    let inside = ix >= 0
                        && iy >= 0
                        && (ix as usize) < image.width
                        && (iy as usize) < image.height;
                    if inside {
                        let value = image.pixel(ix as usize, iy as usize)[c];
                        sum += value * weights[(tap * image.channels + c) * bias.len() + o];
                    }
                }
            }
            out.data[i] = sum;
        }
        out
    }

    #[test]
    fn windows_pads_strides_and_odd_channels_are_as_defined() {
        let number = |i: usize| ((i * 7919 + 13) % 101) as f32 / 50.0 - 1.0;
        for (size, stride, pads, channels) in [
            ([1, 1], 1, [0; 4], 11),
            ([3, 3], 2, [0, 0, 1, 1], 24),
            ([2, 2], 1, [0; 4], 3),
            ([5, 3], 2, [2, 1, 2, 1], 8),
        ] {
            let mut image = Tensor::zeros(7, 9, 5);
            (0..image.data.len()).for_each(|i| image.data[i] = number(i));
            let weights: Vec<f32> = (0..size[0] * size[1] * 5 * channels).map(number).collect();
            let bias: Vec<f32> = (0..channels).map(number).collect();
            let window = Window { size, stride, pads };
            let got = Convolution::new(window, &weights, &bias, false).of(&image);
            assert_eq!(got, plain(&window, &image, &weights, &bias));
            let clamped = Convolution::new(window, &weights, &bias, true).of(&image);
            assert!(
                clamped
                    .data
                    .iter()
                    .zip(&got.data)
                    .all(|(h, g)| *h == g.clamp(0.0, 6.0))
            );
        }
    }
}
