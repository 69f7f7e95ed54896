//! How well a pixel is explained by the background: negative log likelihoods.

use crate::likelihood::grounds::DARKEST_LIGHTS;
pub(crate) use crate::likelihood::grounds::Ground;
use crate::likelihood::neighbourhoods::{box_means, least_around};
pub(crate) use crate::likelihood::noise::FLAT;
pub use crate::likelihood::noise::Noise;
use crate::likelihood::noise::{Cast, SHADED_LIGHT};
use shape::Rgb;

/// How far an edge of the background may move. By hand: looked at 0 in its place (docs/lab/masks.md): mean IoU −0.0007
/// on two scenes without a plate, +0.0001 on three with one. \[px\]
const SLACK_PX: f32 = 0.4;
/// A pixel that the background explains worse than by so much is not it, however much worse. By hand: looked at scenes
/// 131 with a plate and 132 without, at 0.7 and 1.4 of it: mean IoU at most −0.0032 (waist 1.8 %) and +0.0000. \[nats\]
pub(crate) const CAP: f32 = 24.0;
/// What the noise grows by where the disk is all dark. By hand: looked at 0 in its place (docs/lab/masks.md): +0.0001
/// on two scenes, their least photos −0.0008 without a plate. \[levels\]
const THROWN_LEVELS: f32 = 10.0;
/// Share of a background's neighbourhoods whose light the subject changes, by a shadow or by what it throws back. By
/// hand: looked at renders of three backgrounds, where none was, and photos, where some are.
const SHADED_SHARE: f32 = 0.1;
/// The most light of any of them with what the subject throws back, as a share of its own. By hand: looked at scenes
/// 131 with a plate and 132 without, at 1.02 and 1.46: mean IoU at most +0.0004 and +0.0008.
const BRIGHTEST_LIGHT: f32 = 1.04;
/// What it would cost that a shadow takes all light from the floor or the disk; of a part of it, that part. By hand:
/// looked at scenes 131 with a plate and 132 without, at 0.7 and 1.4 of it: mean IoU at most −0.0000 and +0.0001.
/// \[nats\]
const SHADOW_NATS: f32 = 7.0;

/// -ln p(pixel | background) of the pixels of a rectangle (left, top, width, height), row-major, up to
/// a constant that noise changes (`Noise::thinner`).
///
/// The pixel may match what is expected there, or be part of the way (`SLACK_PX`) towards the
/// darkest and brightest of its eight neighbours (edges move by a part of a pixel), as it is or
/// with its light changed as far as the ground there allows. One pixel may match by chance: the
/// means of a neighbourhood (`reach` pixels to each side) that it belongs to must match, too, in a light that
/// changes no more than neighbourhoods of this photo do (`Noise::light`) or, one time in ten, by a shadow.
pub(crate) fn background_cost(
    photo: &Rgb,
    expected: &Rgb,
    noise: Noise,
    ground: &dyn Fn(usize, usize) -> Ground,
    reach: usize,
    rectangle: [usize; 4],
) -> Vec<f32> {
    let likeness = Likeness {
        photo,
        expected,
        noise,
        ground,
        reach,
    };
    likeness.cost_where(rectangle, &|_, _| true)
}

/// A photo and the background that is expected of it.
pub(crate) struct Likeness<'a> {
    pub(crate) photo: &'a Rgb,
    pub(crate) expected: &'a Rgb,
    pub(crate) noise: Noise,
    pub(crate) ground: &'a dyn Fn(usize, usize) -> Ground,
    /// Half the side of neighbourhoods. \[px\]
    pub(crate) reach: usize,
}

impl Likeness<'_> {
    /// As [`background_cost`], of the pixels that are wanted; of no meaning elsewhere.
    pub(crate) fn cost_where(
        &self,
        [left, top, width, height]: [usize; 4],
        wanted: &dyn Fn(usize, usize) -> bool,
    ) -> Vec<f32> {
        let (photo, expected, reach) = (self.photo, self.expected, self.reach);
        // Windows that hold a pixel of the rectangle reach so far beyond it.
        let margin = 2 * reach;
        let (x0, y0) = (left.saturating_sub(margin), top.saturating_sub(margin));
        let (x1, y1) = (
            (left + width + margin).min(photo.width),
            (top + height + margin).min(photo.height),
        );
        let wide = x1 - x0;
        let places = || (y0..y1).flat_map(|y| (x0..x1).map(move |x| (x, y)));
        let inside = |x: usize, y: usize| {
            (left..left + width).contains(&x) && (top..top + height).contains(&y)
        };
        // 0 where wanted, and then, spread, where a mean is.
        let missing = |(x, y)| f32::from(u8::from(!(inside(x, y) && wanted(x, y))));
        let wanted: Vec<f32> = places().map(missing).collect();
        let asked = least_around(&wanted, wide, reach);
        let area = [x0, y0, x1, y1];
        let (photo_means, expected_means) = (
            box_means(photo, area, reach),
            box_means(expected, area, reach),
        );
        let mut means = vec![f32::MAX; asked.len()];
        let mut single = vec![0.0; asked.len()];
        for (i, (x, y)) in places().enumerate().filter(|(i, _)| asked[*i] == 0.0) {
            let on = (self.ground)(x, y);
            let mean = expected_means[i];
            let light = Light {
                on,
                spread: self.noise.light,
                cast: self.noise.cast,
            };
            means[i] = cost(photo_means[i], mean, mean, light, self.noise.bounced(on));
            if wanted[i] == 0.0 {
                single[i] = self.single(x, y, on);
            }
        }
        let best = least_around(&means, wide, reach);
        let within = places().enumerate().filter(|(_, (x, y))| inside(*x, *y));
        within.map(|(i, _)| single[i].max(best[i])).collect()
    }

    /// -ln p(pixel | background) by the pixel's own colour, on the ground that is there.
    pub(crate) fn single(&self, x: usize, y: usize, on: Ground) -> f32 {
        let (lo, hi) = slack(self.expected, x, y);
        let shown = self.photo.at(x, y).map(f32::from);
        // The spread of light is that of means; one pixel's is mostly noise.
        let light = Light {
            on,
            spread: SHADED_LIGHT,
            cast: self.noise.cast,
        };
        cost(shown, lo, hi, light, self.noise.on(on))
    }
}

/// What a pixel may be when edges move by a part of a pixel: darkest and brightest.
pub(crate) fn slack(expected: &Rgb, x: usize, y: usize) -> ([f32; 3], [f32; 3]) {
    let (mut lo, mut hi) = ([255u8; 3], [0u8; 3]);
    let columns = x.saturating_sub(1)..(x + 2).min(expected.width);
    for row in y.saturating_sub(1)..(y + 2).min(expected.height) {
        for p in &expected.row(row)[columns.clone()] {
            for c in 0..3 {
                (lo[c], hi[c]) = (lo[c].min(p[c]), hi[c].max(p[c]));
            }
        }
    }
    let middle = expected.at(x, y).map(f32::from);
    let towards = |end: [u8; 3]| {
        let part = |c: usize| middle[c] + SLACK_PX * (f32::from(end[c]) - middle[c]);
        [part(0), part(1), part(2)]
    };
    (towards(lo), towards(hi))
}

/// The cost of a change of the background's light with spread `sigma`, or [`SHADED_LIGHT`] where the subject changes it.
fn price_of_light(change: f32, sigma: f32) -> f32 {
    let half_square = |sigma: f32| (change / sigma) * (change / sigma) / 2.0;
    match sigma < SHADED_LIGHT {
        true => {
            let seldom = (1.0 - SHADED_SHARE) / SHADED_SHARE * SHADED_LIGHT / sigma;
            half_square(sigma).min(half_square(SHADED_LIGHT) + libm::logf(seldom))
        }
        false => half_square(SHADED_LIGHT),
    }
}

/// How light may change on a ground.
#[derive(Clone, Copy)]
struct Light {
    on: Ground,
    /// Its spread on a wall.
    spread: f32,
    /// Shadows that a lamp casts on walls.
    cast: Option<Cast>,
}

impl Light {
    /// The least there is.
    fn darkest(&self) -> f32 {
        let least = DARKEST_LIGHTS[self.on as usize];
        let cast = self.cast.filter(|_| self.on == Ground::Wall);
        cast.map_or(least, |cast| cast.darkest.min(least))
    }

    /// What a change costs.
    fn price(&self, change: f32) -> f32 {
        if self.on != Ground::Wall {
            return SHADOW_NATS * change;
        }
        let usual = price_of_light(change, self.spread);
        self.cast
            .map_or(usual, |cast| usual.min(cast.price(self.spread)))
    }
}

/// The cost of a colour against a box of colours, as it is or in a light.
fn cost(p: [f32; 3], lo: [f32; 3], hi: [f32; 3], in_light: Light, sigma: f32) -> f32 {
    let on = in_light.on;
    let beyond = |light: f32| -> f32 {
        (0..3)
            .map(|c| (lo[c] * light - p[c]).max(p[c] - hi[c] * light).max(0.0))
            .map(|d| d * d)
            .sum::<f32>()
            / 2.0
    };
    // The light that explains the pixel best, by its brightness.
    let sum = |c: [f32; 3]| c.iter().sum::<f32>() + 3.0;
    let ratio = sum(p) / ((sum(lo) + sum(hi)) / 2.0);
    let light = ratio.clamp(in_light.darkest(), BRIGHTEST_LIGHT);
    let price = in_light.price((light - 1.0).abs());
    // The darker a shadow on the disk, the more of what is left there the subject's colour throws back.
    let thrown = match on {
        Ground::Disk => THROWN_LEVELS * (1.0 - light).max(0.0),
        _ => 0.0,
    };
    let bright = beyond(1.0) / (sigma * sigma);
    let shaded = beyond(light) / ((sigma + thrown) * (sigma + thrown));
    bright.min(shaded + price).min(CAP) + FLAT
}

#[cfg(test)]
mod tests {
    use super::*;

    fn noisy(level: f64, sigma: f64, dice: &mut proof::Dice) -> Rgb {
        let mut image = Rgb::filled(80, 60, [0; 3]);
        for p in &mut image.data {
            *p = [0, 1, 2].map(|_| (level + sigma * dice.normal()).round() as u8);
        }
        image
    }

    #[test]
    fn a_shirt_nearly_as_dark_as_the_wall_is_no_wall() {
        let mut dice = proof::Dice(4);
        let plate = Rgb::filled(80, 60, [170, 166, 154]);
        let photo = noisy(160.0, 1.0, &mut dice);
        let noise = Noise::even(2.0);
        let all = [0, 0, 80, 60];
        let cost = background_cost(&photo, &plate, noise, &|_, _| Ground::Wall, 1, all);
        let mean = cost.iter().sum::<f32>() / cost.len() as f32;
        assert!(mean > FLAT + 5.0, "{mean}");
        // The wall itself, and the floor in a shadow of the same colour.
        let wall = background_cost(&plate, &plate, noise, &|_, _| Ground::Wall, 1, all);
        assert!(wall.iter().all(|c| *c == FLAT));
        let dark = Rgb::filled(80, 60, [119, 116, 108]);
        let shadow = background_cost(&dark, &plate, noise, &|_, _| Ground::Floor, 1, all);
        assert!(shadow.iter().all(|c| *c < FLAT + 3.0));
    }
}
