//! The border of a cut between pixels: how much of each border pixel is body.
//!
//! A pixel on the border shows a mixture of body and background, `I = a F + (1 - a) B` (Porter and
//! Duff 1984), of light and not of levels: what is half bright and half dark has a level nearer to the
//! bright one. The body's light F is taken from beside it, the background B is known or, where nobody saw it,
//! taken from beside as well, and `a` follows. Where F and B are alike, the cut's own border is smoothed instead.

use crate::border::light::{Light, Mean, Mixing, Shown};
use crate::likelihood::background::Noise;
use crate::raster::as_mask;
use crate::scene::backdrop::{Backdrop, SHY};
use shape::{Image, Mask, Rgb};

/// Half the side of the neighbourhood in which the body's colour is sought. By hand: looked at scene 131 with a plate,
/// at 3 and 6: mean IoU +0.0006 and −0.0006. \[px\]
pub(crate) const REACH_PX: usize = 4;
/// Pixels this far from the border show one side only (derived: those nearer are not counted as background, either). \[px\]
pub(crate) const MIXED_PX: i32 = SHY as i32;
/// Body and background that differ by so much of the noise are believed as much as the cut's own border. By hand: looked at
/// scene 131 with a plate, at 0.7 and 1.4 of it: mean IoU −0.0001 and +0.0002.
const BELIEVED_NOISES: f32 = 8.0;

/// Coverage of every pixel: 0 or 255 but at the border, where it follows from colours; `without` is what was seen of the
/// background.
pub(crate) fn soft_border(
    photo: &Rgb,
    without: Option<&Backdrop>,
    sides: &Image<bool>,
    noise: Noise,
) -> Mask {
    let near = near_border(sides);
    let mut mask = smoothed(sides, &near);
    let light = Light::of_levels();
    let beside = Beside {
        photo,
        without,
        sides,
        near: &near,
        light: &light,
    };
    for y in 0..sides.height {
        for x in along(&near, y) {
            let smooth = mask.at(x, y);
            let Some((body, ground)) = beside.of(x, y) else {
                continue;
            };
            let Mixing { share, apart, .. } = light.mixing(photo, [x, y], body, ground);
            let trust = apart / (apart + (BELIEVED_NOISES * noise.still).powi(2));
            let mixed = trust * share * 255.0 + (1.0 - trust) * f32::from(smooth);
            *mask.at_mut(x, y) = mixed.round() as u8;
        }
    }
    mask
}

/// What is beside the border of a cut.
struct Beside<'a> {
    photo: &'a Rgb,
    without: Option<&'a Backdrop>,
    sides: &'a Image<bool>,
    /// Pixels that may show both sides.
    near: &'a Image<bool>,
    light: &'a Light,
}

impl Beside<'_> {
    /// The light of the body beside a border pixel, and that of the background there: as it was seen, under as much light
    /// as beside the pixel, or, where nobody saw it, as it is beside.
    fn of(&self, x: usize, y: usize) -> Option<(Shown, Shown)> {
        let (mut body, mut ground) = (Mean::default(), Mean::default());
        let (mut shown_seen, mut expected) = (0.0, 0.0);
        for row in y.saturating_sub(REACH_PX)..(y + REACH_PX + 1).min(self.sides.height) {
            for column in x.saturating_sub(REACH_PX)..(x + REACH_PX + 1).min(self.sides.width) {
                if self.near.at(column, row) {
                    continue;
                }
                let shown = self.light.at(self.photo, column, row);
                if self.sides.at(column, row) {
                    body.add(shown);
                    continue;
                }
                ground.add(shown);
                if let Some(seen) = self.seen(column, row) {
                    shown_seen += shown.iter().sum::<f32>();
                    expected += seen.iter().sum::<f32>();
                }
            }
        }
        let lit = if expected == 0.0 {
            1.0
        } else {
            shown_seen / expected
        };
        let seen = self.seen(x, y).map(|light| light.map(|c| c * lit));
        Some((body.mean()?, seen.or_else(|| ground.mean())?))
    }

    /// The light of the background at a pixel, where it was seen.
    fn seen(&self, x: usize, y: usize) -> Option<Shown> {
        let without = self.without.filter(|without| without.seen.at(x, y))?;
        Some(self.light.at(&without.image, x, y))
    }
}

/// Columns of the pixels of a row that may show both sides.
fn along(near: &Image<bool>, y: usize) -> impl Iterator<Item = usize> {
    let columns = near.row(y).iter().enumerate();
    columns.filter(|(_, near)| **near).map(|(x, _)| x)
}

/// Pixels that may show both sides.
fn near_border(sides: &Image<bool>) -> Image<bool> {
    let (w, h) = (sides.width, sides.height);
    let mut near = Image::filled(w, h, false);
    let mut grow = |x: usize, y: usize| {
        let (x, y) = (x as i32, y as i32);
        let columns = (x - MIXED_PX + 1).max(0) as usize..(x + MIXED_PX).min(w as i32) as usize;
        for ny in (y - MIXED_PX + 1).max(0)..(y + MIXED_PX).min(h as i32) {
            near.data[ny as usize * w..][columns.clone()].fill(true);
        }
    };
    for y in 0..h {
        let row = sides.row(y);
        for x in 1..w {
            if row[x - 1] != row[x] {
                grow(x - 1, y);
                grow(x, y);
            }
        }
        if y + 1 == h || row == sides.row(y + 1) {
            continue;
        }
        for x in 0..w {
            if row[x] != sides.at(x, y + 1) {
                grow(x, y);
                grow(x, y + 1);
            }
        }
    }
    near
}

/// Sides as coverage with a soft border: a 3 × 3 binomial filter, so that the border crosses half
/// coverage between the two pixels that differ.
pub(crate) fn coverage(sides: &Image<bool>) -> Mask {
    smoothed(sides, &near_border(sides))
}

/// The same where it is known which pixels are near the border: beyond, all nine are of one side.
fn smoothed(sides: &Image<bool>, near: &Image<bool>) -> Mask {
    let (w, h) = (sides.width, sides.height);
    let mut mask = as_mask(sides);
    for y in 0..h {
        for x in along(near, y) {
            let (mut sum, mut weight) = (0u32, 0u32);
            for (dy, wy) in [(-1i32, 1u32), (0, 2), (1, 1)] {
                for (dx, wx) in [(-1i32, 1u32), (0, 2), (1, 1)] {
                    let (nx, ny) = (x as i32 + dx, y as i32 + dy);
                    if nx >= 0 && ny >= 0 && nx < w as i32 && ny < h as i32 {
                        sum += u32::from(sides.at(nx as usize, ny as usize)) * wx * wy;
                        weight += wx * wy;
                    }
                }
            }
            *mask.at_mut(x, y) = (sum * 255 / weight) as u8;
        }
    }
    mask
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A disc of one level before another, drawn with 8 × 8 samples of light a pixel.
    fn disc(radius: f64, body: f64, wall: f64, dice: &mut proof::Dice) -> Rgb {
        let mut image = Rgb::filled(120, 120, [0; 3]);
        let light = |level: f64| f64::from(shape::light_of_level(level as f32));
        let level = |light: f64| f64::from(shape::level_of_light(light as f32));
        for (i, p) in image.data.iter_mut().enumerate() {
            let (x, y) = ((i % 120) as f64 - 59.3, (i / 120) as f64 - 59.8);
            let part = |s: i32| (f64::from(s) + 0.5) / 8.0 - 0.5;
            let inside = (0..64).filter(|s| libm::hypot(x + part(s % 8), y + part(s / 8)) < radius);
            let share = inside.count() as f64 / 64.0;
            let mixed = level(light(wall) + share * (light(body) - light(wall)));
            *p = [0, 1, 2].map(|_| (mixed + 1.5 * dice.normal()).round() as u8);
        }
        image
    }

    #[test]
    fn the_border_is_where_light_mixes_though_the_cut_is_a_pixel_wide() {
        let mut dice = proof::Dice(8);
        let (radius, noise) = (40.0, Noise::even(2.0));
        let area = |mask: &Mask| mask.data.iter().map(|c| f64::from(*c) / 255.0).sum::<f64>();
        let want = std::f64::consts::PI * radius * radius;
        let round = std::f64::consts::TAU * radius;
        for (body, wall) in [(190.0, 70.0), (70.0, 190.0), (120.0, 90.0)] {
            let photo = disc(radius, body, wall, &mut dice);
            // Every pixel with a trace of the body was cut out.
            let sides = photo.map(|p| (f64::from(p[1]) - wall).abs() > 8.0);
            let without = Backdrop::whole(Rgb::filled(120, 120, [wall as u8; 3]));
            let off = |without| (area(&soft_border(&photo, without, &sides, noise)) - want) / round;
            let cut = (area(&coverage(&sides)) - want) / round;
            let (seen, unseen) = (off(Some(&without)), off(None));
            assert!(
                cut > 0.2 && seen.abs() < 0.05 && unseen.abs() < 0.05,
                "{cut} px, then {seen} px, {unseen} px where nobody saw the wall"
            );
        }
    }
}
