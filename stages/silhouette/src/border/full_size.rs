//! The border of a coarse cut, cut again at full size.

use crate::border::narrow_gaps::follow;
use crate::border::soft_border::soft_border;
use crate::border::tiles::{band, cut_again, of_small, settled, tiles};
use crate::cut::least_cut::{Known, Window};
use crate::label::color_cut::{Settings, cut};
use crate::likelihood::background::{FLAT, Likeness, Noise};
use crate::likelihood::gmm::Gmm;
use crate::likelihood::grounds::Grounds;
use crate::likelihood::mirror::mirroring;
use crate::likelihood::prepared::{Prepared, UNSEEN};
use crate::scene::backdrop::Backdrop;
use shape::{Image, Mask, Rgb, largest_part};
use std::ops::Range;

/// Half the side of neighbourhoods. By hand: looked at scene 131 with a plate, at 1 and 3: mean IoU +0.0002 and
/// −0.0001, its waist −0.4 and 0.0 %. \[px\]
const REACH_PX: usize = 2;

/// The border of a coarse cut again at full size, window by window so that memory stays small.
pub fn fine(
    pixels: &Rgb,
    without: &Backdrop,
    ready: &Prepared,
    coarse: &Image<bool>,
    gmm: &Gmm,
    settings: &Settings,
) -> Mask {
    let factor = ready.factor;
    let image = &without.image;
    let (width, height) = (pixels.width, pixels.height);
    // The ground of every pixel is dear, and that of its neighbourhood serves.
    let grounds = Grounds::of(ready.floor.as_ref(), factor, width, height);
    let noise = Noise::measure(pixels, image, &|x, y| grounds.about(x, y), REACH_PX);
    let settings = &settings.with(noise);
    if factor == 1 {
        return soft_border(pixels, image, coarse, noise);
    }
    let band = band(coarse);
    let settled = Settled::of(ready, coarse, &band);
    let likeness = Likeness {
        photo: pixels,
        expected: image,
        noise,
        ground: &|x, y| grounds.at(x, y),
        reach: REACH_PX,
    };
    let mut cost = settled.cost(&likeness, without, &ready.strange);
    if !ready.mirrored.is_empty() {
        let mirroring = Likeness {
            expected: &mirroring(image, &ready.mirrored, factor),
            ..likeness
        };
        let other = settled.cost(&mirroring, without, &ready.strange);
        let both = cost.iter_mut().zip(&other);
        both.for_each(|(cost, other)| *cost = cost.min(*other));
    }
    let known = |i: usize| settled.at(i % width, i / width);
    let mut sides = cut_again(pixels, factor, coarse, &band, &|window| {
        let rows = window.y..window.y + window.height;
        let of_window: Vec<f32> = rows
            .flat_map(|y| &cost[y * width + window.x..][..window.width])
            .map(|cost| ready.foreseen_or_not(*cost))
            .collect();
        let person = settled.within(&ready.person, window);
        cut(pixels, [&of_window, &person], window, gmm, settings, &known)
    });
    if ready.unforeseen.is_some() {
        let odds = |x: usize, y: usize| settled.between(&ready.person, x, y);
        follow(&mut sides, &likeness, without, gmm, &odds);
    }
    soft_border(pixels, image, &largest_part(&sides), noise)
}

/// What the coarse cut leaves open: its border, where nothing was certain before.
struct Settled {
    factor: usize,
    known: Image<Known>,
    /// Coarse pixels that are open or beside one.
    near: Image<bool>,
}

impl Settled {
    fn of(ready: &Prepared, coarse: &Image<bool>, band: &Image<bool>) -> Self {
        let (width, height) = (coarse.width, coarse.height);
        let known = settled(coarse, band, &|i| ready.known[i]);
        let mut near = Image::filled(width, height, false);
        for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
            if known.at(x, y) == Known::Unknown {
                for y in y.max(1) - 1..(y + 2).min(height) {
                    near.data[y * width..][x.max(1) - 1..(x + 2).min(width)].fill(true);
                }
            }
        }
        Settled {
            factor: ready.factor,
            known,
            near,
        }
    }

    fn at(&self, x: usize, y: usize) -> Known {
        of_small(&self.known, self.factor, x, y)
    }

    /// Whether a pixel or one of its neighbours is open.
    fn beside_open(&self, x: usize, y: usize) -> bool {
        let open = |x: usize, y: usize| self.at(x, y) == Known::Unknown;
        let mut rows = y.max(1) - 1..y + 2;
        of_small(&self.near, self.factor, x, y)
            && (open(x, y) || rows.any(|y| (x.max(1) - 1..x + 2).any(|x| open(x, y))))
    }

    /// What pixels cost as background where that is asked: the rest are settled.
    fn cost(&self, likeness: &Likeness<'_>, without: &Backdrop, strange: &[f32]) -> Vec<f32> {
        let (width, height) = (likeness.photo.width, likeness.photo.height);
        let mut cost = vec![0.0; width * height];
        for tile in tiles(&self.near) {
            let scaled = |r: &Range<usize>| (r.start * self.factor, r.len() * self.factor);
            let ((left, wide), (top, tall)) = (scaled(&tile.x), scaled(&tile.y));
            let wanted = |x: usize, y: usize| self.beside_open(x, y);
            let here = likeness.cost_where([left, top, wide, tall], &wanted);
            for (y, row) in (top..top + tall).zip(here.chunks(wide)) {
                let places = y * width + left..;
                for (i, here) in places.zip(row) {
                    cost[i] = match (without.seen.data[i], self.between(strange, i % width, y)) {
                        (false, _) => UNSEEN,
                        (true, strange) if strange > 0.0 => here.max(FLAT + strange),
                        (true, _) => *here,
                    };
                }
            }
        }
        cost
    }

    /// The same of every pixel of a window, row by row; nothing where there is no evidence.
    fn within(&self, coarse: &[f32], window: &Window) -> Vec<f32> {
        let count = if coarse.is_empty() {
            0
        } else {
            window.width * window.height
        };
        let at = |i: usize| (window.x + i % window.width, window.y + i / window.width);
        (0..count)
            .map(at)
            .map(|(x, y)| self.between(coarse, x, y))
            .collect()
    }

    /// The evidence of coarse pixels at a pixel between their middles, bilinear; 0 where they have none.
    fn between(&self, coarse: &[f32], x: usize, y: usize) -> f32 {
        let (width, height) = (self.known.width, self.known.height);
        if coarse.is_empty() {
            return 0.0;
        }
        let place = |v: usize, most: usize| {
            let at = (v as f32 + 0.5) / self.factor as f32 - 0.5;
            let at = at.clamp(0.0, (most - 1) as f32);
            let first = (at as usize).min(most.saturating_sub(2));
            (first, (first + 1).min(most - 1), at - first as f32)
        };
        let ((left, right, u), (top, bottom, v)) = (place(x, width), place(y, height));
        let along = |y: usize| {
            let (a, b) = (coarse[y * width + left], coarse[y * width + right]);
            a + u * (b - a)
        };
        along(top) + v * (along(bottom) - along(top))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIDE: usize = 160;
    const FACTOR: usize = 4;

    /// Body to the left, of the floor's colour in a faint shadow.
    fn half(x: usize) -> bool {
        x < SIDE / 2
    }

    /// Where the border ends up, on the mean. \[px\]
    fn border(strange: Vec<f32>) -> f64 {
        let mut dice = proof::Dice(2);
        let mut noisy =
            |color: [f64; 3], sigma: f64| color.map(|v| (v + sigma * dice.normal()).round() as u8);
        let mut pixels = Rgb::filled(SIDE, SIDE, [0; 3]);
        for (i, p) in pixels.data.iter_mut().enumerate() {
            let body = half(i % SIDE);
            *p = noisy(
                if body {
                    [162.0, 133.0, 102.0]
                } else {
                    [178.0, 146.0, 112.0]
                },
                1.5,
            );
        }
        let skin: Vec<[u8; 3]> = (0..2000)
            .map(|_| noisy([162.0, 133.0, 102.0], 12.0))
            .collect();
        let without = Backdrop::whole(Rgb::filled(SIDE, SIDE, [178, 146, 112]));
        let small = SIDE / FACTOR;
        let coarse = Image {
            width: small,
            height: small,
            data: (0..small * small)
                .map(|i| half(i % small * FACTOR))
                .collect(),
        };
        let mut ready = crate::likelihood::prepared::prepare(&pixels, &without, None, small, 0.0);
        ready.strange = strange;
        let settings = Settings {
            gamma: 40.0,
            rounds: 1,
            clusters: 1,
            thinner: 0.0,
        };
        let skin = Gmm::fit(&skin, 1).expect("one cluster");
        let mask = fine(&pixels, &without, &ready, &coarse, &skin, &settings);
        let body: f64 = mask.data.iter().map(|c| f64::from(*c) / 255.0).sum();
        body / SIDE as f64
    }

    #[test]
    fn the_border_at_full_size_keeps_to_the_grain_where_colours_tell_nothing() {
        let small = SIDE / FACTOR;
        let lacks = (0..small * small).map(|i| if half(i % small * FACTOR) { 24.0 } else { 0.0 });
        let (by_colors, by_grain) = (border(Vec::new()), border(lacks.collect()));
        let true_border = SIDE as f64 / 2.0;
        assert!(by_colors < true_border - 4.0, "{by_colors} px");
        assert!((by_grain - true_border).abs() < 1.0, "{by_grain} px");
    }
}
