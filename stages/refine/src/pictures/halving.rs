//! Photos at half their size.

use shape::Gray;

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
}
