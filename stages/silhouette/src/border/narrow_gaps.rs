//! The narrow ends of gaps between thighs and below arms, followed at full size.
//!
//! Few photos look through a gap, so all photos together call its end body; and at the reduced size it is
//! narrower than what a photo is believed against them. At full size it is not: from where the background
//! is, neighbourhoods that show it to the level are background, if it is sure by them against all that other photos,
//! and a learned sense of a person, speak for the body. That those speak for the background was weighed by the cut.

use crate::label::color_cut::OWN_NATS;
use crate::likelihood::background::{FLAT, Ground, Likeness};
use crate::likelihood::body::body_cost;
use crate::likelihood::colors_beside::{REACH_SHARE, UNLIKE};
use crate::likelihood::gmm::Gmm;
use crate::likelihood::person::SURE;
use crate::scene::backdrop::Backdrop;
use shape::{Image, Rgb};

/// So many places are asked along a row or column to each side (structural: samples).
const ASKED_PLACES: usize = 16;

/// Gives pixels of the body to the background that are in the narrow ends of gaps, the middle of each
/// neighbourhood: what is beside may be mixed. The disk is left out, whose light is not known so well. `odds` are the
/// log-odds of the body at a pixel by all but its own photo. \[nats\]
pub(crate) fn follow(
    sides: &mut Image<bool>,
    likeness: &Likeness<'_>,
    without: &Backdrop,
    body: &Gmm,
    odds: &dyn Fn(usize, usize) -> f32,
) {
    let (width, height) = (sides.width, sides.height);
    let mut gaps = Gaps {
        photo: likeness.photo,
        likeness,
        body,
        odds,
        thinner: likeness.noise.thinner(),
        seen: &without.seen,
        before: sides.clone(),
        known: vec![0.0; width * height],
        asked: vec![false; width * height],
    };
    let mut front = borders(sides);
    while let Some(at) = front.pop() {
        let new = !std::mem::replace(&mut gaps.asked[at], true);
        if !new || !sides.data[at] || !gaps.shows(at) {
            continue;
        }
        sides.data[at] = false;
        let next = beside(at, width).into_iter();
        front.extend(next.filter(|i| inner(*i, width, height) && !gaps.asked[*i]));
    }
}

/// What is asked of a photo.
struct Gaps<'a> {
    photo: &'a Rgb,
    likeness: &'a Likeness<'a>,
    body: &'a Gmm,
    odds: &'a dyn Fn(usize, usize) -> f32,
    /// By how much noise makes the background's density thinner. \[nats\]
    thinner: f64,
    seen: &'a Image<bool>,
    /// The cut as it was.
    before: Image<bool>,
    /// What pixels cost as background; 0, which none costs, where nobody asked. Pages without any take no memory.
    known: Vec<f32>,
    /// Neighbourhoods that were asked.
    asked: Vec<bool>,
}

impl Gaps<'_> {
    /// Whether the neighbourhood of a pixel shows the background: it counts as one pixel, for neighbours are alike.
    fn shows(&mut self, at: usize) -> bool {
        let width = self.photo.width;
        let (mut cost, mut shown) = (0.0, 0.0);
        for i in around(at, width) {
            let (x, y) = (i % width, i / width);
            let on = (self.likeness.ground)(x, y);
            if on == Ground::Disk {
                return false;
            }
            if self.known[i] == 0.0 {
                self.known[i] = match self.seen.data[i] {
                    true => self.likeness.single(x, y, on),
                    false => self.beside(i),
                };
            }
            let here = self.known[i];
            // No pixel costs less than the least.
            cost += (here - FLAT) / 9.0;
            if cost >= OWN_NATS - FLAT {
                return false;
            }
            let of_body = body_cost(self.body, self.photo.data[i]) - self.thinner;
            shown += (of_body as f32 - here) / 9.0;
        }
        shown > SURE + (self.odds)(at % width, at / width).max(0.0)
    }

    /// The cost of a pixel whose background nobody saw: by the colours of what is surely background nearby.
    fn beside(&self, i: usize) -> f32 {
        let (width, height) = (self.photo.width, self.photo.height);
        let step = ((height as f64 * REACH_SHARE / ASKED_PLACES as f64).round() as usize).max(1);
        let near = |v: usize, most: usize| {
            let reach = step * ASKED_PLACES;
            (v.saturating_sub(reach)..(v + reach + 1).min(most)).step_by(step)
        };
        let mut least = f32::MAX;
        for y in near(i / width, height) {
            for x in near(i % width, width) {
                let (a, b) = (self.photo.data[i], self.photo.at(x, y));
                let off = |c: usize| f32::from(a[c]) - f32::from(b[c]);
                let far = off(0) * off(0) + off(1) * off(1) + off(2) * off(2);
                if far < least && self.clean(x, y) {
                    least = far;
                }
            }
        }
        FLAT + least / (2.0 * UNLIKE * UNLIKE)
    }

    /// Whether a pixel was background with all around it.
    fn clean(&self, x: usize, y: usize) -> bool {
        let (width, height) = (self.photo.width, self.photo.height);
        let mut rows = y.saturating_sub(2)..(y + 3).min(height);
        let columns = x.saturating_sub(2)..(x + 3).min(width);
        rows.all(|y| columns.clone().all(|x| !self.before.at(x, y)))
    }
}

/// A pixel and its eight neighbours.
fn around(at: usize, width: usize) -> [usize; 9] {
    let (above, below) = (at - width, at + width);
    [
        at,
        at - 1,
        at + 1,
        above,
        above - 1,
        above + 1,
        below,
        below - 1,
        below + 1,
    ]
}

/// The four pixels beside a pixel.
fn beside(at: usize, width: usize) -> [usize; 4] {
    [at - 1, at + 1, at - width, at + width]
}

/// Whether a pixel is off the photo's edge.
fn inner(i: usize, width: usize, height: usize) -> bool {
    let (x, y) = (i % width, i / width);
    x > 0 && y > 0 && x + 1 < width && y + 1 < height
}

/// Pixels of the body beside the background, but for those at the photo's edge.
fn borders(sides: &Image<bool>) -> Vec<usize> {
    let (width, height) = (sides.width, sides.height);
    let body = (0..width * height).filter(|i| sides.data[*i] && inner(*i, width, height));
    body.filter(|i| beside(*i, width).iter().any(|j| !sides.data[*j]))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::likelihood::background::Noise;
    use crate::raster::raster;

    const SIDE: usize = 80;

    /// Whether a pixel is in a gap that narrows upward to 3 pixels.
    fn gap(x: usize, y: usize) -> bool {
        y >= 10 && x.abs_diff(40) <= 1 + (y - 10) / 5
    }

    /// Pixels of the gap above row 28, for whose body the other photos speak with 6 nats, that come back.
    fn found(seen: bool, skin: [f64; 3]) -> (usize, usize, usize) {
        let mut dice = proof::Dice(7);
        let mut noisy =
            |color: [f64; 3], sigma: f64| color.map(|v| (v + sigma * dice.normal()).round() as u8);
        let wall = [150.0, 154.0, 150.0];
        let mut photo = Rgb::filled(SIDE, SIDE, [0; 3]);
        for (i, p) in photo.data.iter_mut().enumerate() {
            let through = gap(i % SIDE, i / SIDE);
            *p = noisy(if through { wall } else { skin }, 1.5);
        }
        let some: Vec<[u8; 3]> = (0..2000).map(|_| noisy(skin, 4.0)).collect();
        let body = Gmm::fit(&some, 2).expect("clusters");
        let without = Backdrop {
            image: Rgb::filled(SIDE, SIDE, wall.map(|v| v as u8)),
            seen: Image::filled(SIDE, SIDE, seen),
        };
        let noise = Noise::even(2.0);
        let likeness = Likeness {
            photo: &photo,
            expected: &without.image,
            noise,
            ground: &|_, _| Ground::Wall,
            reach: 2,
        };
        let open = |i: usize| i / SIDE >= 28 && gap(i % SIDE, i / SIDE);
        let mut sides = raster(SIDE, SIDE, (0..SIDE * SIDE).map(|i| !open(i)).collect());
        follow(&mut sides, &likeness, &without, &body, &|_, _| 6.0);
        let count = |of: &dyn Fn(usize) -> bool| (0..SIDE * SIDE).filter(|i| of(*i)).count();
        let top = |i: usize| i / SIDE < 28 && gap(i % SIDE, i / SIDE);
        (
            count(&top),
            count(&|i| top(i) && !sides.data[i]),
            count(&|i| !gap(i % SIDE, i / SIDE) && !sides.data[i]),
        )
    }

    #[test]
    fn a_narrow_gap_is_followed_to_where_it_is_three_pixels_wide() {
        for seen in [true, false] {
            let (all, found, wrong) = found(seen, [190.0, 140.0, 110.0]);
            // A row of pixels along each side is left to the border's mixing.
            assert!(found * 2 > all && wrong == 0, "{found} of {all}, {wrong}");
        }
    }

    #[test]
    fn a_garment_of_the_walls_colour_is_left_alone() {
        for seen in [true, false] {
            let (_, found, wrong) = found(seen, [151.0, 153.0, 149.0]);
            assert_eq!((found, wrong), (0, 0));
        }
    }
}
