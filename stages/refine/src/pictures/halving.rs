//! Photos and silhouettes at half their size, and half of that.

use shape::{Gray, Mask};

/// Half the size, by the binomial kernel [1 3 3 1]/8; pixel centres as in [`shape::Intrinsics::resized`].
pub fn halved(image: &Gray) -> Gray {
    let (w, h) = ((image.width / 2).max(1), (image.height / 2).max(1));
    let mut rows = Gray::filled(w, image.height, 0.0);
    let clamp = |i: isize, n: usize| i.clamp(0, n as isize - 1) as usize;
    for y in 0..image.height {
        let row = image.row(y);
        for x in 0..w {
            let at = |d: isize| row[clamp(2 * x as isize + d, image.width)];
            *rows.at_mut(x, y) = (at(-1) + at(2) + 3.0 * (at(0) + at(1))) / 8.0;
        }
    }
    let mut out = Gray::filled(w, h, 0.0);
    for y in 0..h {
        let row = |d: isize| rows.row(clamp(2 * y as isize + d, image.height));
        let (a, b, c, d) = (row(-1), row(0), row(1), row(2));
        for x in 0..w {
            *out.at_mut(x, y) = (a[x] + d[x] + 3.0 * (b[x] + c[x])) / 8.0;
        }
    }
    out
}

/// A silhouette with pixels as large as `step` by `step` of its own, each covered as they are on average.
pub(crate) fn coarser(mask: &Mask, step: usize) -> Mask {
    if step == 1 {
        return mask.clone();
    }
    let (width, height) = (mask.width / step, mask.height / step);
    let pixels = (step * step) as u32;
    let mut out = Mask::filled(width, height, 0);
    let mut sums = vec![0u32; width];
    for (y, to) in out.data.chunks_mut(width).enumerate() {
        sums.fill(0);
        for row in (y * step..(y + 1) * step).map(|y| mask.row(y)) {
            let blocks = row.chunks_exact(step).zip(&mut sums);
            blocks
                .for_each(|(block, sum)| *sum += block.iter().map(|c| u32::from(*c)).sum::<u32>());
        }
        let means = sums.iter().map(|sum| ((sum + pixels / 2) / pixels) as u8);
        to.iter_mut().zip(means).for_each(|(to, mean)| *to = mean);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn halving_keeps_a_ramp_where_it_is() {
        let ramp = |w: usize, h: usize, f: &dyn Fn(f32, f32) -> f32| {
            let data = (0..w * h).map(|i| f((i % w) as f32, (i / w) as f32));
            Gray {
                width: w,
                height: h,
                data: data.collect(),
            }
        };
        let half = halved(&ramp(40, 60, &|x, y| 2.0 * x - y));
        let expected = ramp(20, 30, &|x, y| 2.0 * (2.0 * x + 0.5) - (2.0 * y + 0.5));
        for y in 1..29 {
            for x in 1..19 {
                assert!((half.at(x, y) - expected.at(x, y)).abs() < 1e-4);
            }
        }
    }

    #[test]
    fn a_coarser_silhouette_covers_as_much() {
        let mut mask = Mask::filled(9, 6, 0);
        for (x, y) in [(0, 0), (1, 0), (2, 1), (3, 1), (7, 5)] {
            *mask.at_mut(x, y) = 255;
        }
        let half = coarser(&mask, 2);
        assert_eq!((half.width, half.height), (4, 3));
        assert_eq!(half.data, [128, 128, 0, 0, 0, 0, 0, 0, 0, 0, 0, 64]);
        assert_eq!(coarser(&mask, 1), mask);
    }
}
