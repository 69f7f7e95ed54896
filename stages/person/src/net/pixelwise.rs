//! Operators without weights.

use super::tensor::Tensor;

/// Two images added, clamped to 0 to 6 where `relu6`.
pub(super) fn add(a: &Tensor, b: &Tensor, relu6: bool) -> Tensor {
    let sum = |(a, b): (&f32, &f32)| match relu6 {
        true => (a + b).clamp(0.0, 6.0),
        false => a + b,
    };
    Tensor {
        data: a.data.iter().zip(&b.data).map(sum).collect(),
        ..*a
    }
}

/// The largest of each two by two pixels; height and width are even.
pub(super) fn max_pool(image: &Tensor) -> Tensor {
    let mut out = Tensor::zeros(image.height / 2, image.width / 2, image.channels);
    for y in 0..out.height {
        for x in 0..out.width {
            let four = [(0, 0), (1, 0), (0, 1), (1, 1)];
            let four = four.map(|(dx, dy)| image.pixel(2 * x + dx, 2 * y + dy));
            for (c, to) in out.pixel_mut(x, y).iter_mut().enumerate() {
                *to = four[1..].iter().fold(four[0][c], |most, p| most.max(p[c]));
            }
        }
    }
    out
}

/// Twice as high and wide, bilinear, the centres of pixels at halves.
pub(super) fn doubled(image: &Tensor) -> Tensor {
    let mut out = Tensor::zeros(2 * image.height, 2 * image.width, image.channels);
    // The two pixels that a pixel of the output is between, and how far behind the first.
    let between = |at: usize, n: usize| match at.is_multiple_of(2) {
        true => ((at / 2).saturating_sub(1), at / 2, 0.75),
        false => (at / 2, (at / 2 + 1).min(n - 1), 0.25),
    };
    for y in 0..out.height {
        let (y0, y1, fy) = between(y, image.height);
        for x in 0..out.width {
            let (x0, x1, fx) = between(x, image.width);
            let (a, b) = (image.pixel(x0, y0), image.pixel(x1, y0));
            let (c, d) = (image.pixel(x0, y1), image.pixel(x1, y1));
            for (k, to) in out.pixel_mut(x, y).iter_mut().enumerate() {
                let top = a[k] * (1.0 - fx) + b[k] * fx;
                let bottom = c[k] * (1.0 - fx) + d[k] * fx;
                *to = top * (1.0 - fy) + bottom * fy;
            }
        }
    }
    out
}

/// A quarter of the channels, each quarter to one of two by two pixels.
pub(super) fn to_space(image: &Tensor) -> Tensor {
    let channels = image.channels / 4;
    let mut out = Tensor::zeros(2 * image.height, 2 * image.width, channels);
    for y in 0..out.height {
        for x in 0..out.width {
            let quarter = (y % 2 * 2 + x % 2) * channels;
            let from = &image.pixel(x / 2, y / 2)[quarter..quarter + channels];
            out.pixel_mut(x, y).copy_from_slice(from);
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn operators_without_weights_are_as_defined() {
        let image = Tensor {
            height: 2,
            width: 2,
            channels: 1,
            data: vec![0.0, 4.0, 8.0, 12.0],
        };
        assert_eq!(add(&image, &image, true).data, [0.0, 6.0, 6.0, 6.0]);
        assert_eq!(add(&image, &image, false).data, [0.0, 8.0, 16.0, 24.0]);
        assert_eq!(max_pool(&image).data, [12.0]);
        let large = doubled(&image);
        assert_eq!(large.data[..4], [0.0, 1.0, 3.0, 4.0]);
        assert_eq!(large.data[4..8], [2.0, 3.0, 5.0, 6.0]);
        assert_eq!(large.data[12..], [8.0, 9.0, 11.0, 12.0]);
        let deep = Tensor {
            height: 1,
            width: 1,
            channels: 4,
            data: vec![1.0, 2.0, 3.0, 4.0],
        };
        let wide = to_space(&deep);
        assert_eq!((wide.height, wide.width, wide.channels), (2, 2, 1));
        assert_eq!(wide.data, [1.0, 2.0, 3.0, 4.0]);
    }
}
