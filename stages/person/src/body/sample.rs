//! A square of a photo in few pixels.

use nalgebra::Point2;
use shape::{Crop, Found, Rgb};
use stage::machine::widest;

/// Around whoever is painted over so many of the network's pixels go, too: derived from how right its outline is ([`Found::pixel_px`]).
const BESIDE: f32 = 2.0;

/// The colours of the square in `side` × `side` pixels, 0 to 255, each the mean of what is in it; black outside of the
/// photo.
pub(super) fn sampled(photo: &Rgb, crop: &Crop, side: usize) -> Vec<f32> {
    widest(
        #[inline(always)]
        || means(photo, crop, side),
    )
}

#[inline(always)]
fn means(photo: &Rgb, crop: &Crop, side: usize) -> Vec<f32> {
    // Bilinear samples at most two photo pixels apart weigh each pixel alike.
    let pixel_px = crop.side_px / side as f32;
    let across = ((pixel_px / 2.0).ceil() as usize).max(1);
    let step = 1.0 / (side * across) as f32;
    let origin = crop.on_photo([step / 2.0, step / 2.0]);
    let (right, down) = (crop.on_photo([1.0, 0.0]), crop.on_photo([0.0, 1.0]));
    let corner = crop.on_photo([0.0, 0.0]);
    let along = |to: [f32; 2]| [(to[0] - corner[0]) * step, (to[1] - corner[1]) * step];
    let (right, down) = (along(right), along(down));
    let count = (across * across) as f32;
    let mut samples = Vec::with_capacity(side * side * 3);
    for y in 0..side {
        for x in 0..side {
            let mut sum = [0.0f32; 3];
            for j in y * across..(y + 1) * across {
                for i in x * across..(x + 1) * across {
                    let (i, j) = (i as f32, j as f32);
                    let at = [
                        origin[0] + i * right[0] + j * down[0],
                        origin[1] + i * right[1] + j * down[1],
                    ];
                    let colour = bilinear(photo, at);
                    (0..3).for_each(|c| sum[c] += colour[c]);
                }
            }
            samples.extend(sum.map(|v| v / count));
        }
    }
    samples
}

/// The same with people painted over: along each row from what is left of them to what is right.
pub(super) fn sampled_without(photo: &Rgb, crop: &Crop, side: usize, hidden: &[Found]) -> Vec<f32> {
    let mut samples = sampled(photo, crop, side);
    if hidden.is_empty() {
        return samples;
    }
    let covered = covered(crop, side, hidden);
    for (row, covered) in samples.chunks_mut(3 * side).zip(covered.chunks(side)) {
        let mut x = 0;
        while let Some(start) = (x..side).find(|x| covered[*x]) {
            let end = (start..side).find(|x| !covered[*x]).unwrap_or(side);
            let color = |x: usize| -> [f32; 3] { std::array::from_fn(|c| row[3 * x + c]) };
            let left = start.checked_sub(1).map(color);
            let right = (end < side).then(|| color(end));
            let [left, right] = [left.or(right), right.or(left)].map(Option::unwrap_or_default);
            for x in start..end {
                let part = (x + 1 - start) as f32 / (end + 1 - start) as f32;
                (0..3).for_each(|c| row[3 * x + c] = left[c] + part * (right[c] - left[c]));
            }
            x = end;
        }
    }
    samples
}

/// Which pixels of the square show one of these people, or are beside one.
fn covered(crop: &Crop, side: usize, hidden: &[Found]) -> Vec<bool> {
    let mut covered = vec![false; side * side];
    for found in hidden {
        let reach = (BESIDE * found.pixel_px() * side as f32 / crop.side_px).ceil() as usize;
        let body = |i: &usize| {
            let at = |v: usize| (v as f32 + 0.5) / side as f32;
            let [x, y] = crop.on_photo([at(i % side), at(i / side)]);
            let odds = found.log_odds(Point2::new(f64::from(x), f64::from(y)));
            odds.is_some_and(|odds| odds > 0.0)
        };
        for i in (0..side * side).filter(body) {
            let (x, y) = (i % side, i / side);
            let columns = x.saturating_sub(reach)..(x + reach + 1).min(side);
            for y in y.saturating_sub(reach)..(y + reach + 1).min(side) {
                covered[y * side..][columns.clone()].fill(true);
            }
        }
    }
    covered
}

/// The colour between pixels; black outside.
#[inline(always)]
fn bilinear(photo: &Rgb, [x, y]: [f32; 2]) -> [f32; 3] {
    let (width, height) = (photo.width as f32, photo.height as f32);
    if !(x > -1.0 && y > -1.0 && x < width && y < height) {
        return [0.0; 3];
    }
    let (left, top) = (x.floor(), y.floor());
    let (fx, fy) = (x - left, y - top);
    let (left, top) = (left as isize, top as isize);
    let colour = |x: isize, y: isize| -> [f32; 3] {
        let inside = x >= 0 && y >= 0 && (x as usize) < photo.width && (y as usize) < photo.height;
        match inside {
            true => photo.at(x as usize, y as usize).map(f32::from),
            false => [0.0; 3],
        }
    };
    let (a, b) = (colour(left, top), colour(left + 1, top));
    let (c, d) = (colour(left, top + 1), colour(left + 1, top + 1));
    std::array::from_fn(|k| {
        let upper = a[k] + fx * (b[k] - a[k]);
        let lower = c[k] + fx * (d[k] - c[k]);
        upper + fy * (lower - upper)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_square_is_the_mean_of_its_pixels_and_black_outside() {
        let mut photo = Rgb::filled(64, 32, [0; 3]);
        for (i, pixel) in photo.data.iter_mut().enumerate() {
            *pixel = [(i % 64 * 4) as u8, (i / 64 * 8) as u8, 200];
        }
        let crop = Crop {
            centre_px: [31.5, 15.5],
            side_px: 64.0,
            angle: 0.0,
        };
        let small = sampled(&photo, &crop, 16);
        let at = |x: usize, y: usize| &small[(y * 16 + x) * 3..][..3];
        assert_eq!(at(3, 2), [0.0; 3]);
        // Four by four pixels from column 12 and row 8 on.
        let want = [4.0 * 13.5, 8.0 * 9.5, 200.0];
        assert!(
            at(3, 6).iter().zip(want).all(|(a, b)| (a - b).abs() < 0.01),
            "{:?}",
            at(3, 6)
        );
        let turned = Crop {
            angle: std::f32::consts::PI,
            ..crop
        };
        let turned = sampled(&photo, &turned, 16);
        let same = (0..16 * 16).all(|i| {
            let (a, b) = (&small[i * 3..][..3], &turned[(255 - i) * 3..][..3]);
            a.iter().zip(b).all(|(a, b)| (a - b).abs() < 0.1)
        });
        assert!(same);
    }
}
