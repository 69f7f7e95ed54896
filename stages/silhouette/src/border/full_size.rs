//! The border of a coarse cut, cut again at full size.

use crate::border::mixed::{Mixtures, Sides};
use crate::border::narrow_gaps::follow;
use crate::border::soft_border::soft_border;
use crate::border::tiles::{band, cut_again, enlarged, of_small, settled, tiles};
use crate::cut::least_cut::{Known, Window};
use crate::label::color_cut::{Costs, Settings, cut};
use crate::likelihood::background::{Likeness, Noise};
use crate::likelihood::colors_beside::Nearby;
use crate::likelihood::gmm::Gmm;
use crate::likelihood::grounds::Grounds;
use crate::likelihood::local_light::lit;
use crate::likelihood::mirror::mirroring;
use crate::likelihood::neighbourhoods::REACH_PX;
use crate::likelihood::noise::Cast;
use crate::likelihood::prepared::{COARSE_REACH_PX, Prepared, UNSEEN};
use crate::scene::backdrop::Backdrop;
use shape::{Gray, Image, Mask, Rgb, largest_part};
use std::ops::Range;

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
    let unlit = without;
    let cast = cast(ready, &unlit.image);
    let brought = (!ready.light.is_empty()).then(|| Backdrop {
        image: lit(&without.image, &ready.light, factor),
        seen: without.seen.clone(),
    });
    let without = brought.as_ref().unwrap_or(without);
    let image = &without.image;
    let (width, height) = (pixels.width, pixels.height);
    // The ground of every pixel is dear, and that of its neighbourhood serves.
    let grounds = Grounds::of(ready.floor.as_ref(), factor, width, height);
    let mut noise = Noise::measure(pixels, image, &|x, y| grounds.about(x, y), REACH_PX);
    noise.cast = cast;
    let settings = &settings.with(noise);
    if factor == 1 {
        return soft_border(pixels, Some(without), coarse, noise);
    }
    let band = band(coarse);
    let settled = Settled::of(ready, coarse, &band, [width, height]);
    let likeness = Likeness {
        photo: pixels,
        expected: image,
        noise,
        ground: &|x, y| grounds.at(x, y),
        reach: REACH_PX,
    };
    let mut cost = settled.cost(&likeness, without);
    let unlit = brought.is_some().then_some(&unlit.image);
    let mirroring = (!ready.mirrored.is_empty()).then(|| mirroring(image, &ready.mirrored, factor));
    for expected in [unlit, mirroring.as_ref()].into_iter().flatten() {
        let other = settled.cost(
            &Likeness {
                expected,
                ..likeness
            },
            without,
        );
        let both = cost.iter_mut().zip(&other);
        both.for_each(|(cost, other)| *cost = cost.min(*other));
    }
    let person = Gray {
        width: coarse.width,
        height: coarse.height,
        data: ready.person.clone(),
    };
    let known = &settled.known.data;
    let places = settled.places(width, height);
    let mixtures = Mixtures::of(&Sides::of(&likeness, without, &cost, known), &places);
    let mut sides = cut_again(pixels, factor, coarse, &band, &|window| {
        let rows = window.y..window.y + window.height;
        let of_window: Vec<f32> = rows
            .flat_map(|y| &cost[y * width + window.x..][..window.width])
            .map(|cost| ready.foreseen_or_not(*cost))
            .collect();
        let costs = Costs {
            background: &of_window,
            person: &settled.within(&person, window),
            mixed: &mixtures.within(window, width),
        };
        cut(pixels, &costs, window, gmm, settings, &|i| known[i])
    });
    if ready.unforeseen.is_some() {
        let odds = |x: usize, y: usize| settled.between(&person, x, y);
        follow(&mut sides, &likeness, without, gmm, &odds);
    }
    soft_border(pixels, Some(without), &largest_part(&sides), noise)
}

/// Shadows that a lamp casts on walls, by the reduced photo.
fn cast(ready: &Prepared, expected: &Rgb) -> Option<Cast> {
    let grounds = Grounds::of(
        ready.floor.as_ref(),
        1,
        ready.small.width,
        ready.small.height,
    );
    let (on, expected) = (
        |x: usize, y: usize| grounds.at(x, y),
        expected.reduced(ready.factor),
    );
    let noise = Noise::measure(&ready.small, &expected, &on, COARSE_REACH_PX);
    Cast::measure(
        [&ready.small, &expected],
        &on,
        &ready.person,
        &noise,
        COARSE_REACH_PX,
    )
}

/// What the coarse cut leaves open: its border, where nothing was certain before.
struct Settled {
    factor: usize,
    /// At full size.
    known: Image<Known>,
    /// Coarse pixels that are open or beside one.
    near: Image<bool>,
}

impl Settled {
    fn of(ready: &Prepared, coarse: &Image<bool>, band: &Image<bool>, size: [usize; 2]) -> Self {
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
            known: enlarged(&known, ready.factor, size),
            near,
        }
    }

    /// Pixels (x, y) of a photo of this size that are open or near one, row by row.
    fn places(&self, width: usize, height: usize) -> Vec<(usize, usize)> {
        let rows = |y: usize| {
            let near = (0..width).step_by(self.factor);
            let near = near.filter(move |x| of_small(&self.near, self.factor, *x, y));
            near.flat_map(move |x| (x..(x + self.factor).min(width)).map(move |x| (x, y)))
        };
        (0..height).flat_map(rows).collect()
    }

    /// Whether a pixel or one of its neighbours is open.
    fn beside_open(&self, x: usize, y: usize) -> bool {
        let columns = x.max(1) - 1..(x + 2).min(self.known.width);
        let mut rows = y.max(1) - 1..(y + 2).min(self.known.height);
        of_small(&self.near, self.factor, x, y)
            && rows.any(|y| self.known.row(y)[columns.clone()].contains(&Known::Unknown))
    }

    /// What pixels cost as background where that is asked: the rest are settled.
    fn cost(&self, likeness: &Likeness<'_>, without: &Backdrop) -> Vec<f32> {
        let (width, height) = (likeness.photo.width, likeness.photo.height);
        let mut cost = vec![0.0; width * height];
        let nearby = Nearby::of(without);
        for tile in tiles(&self.near) {
            let scaled = |r: &Range<usize>| (r.start * self.factor, r.len() * self.factor);
            let ((left, wide), (top, tall)) = (scaled(&tile.x), scaled(&tile.y));
            let wanted = |x: usize, y: usize| self.beside_open(x, y);
            let here = likeness.cost_where([left, top, wide, tall], &wanted);
            for (y, row) in (top..top + tall).zip(here.chunks(wide)) {
                let places = y * width + left..;
                for (i, here) in places.zip(row) {
                    cost[i] = match without.seen.data[i] {
                        true => *here,
                        false => nearby
                            .cost(likeness.photo, i)
                            .map_or(UNSEEN, |c| c.min(UNSEEN)),
                    };
                }
            }
        }
        cost
    }

    /// The evidence of coarse pixels at every pixel of a window, row by row; nothing where there is none.
    fn within(&self, coarse: &Gray, window: &Window) -> Vec<f32> {
        let count = if coarse.data.is_empty() {
            0
        } else {
            window.width * window.height
        };
        let places = window.places().take(count);
        places.map(|(x, y)| self.between(coarse, x, y)).collect()
    }

    /// The same at a pixel between the middles of coarse ones; 0 where there is none.
    fn between(&self, coarse: &Gray, x: usize, y: usize) -> f32 {
        if coarse.data.is_empty() {
            return 0.0;
        }
        let place = |v: usize| (v as f32 + 0.5) / self.factor as f32 - 0.5;
        coarse.sample(place(x), place(y))
    }
}

#[cfg(test)]
mod tests;
