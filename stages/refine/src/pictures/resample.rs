//! An image drawn anew, each of its pixels read elsewhere in another.

use shape::Image;
use stage::machine::widest;

/// Pixels that are read side by side (structural: speed alone).
const LANES: usize = 8;

/// Draws an image of this size: `place` gives for a row where its pixels are read in `image`, columns and rows \[px\],
/// and `write` makes of what is read there what is kept. Each is read as [`Image::sample`] does, byte for byte.
pub fn resampled<T: Copy, U: Copy>(
    image: &Image<T>,
    (width, height): (usize, usize),
    write: impl Fn(f32) -> U,
    place: impl Fn(usize, &mut [f32], &mut [f32]),
) -> Image<U>
where
    f32: From<T>,
{
    let mut out = Image::filled(width, height, write(0.0));
    let (mut columns, mut rows) = (vec![0.0f32; width], vec![0.0f32; width]);
    for y in 0..height {
        let to = &mut out.data[y * width..(y + 1) * width];
        widest(
            #[inline(always)]
            || {
                place(y, &mut columns, &mut rows);
                read(image, &columns, &rows, &write, to);
            },
        );
    }
    out
}

/// Reads an image at places.
#[inline(always)]
fn read<T: Copy, U>(
    image: &Image<T>,
    columns: &[f32],
    rows: &[f32],
    write: impl Fn(f32) -> U,
    to: &mut [U],
) where
    f32: From<T>,
{
    let (wide, tall) = (image.width as i32, image.height as i32);
    let most = [wide, tall].map(|n| (n - 1) as f32);
    let whole = to.len() / LANES * LANES;
    for k in (0..whole).step_by(LANES) {
        let (mut at, mut right, mut down) = ([0i32; LANES], [0i32; LANES], [0i32; LANES]);
        let (mut fx, mut fy) = ([0.0f32; LANES], [0.0f32; LANES]);
        for l in 0..LANES {
            let (x, y) = (
                columns[k + l].clamp(0.0, most[0]),
                rows[k + l].clamp(0.0, most[1]),
            );
            let (x0, y0) = (x as i32, y as i32);
            (fx[l], fy[l]) = (x - x0 as f32, y - y0 as f32);
            at[l] = y0 * wide + x0;
            right[l] = i32::from(x0 + 1 < wide);
            down[l] = i32::from(y0 + 1 < tall) * wide;
        }
        let mut corners = [[0.0f32; LANES]; 4];
        for l in 0..LANES {
            let [a, b] = [at[l], at[l] + down[l]].map(|i| i as usize);
            let beside = right[l] as usize;
            let read = |i: usize| f32::from(image.data[i]);
            (corners[0][l], corners[1][l]) = (read(a), read(a + beside));
            (corners[2][l], corners[3][l]) = (read(b), read(b + beside));
        }
        for l in 0..LANES {
            let [tl, tr, bl, br] = [corners[0][l], corners[1][l], corners[2][l], corners[3][l]];
            let (top, bottom) = (tl + fx[l] * (tr - tl), bl + fx[l] * (br - bl));
            to[k + l] = write(top + fy[l] * (bottom - top));
        }
    }
    for k in whole..to.len() {
        to[k] = write(image.sample(columns[k], rows[k]));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_pixel_is_read_as_a_single_one_is() {
        let mut dice = proof::Dice(4);
        let (width, height) = (37, 23);
        let data = (0..width * height).map(|_| dice.within(0.0, 255.0) as f32);
        let image = shape::Gray {
            width,
            height,
            data: data.collect(),
        };
        let places: Vec<[f32; 2]> = (0..31 * 19)
            .map(|k| match k {
                // On the last column and row, and beyond every side.
                0 => [36.0, 22.0],
                1 => [-3.0, 22.5],
                _ => [
                    dice.within(-4.0, 41.0) as f32,
                    dice.within(-4.0, 27.0) as f32,
                ],
            })
            .collect();
        let out = resampled(
            &image,
            (31, 19),
            |v| v,
            |y, columns, rows| {
                for x in 0..31 {
                    [columns[x], rows[x]] = places[y * 31 + x];
                }
            },
        );
        for (pixel, [x, y]) in out.data.iter().zip(places) {
            assert_eq!(*pixel, image.sample(x, y), "at {x}, {y}");
        }
    }
}
