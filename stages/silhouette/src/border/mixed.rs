//! What a pixel costs that shows body and background at once: a mixture of what is on either side of it.
//!
//! Along an outline a pixel is `I = a F + (1 - a) B` (Porter and Duff 1984), of light, and lens, sensor and JPEG make some
//! two or three such pixels of every border. The background does not explain them, and colours of the body hardly do, so
//! that a cut goes around all with a trace of the body. Here the body's F and the background's B are taken from either
//! side, every share `a` is as likely, and the side that a pixel is on is that of which it shows more,
//! `p(I | side) = ∫ N(I; a F + (1 - a) B, σ²) da` over that side's shares.
//! How far either side is follows from how wide borders of the photo are.

use crate::border::light::{Light, Mean, Shown};
use crate::cut::least_cut::{Known, Window};
use crate::cut::maxflow::STEPS;
use crate::label::color_cut::OWN_NATS;
use crate::likelihood::background::{FLAT, Likeness};
use crate::likelihood::body::EVIDENT;
use crate::scene::backdrop::{Backdrop, SHY};

/// How far to either side one side is sought while it is not known how wide borders are (derived: a mixture is at most [`SHY`]
/// beyond the border, and what is as far within shows one side). \[px\]
const FIRST_APART_PX: i32 = 2 * SHY as i32;
/// Shares a standard deviation to either side of the middle of a border (derived: of a normal distribution).
const WITHIN_DEVIATION: std::ops::Range<f32> = 0.1587..0.8413;
/// What it costs to be a mixture (derived: beside a border a pixel is one or not, ln 2). \[nats\]
const MIXED_NATS: f32 = std::f32::consts::LN_2;

/// Pixels of a photo that may be mixtures: their places, ascending, and what they cost as background and as body. \[nats\]
pub(crate) struct Mixtures(Vec<(usize, [f32; 2])>);

impl Mixtures {
    /// Of these places of a photo, row by row; it is measured first how wide borders are.
    pub(crate) fn of(sides: &Sides<'_>, places: &[(usize, usize)]) -> Self {
        // Two deviations beyond the border and two within it show both, as far again one side.
        let first = sides.mixtures(places, FIRST_APART_PX);
        let mixed_px = libm::roundf(2.0 * sides.blur(places, &first)) as i32;
        let all = match 2 * mixed_px {
            FIRST_APART_PX => first,
            apart => sides.mixtures(places, apart),
        };
        let costs = |(&(x, y), mixture): (&(usize, usize), Option<Mixture>)| {
            Some((y * sides.likeness.photo.width + x, mixture?.costs()))
        };
        Mixtures(places.iter().zip(all).filter_map(costs).collect())
    }

    /// What the pixels of a window cost as background and as body, row by row; `None` where one is no mixture. \[nats\]
    pub(crate) fn within(&self, window: &Window, photo_width: usize) -> Vec<Option<[f32; 2]>> {
        let mut all = vec![None; window.width * window.height];
        for (y, row) in (window.y..).zip(all.chunks_mut(window.width)) {
            let start = y * photo_width + window.x;
            let from = self.0.partition_point(|(i, _)| *i < start);
            let here = self.0[from..].iter();
            for (i, costs) in here.take_while(|(i, _)| *i < start + window.width) {
                row[i - start] = Some(*costs);
            }
        }
        all
    }
}

/// How a pixel is explained as a mixture.
struct Mixture {
    /// How much of it is body, 0 to 1.
    share: f32,
    /// How far apart body and background are, in deviations of noise.
    noises: f32,
    /// What it costs that it is off the line between the colours of both. \[nats\]
    off: f32,
}

impl Mixture {
    /// As background and as body. \[nats\]
    fn costs(&self) -> [f32; 2] {
        let spread = self.noises / libm::sqrtf(std::f32::consts::TAU);
        let fit = FLAT + MIXED_NATS + self.off + libm::logf(spread.max(1.0));
        // The part of a normal distribution that is beyond.
        let beyond =
            |deviations: f32| libm::erfcf(deviations * std::f32::consts::FRAC_1_SQRT_2) / 2.0;
        let more = (self.share - 0.5) * self.noises;
        [more, -more].map(|more| fit - libm::logf(beyond(more).max(f32::MIN_POSITIVE)))
    }
}

/// What of a photo is evidently body or background.
pub(crate) struct Sides<'a> {
    likeness: &'a Likeness<'a>,
    without: &'a Backdrop,
    light: Light,
    /// What each pixel costs as background where it is open.
    cost: &'a [f32],
    known: &'a [Known],
}

impl<'a> Sides<'a> {
    /// By what each pixel costs as background, where it is not `known`.
    pub(crate) fn of(
        likeness: &'a Likeness<'a>,
        without: &'a Backdrop,
        cost: &'a [f32],
        known: &'a [Known],
    ) -> Self {
        Sides {
            likeness,
            without,
            light: Light::of_levels(),
            cost,
            known,
        }
    }

    /// Half of how many pixels a border is wide between the shares of one deviation to either side: of all that may be
    /// mixtures, over the length of the line along which they are half body. \[px\]
    fn blur(&self, places: &[(usize, usize)], mixtures: &[Option<Mixture>]) -> f32 {
        let (mut within, mut crossed) = (0u32, 0u32);
        // What was last seen in each column, and in which row.
        let mut above = vec![(usize::MAX, 0.0); self.likeness.photo.width];
        for (&(x, y), mixture) in places.iter().zip(mixtures) {
            let i = y * self.likeness.photo.width + x;
            let mixture = mixture.as_ref().map(|m| m.share);
            let Some(share) = mixture.or_else(|| self.is_background(i).then_some(0.0)) else {
                continue;
            };
            within += u32::from(WITHIN_DEVIATION.contains(&share));
            let other = |(row, beside): (usize, f32), at: usize| {
                u32::from(row == at && (beside > 0.5) != (share > 0.5))
            };
            crossed += other(above[x], y.wrapping_sub(1));
            crossed += x.checked_sub(1).map_or(0, |left| other(above[left], y));
            above[x] = (y, share);
        }
        // Lines of all directions cross pi/4 as many steps along rows and columns as they are long.
        let length = crossed as f32 * std::f32::consts::FRAC_PI_4;
        match crossed {
            0 => 0.0,
            _ => within as f32 / (2.0 * length),
        }
    }

    /// [`Sides::mixture`] of each of some places.
    fn mixtures(&self, places: &[(usize, usize)], apart: i32) -> Vec<Option<Mixture>> {
        let one = |&(x, y): &(usize, usize)| self.mixture(x, y, apart);
        places.iter().map(one).collect()
    }

    /// The likeliest mixture of what is so far to either side of a pixel.
    fn mixture(&self, x: usize, y: usize, apart: i32) -> Option<Mixture> {
        let i = y * self.likeness.photo.width + x;
        let strange = self.cost[i] > OWN_NATS && self.without.seen.data[i];
        if apart == 0 || !strange || self.known[i] != Known::Unknown {
            return None;
        }
        let all = STEPS.map(|(dx, dy)| (apart * dx, apart * dy));
        let all = all.into_iter().filter_map(|step| self.between(x, y, step));
        // What is itself a mixture is less far apart from the other side.
        let nats = |m: &Mixture| m.off - libm::logf(m.noises);
        all.min_by(|a, b| nats(a).total_cmp(&nats(b)))
    }

    /// A mixture of the body in one direction and the background in the opposite one.
    fn between(&self, x: usize, y: usize, (dx, dy): (i32, i32)) -> Option<Mixture> {
        let (x, y) = (x as i32, y as i32);
        let body = |i: usize| match self.known[i] {
            Known::Unknown => self.cost[i] > EVIDENT,
            known => known == Known::Body,
        };
        let (of_body, _) = self.around((x + dx, y + dy), body)?;
        let (shown, expected) = self.around((x - dx, y - dy), |i| self.is_background(i))?;
        let lit = shown.iter().sum::<f32>() / expected.iter().sum::<f32>().max(f32::MIN_POSITIVE);
        Some(self.explained(x as usize, y as usize, of_body, lit))
    }

    /// Whether a pixel evidently shows the background.
    fn is_background(&self, i: usize) -> bool {
        match self.known[i] {
            Known::Unknown => self.cost[i] <= OWN_NATS,
            known => known == Known::Background,
        }
    }

    /// The mean light of the photo and of the background about a pixel that is of one side, over those that are; `None` if
    /// it is not.
    fn around(&self, (x, y): (i32, i32), is: impl Fn(usize) -> bool) -> Option<(Shown, Shown)> {
        let (photo, expected) = (self.likeness.photo, self.likeness.expected);
        let inside = |v: i32, most: usize| (0..most as i32).contains(&v);
        let index = |x: i32, y: i32| y as usize * photo.width + x as usize;
        if !inside(x, photo.width) || !inside(y, photo.height) || !is(index(x, y)) {
            return None;
        }
        let (mut shown, mut without) = (Mean::default(), Mean::default());
        for (x, y) in (y - 1..y + 2).flat_map(|y| (x - 1..x + 2).map(move |x| (x, y))) {
            if inside(x, photo.width) && inside(y, photo.height) && is(index(x, y)) {
                let light = |image| self.light.at(image, x as usize, y as usize);
                shown.add(light(photo));
                without.add(light(expected));
            }
        }
        Some((shown.mean()?, without.mean()?))
    }

    /// A pixel as a mixture of the body's light and the background's under so much of its light.
    fn explained(&self, x: usize, y: usize, body: Shown, lit: f32) -> Mixture {
        let sigma = self.likeness.noise.still;
        let ground = self.light.at(self.likeness.expected, x, y).map(|c| c * lit);
        let mixing = self.light.mixing(self.likeness.photo, [x, y], body, ground);
        Mixture {
            share: mixing.share,
            noises: libm::sqrtf(mixing.apart.max(1.0)) / sigma,
            off: mixing.off / (2.0 * sigma * sigma),
        }
    }
}

#[cfg(test)]
mod tests;
