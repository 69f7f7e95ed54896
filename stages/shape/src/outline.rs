//! How well a photo shows the outline of its mask, by how much colours differ on its two sides.

use crate::{Gray, Image, Mask, Rgb, signed_distance};

/// Photos are asked at a size of so many pixels at most, the one at which masks are first cut (structural). \[px\]
const LONGEST: usize = 800;
/// Pixels so near to the outline on either side, and no nearer, show one side each (structural: labels are no finer, and their border is mixed). \[px\]
const BESIDE: [f32; 2] = [1.0, 3.0];
/// How far along the outline they are taken together (structural: samples). \[px\]
const ALONG: usize = 3;
/// Standard deviation of an outline whose sides differ much in colour, as a share of the body's height, fitted with
/// [`HIDDEN`] and `SHOWN_LEVELS` on masks of captures drawn by a seed (91, 109, 127; `docs/tables/outlines.py`). On
/// 113 and 123 alone the three come to 0.00072, 0.00427 and 17.4.
pub const SHOWN: f64 = 0.0007;
/// What is added where both sides are of one colour, as a share of the body's height, fitted with [`SHOWN`].
pub const HIDDEN: f64 = 0.0043;
/// Sides that differ by so much add 1/e of that variance, fitted with [`SHOWN`]. \[levels\]
const SHOWN_LEVELS: f32 = 18.0;

/// The outline of a mask on its photo, both reduced alike.
#[derive(Debug, Clone, PartialEq)]
pub struct Outline {
    /// Width and height of the reduced photo. \[px\]
    pub size: [usize; 2],
    /// Pixels of the body that are beside background.
    pub places: Vec<Place>,
}

/// A pixel of an outline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Place {
    /// Column and row on the reduced photo.
    pub at: [usize; 2],
    /// How little the photo shows of it: 0 where its sides differ much in colour, 1 where they are alike. Its variance is
    /// `SHOWN² + hidden HIDDEN²`, as a share of the body's height squared.
    pub hidden: f32,
}

impl Outline {
    /// Pixels of a reduced photo, at most.
    pub const MOST_PIXELS: usize = LONGEST * LONGEST;

    /// Of a photo and its mask; [`None`] where they are not of one size.
    pub fn of(photo: &Rgb, mask: &Mask) -> Option<Outline> {
        if [photo.width, photo.height] != [mask.width, mask.height] {
            return None;
        }
        let by = mask.width.max(mask.height).div_ceil(LONGEST).max(1);
        let mask = mask.map(|v| f32::from(*v)).reduced(by);
        let mask = mask.map(|v| v.round() as u8);
        Some(Outline {
            size: [mask.width, mask.height],
            places: places(&photo.reduced(by), &mask),
        })
    }

    /// How little the photo shows of the outline near each pixel, the mean within two standard deviations of one that is
    /// hidden; 0 where there is none.
    pub fn hidden_near(&self) -> Gray {
        let near_px = (2.0 * HIDDEN * self.height()).ceil() as usize;
        let [width, height] = self.size;
        let sums = |of: &dyn Fn(&Place) -> f32| {
            let mut count = Image::filled(width, height, 0.0f32);
            for place in &self.places {
                *count.at_mut(place.at[0], place.at[1]) = of(place);
            }
            box_sums(&count, near_px)
        };
        let (hidden, all) = (sums(&|place| place.hidden), sums(&|_| 1.0));
        let mean = hidden.data.iter().zip(&all.data);
        Gray {
            width,
            height,
            data: mean
                .map(|(h, n)| (h / n.max(1.0)).clamp(0.0, 1.0))
                .collect(),
        }
    }

    /// From the first row with an outline to the last. \[px of the reduced photo\]
    pub fn height(&self) -> f64 {
        let rows = || self.places.iter().map(|place| place.at[1]);
        rows()
            .max()
            .map_or(0.0, |last| (last - rows().min().unwrap_or(last)) as f64)
    }
}

/// Sums over squares of `reach` pixels to each side.
fn box_sums(image: &Image<f32>, reach: usize) -> Image<f32> {
    let (width, height) = (image.width, image.height);
    let mut rows = Image::filled(width, height, 0.0f32);
    for y in 0..height {
        let mut sum: f32 = image.row(y)[..reach.min(width)].iter().sum();
        for x in 0..width {
            sum += image.row(y).get(x + reach).copied().unwrap_or(0.0);
            *rows.at_mut(x, y) = sum;
            sum -= x.checked_sub(reach).map_or(0.0, |x| image.at(x, y));
        }
    }
    let mut sums = Image::filled(width, height, 0.0f32);
    for x in 0..width {
        let mut sum: f32 = (0..reach.min(height)).map(|y| rows.at(x, y)).sum();
        for y in 0..height {
            sum += if y + reach < height {
                rows.at(x, y + reach)
            } else {
                0.0
            };
            *sums.at_mut(x, y) = sum;
            sum -= y.checked_sub(reach).map_or(0.0, |y| rows.at(x, y));
        }
    }
    sums
}

/// The pixels of the outline of a mask, each with how little its photo shows of it.
fn places(photo: &Rgb, mask: &Mask) -> Vec<Place> {
    let depth = signed_distance(mask);
    let (width, height) = (mask.width, mask.height);
    let inner = |v: usize, most: usize| v > ALONG && v + ALONG + 1 < most;
    let on = |i: &usize| {
        let (x, y) = (i % width, i / width);
        depth.data[*i] > 0.0 && depth.data[*i] <= 1.0 && inner(x, width) && inner(y, height)
    };
    let place = |i: usize| {
        let at = [i % width, i / width];
        let mut sides = [([0.0f32; 3], 0.0f32); 2];
        for y in at[1] - ALONG..=at[1] + ALONG {
            for x in at[0] - ALONG..=at[0] + ALONG {
                let deep = depth.at(x, y);
                if !(BESIDE[0]..=BESIDE[1]).contains(&deep.abs()) {
                    continue;
                }
                let (sum, count) = &mut sides[usize::from(deep > 0.0)];
                let color = photo.at(x, y);
                (0..3).for_each(|c| sum[c] += f32::from(color[c]));
                *count += 1.0;
            }
        }
        let [(out, outs), (body, bodies)] = sides;
        // Where one side is too narrow to be asked, the outline beside it decides.
        let off = (0..3).map(|c| (out[c] / outs - body[c] / bodies).abs());
        let hidden = match outs > 0.0 && bodies > 0.0 {
            true => libm::expf(-(off.fold(0.0, f32::max) / SHOWN_LEVELS).powi(2)),
            false => 0.0,
        };
        Place { at, hidden }
    };
    (0..width * height).filter(on).map(place).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A post in the middle, before a wall that on the left has nearly the post's colour.
    fn post(off: u8) -> Outline {
        let body = |i: usize| (40..80).contains(&(i % 120));
        let color = |i: usize| match (body(i), i % 120 < 60) {
            (true, _) => [140; 3],
            (false, true) => [140, 140, 140 - off],
            (false, false) => [60, 140, 140],
        };
        let (photo, mask) = (Rgb::filled(120, 100, [0; 3]), Mask::filled(120, 100, 0));
        let photo = Rgb {
            data: (0..120 * 100).map(color).collect(),
            ..photo
        };
        let cover = |i: usize| if body(i) { 255 } else { 0 };
        let mask = Mask {
            data: (0..120 * 100).map(cover).collect(),
            ..mask
        };
        Outline::of(&photo, &mask).expect("one size")
    }

    #[test]
    fn an_outline_is_hidden_by_how_little_colours_beside_it_differ() {
        let mut before = 1.01;
        for off in [0, 6, 18, 36] {
            let places = post(off).places;
            let want = libm::expf(-(f32::from(off) / SHOWN_LEVELS).powi(2));
            let (left, right): (Vec<Place>, Vec<Place>) = places.iter().partition(|p| p.at[0] < 60);
            assert!(left.len() > 80 && right.len() > 80);
            assert!(left.iter().all(|p| (p.hidden - want).abs() < 1e-6));
            assert!(right.iter().all(|p| p.hidden < 1e-6));
            assert!(want < before);
            before = want;
        }
        assert!(Outline::of(&Rgb::filled(9, 9, [0; 3]), &Mask::filled(9, 8, 0)).is_none());
    }

    #[test]
    fn near_a_pixel_it_is_the_mean_of_the_outline_there() {
        let outline = post(6);
        let near = outline.hidden_near();
        let reach = libm::ceil(2.0 * HIDDEN * outline.height()) as usize;
        assert!(reach > 0);
        for at in [[39, 50], [41, 10], [60, 50], [80, 97], [0, 0]] {
            let close = |p: &&Place| (0..2).all(|i| p.at[i].abs_diff(at[i]) <= reach);
            let here: Vec<f32> = outline
                .places
                .iter()
                .filter(close)
                .map(|p| p.hidden)
                .collect();
            let want = here.iter().sum::<f32>() / here.len().max(1) as f32;
            assert!((near.at(at[0], at[1]) - want).abs() < 1e-5, "{at:?}");
        }
    }

    #[test]
    fn sums_over_squares_are_those_of_a_plain_loop() {
        let mut dice = proof::Dice(5);
        let mut image = Image::filled(13, 9, 0.0f32);
        image.data.iter_mut().for_each(|v| *v = dice.unit() as f32);
        for reach in [0, 1, 3, 20] {
            let sums = box_sums(&image, reach);
            for (x, y) in (0..9).flat_map(|y| (0..13).map(move |x| (x, y))) {
                let near = |at: usize, to: usize| at.abs_diff(to) <= reach;
                let all = (0..13 * 9).filter(|i| near(i % 13, x) && near(i / 13, y));
                let want: f32 = all.map(|i| image.data[i]).sum();
                assert!((sums.at(x, y) - want).abs() < 1e-4, "{x} {y} {reach}");
            }
        }
    }
}
