//! Pictures at another size: smaller ones are means of areas, larger ones are read between pixels.

use crate::{Image, Mask, Rgb};

/// Photos are looked at with so many million pixels at most: more show no more of a body, and cost as much again
/// (structural: a cap on work).
pub const LOOKED_AT_MPX: f64 = 4.0;

/// Smaller pictures of all photos of a turn are kept where they take no more than this (structural: memory). \[bytes\]
pub(crate) const MAX_KEPT_BYTES: u64 = 300_000_000;

/// The size of a photo of a size that is looked at with so many million pixels at most. \[px\]
pub fn within([width, height]: [u32; 2], most_mpx: f64) -> [u32; 2] {
    let mpx = f64::from(width) * f64::from(height) / 1e6;
    let scale = (most_mpx / mpx).sqrt();
    match scale < 1.0 {
        true => [width, height].map(|n| ((f64::from(n) * scale) as u32).max(1)),
        false => [width, height],
    }
}

/// The pixels along one side that one pixel of a smaller picture covers: the first, and the share of each that is covered.
struct Span {
    first: usize,
    shares: Vec<f32>,
}

/// The spans of all pixels of a side of `to` pixels over one of `from`; the shares of each sum to 1.
fn spans(from: usize, to: usize) -> Vec<Span> {
    let span = |i: usize| {
        // In units of 1/to pixels, so that borders are exact.
        let (low, high) = (i * from, (i + 1) * from);
        let (first, last) = (low / to, high.div_ceil(to));
        let share = |p: usize| {
            let covered = high.min((p + 1) * to) - low.max(p * to);
            covered as f32 / from as f32
        };
        Span {
            first,
            shares: (first..last).map(share).collect(),
        }
    };
    (0..to).map(span).collect()
}

impl Rgb {
    /// At a smaller size, each pixel the mean of the area that it covers.
    pub fn shrunk(&self, width: usize, height: usize) -> Rgb {
        if (width, height) == (self.width, self.height) {
            return self.clone();
        }
        let columns = spans(self.width, width);
        let mut small = Rgb::filled(width, height, [0; 3]);
        let mut sums = vec![0.0f32; 3 * self.width];
        let rows = spans(self.height, height);
        for (row, to) in rows.iter().zip(small.data.chunks_mut(width)) {
            sums.fill(0.0);
            for (share, y) in row.shares.iter().zip(row.first..) {
                let from = self.row(y).as_flattened();
                let both = sums.iter_mut().zip(from);
                both.for_each(|(sum, level)| *sum += share * f32::from(*level));
            }
            for (column, to) in columns.iter().zip(to) {
                let mut mean = [0.5f32; 3];
                let pixels = sums[3 * column.first..].chunks(3);
                for (share, pixel) in column.shares.iter().zip(pixels) {
                    (0..3).for_each(|c| mean[c] += share * pixel[c]);
                }
                *to = mean.map(|level| level as u8);
            }
        }
        small
    }
}

impl Mask {
    /// At another size, read between pixels.
    pub fn resized(&self, width: usize, height: usize) -> Mask {
        if (width, height) == (self.width, self.height) || self.data.is_empty() {
            return self.clone();
        }
        let columns = between(self.width, width);
        let mut large = Image::filled(width, height, 0u8);
        let mut mixed = vec![0.0f32; self.width];
        let rows = between(self.height, height);
        for ((above, below, share), to) in rows.into_iter().zip(large.data.chunks_mut(width)) {
            let (a, b) = (self.row(above), self.row(below));
            if a == b && a.iter().all(|v| *v == a[0]) {
                to.fill(a[0]);
                continue;
            }
            let both = mixed.iter_mut().zip(a.iter().zip(b));
            both.for_each(|(mixed, (a, b))| {
                *mixed = f32::from(*a) + share * (f32::from(*b) - f32::from(*a));
            });
            for ((left, right, share), to) in columns.iter().zip(to) {
                let value = mixed[*left] + share * (mixed[*right] - mixed[*left]);
                *to = (value + 0.5) as u8;
            }
        }
        large
    }
}

/// For each of `to` pixels the two of `from` between whose middles its own is, and how near it is to the second.
fn between(from: usize, to: usize) -> Vec<(usize, usize, f32)> {
    let one = |i: usize| {
        let at = (i as f32 + 0.5) * from as f32 / to as f32 - 0.5;
        let at = at.clamp(0.0, (from - 1) as f32);
        let first = at as usize;
        (first, (first + 1).min(from - 1), at - first as f32)
    };
    (0..to).map(one).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_photo_has_no_more_pixels_than_are_looked_at() {
        for (size, smaller) in [
            ([1600, 2400], [1600, 2400]),
            ([4016, 6016], [1634, 2447]),
            ([8000, 1000], [5656, 707]),
        ] {
            assert_eq!(within(size, LOOKED_AT_MPX), smaller);
        }
    }

    #[test]
    fn a_smaller_picture_has_the_means_of_what_its_pixels_cover() {
        let colors = |i: usize| [(i * 7 % 250) as u8, (i % 11 * 20) as u8, 40];
        let large = Rgb {
            width: 24,
            height: 18,
            data: (0..24 * 18).map(colors).collect(),
        };
        assert_eq!(large.shrunk(12, 9), large.reduced(2));
        let odd = large.shrunk(17, 10);
        let sum = |image: &Rgb, c: usize| image.data.iter().map(|p| f64::from(p[c])).sum::<f64>();
        for c in 0..3 {
            let [mean, of_odd] = [&large, &odd].map(|i| sum(i, c) / i.data.len() as f64);
            assert!((mean - of_odd).abs() < 0.5, "{c}: {mean} {of_odd}");
        }
        // By hand: 3 pixels to 2, of 0, 90, 240: (0 + 90/2) / 1.5 and (90/2 + 240) / 1.5.
        let three = Rgb {
            width: 3,
            height: 1,
            data: [0, 90, 240].map(|v| [v; 3]).to_vec(),
        };
        assert_eq!(three.shrunk(2, 1).data, [[30; 3], [190; 3]]);
    }

    #[test]
    fn a_mask_that_was_made_smaller_comes_back_to_its_size_with_its_border_where_it_was() {
        // A disc, as each pixel's share of it.
        let disc = |size: usize, radius: f64| Mask {
            width: size,
            height: size,
            data: (0..size * size)
                .map(|i| {
                    let at = |k: usize| (k as f64 + 0.5) - size as f64 / 2.0;
                    let far = libm::hypot(at(i % size), at(i / size));
                    (255.0 * (radius - far + 0.5).clamp(0.0, 1.0)).round() as u8
                })
                .collect(),
        };
        let (small, large) = (disc(60, 20.0), disc(120, 40.0));
        let back = small.resized(120, 120);
        let area = |mask: &Mask| mask.data.iter().map(|v| f64::from(*v)).sum::<f64>() / 255.0;
        assert!((area(&back) / area(&large) - 1.0).abs() < 2e-3);
        let differ = |(a, b): (&u8, &u8)| (*a > 127) != (*b > 127);
        let differing = back.data.iter().zip(&large.data).filter(|p| differ(*p));
        let count = differing.count();
        assert!(count < 40, "{count} of 250 pixels at the border");
        assert_eq!(small.resized(60, 60), small);
    }
}
