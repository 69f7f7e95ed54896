//! Levels that recur at a pixel, each with the photos that show it: one of them may be the background.
//!
//! Photos that show the background differ by noise alone. A plain part of a body may look alike in most photos,
//! and the background show in few; so every level that recurs is kept, up to [`MODES`] a pixel.

use crate::empty_scene::message_passing::CHOICES;
use crate::empty_scene::recurring::{REACH, Unlike, contrast, differences, pairs};
use crate::likelihood::neighbourhoods::least_around;
use crate::raster::raster;
use crate::scene::backdrop::Backdrop;
use rayon::prelude::*;
use shape::Rgb;

/// Levels that are kept of a pixel; that none is the background is a choice, too (derived).
pub(crate) const MODES: usize = CHOICES - 1;
/// What differs by so many times more than the same may is something else.
const APART: f32 = 3.0;
/// A single pixel may differ by so many times more than the mean of a patch.
const SINGLE: f32 = 3.0;

/// What a photo is to another, or to a level, at a pixel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Agreement {
    Other,
    Unsure,
    Same,
}

/// The levels that recur, pixel by pixel.
pub(crate) struct Modes {
    pub(crate) width: usize,
    pub(crate) height: usize,
    /// How many photos there are.
    pub(crate) photos: usize,
    /// Words of a set of photos.
    pub(crate) words: usize,
    /// Of each pixel, mode by mode: photos that show it, then photos that show something else, as bits.
    sets: Vec<u64>,
    /// Of each pixel, mode by mode: the colour.
    colors: Vec<[[u8; 3]; MODES]>,
    /// Of each pixel, mode by mode: the least squared contrast of the patches that show it. \[levels²\]
    pub(crate) rough: Vec<[f32; MODES]>,
}

impl Modes {
    /// The levels that recur in photos which share the background pixel for pixel.
    pub(crate) fn of(photos: &[Rgb]) -> Self {
        let (width, height) = photos.first().map_or((0, 0), |p| (p.width, p.height));
        let words = photos.len().div_ceil(64);
        let pairs = pairs(photos.len());
        let rough: Vec<Vec<f32>> = photos.par_iter().map(contrast).collect();
        let both = |(a, b): &(usize, usize)| {
            compared([&photos[*a], &photos[*b]], [&rough[*a], &rough[*b]])
        };
        let agreement: Vec<Vec<Agreement>> = pairs.par_iter().map(both).collect();
        let mut partners = vec![vec![]; photos.len()];
        for (pair, (a, b)) in pairs.iter().enumerate() {
            partners[*a].push((*b, pair));
            partners[*b].push((*a, pair));
        }
        let mut modes = Modes {
            width,
            height,
            photos: photos.len(),
            words,
            sets: vec![0; width * height * MODES * 2 * words],
            colors: vec![[[0; 3]; MODES]; width * height],
            rough: vec![[0.0; MODES]; width * height],
        };
        let sets = modes.sets.par_chunks_mut(MODES * 2 * words.max(1));
        let places = sets.zip(modes.colors.par_iter_mut().zip(&mut modes.rough));
        places
            .enumerate()
            .for_each(|(i, (sets, (colors, roughs)))| {
                let pixel = Pixel {
                    partners: &partners,
                    agreement: &agreement,
                    i,
                };
                let places = sets
                    .chunks_mut(2 * words)
                    .zip(colors.iter_mut().zip(roughs));
                for (mode, (set, (color, least))) in pixel.modes().iter().zip(places) {
                    *color = written(mode, photos, i, set.split_at_mut(words));
                    let shows = (0..photos.len()).filter(|k| mode[*k] == Agreement::Same);
                    *least = shows.map(|k| rough[k][i]).fold(f32::MAX, f32::min);
                }
            });
        modes
    }

    /// Photos that show a mode of a pixel, and photos that show something else, as bits.
    pub(crate) fn sets(&self, pixel: usize, mode: usize) -> (&[u64], &[u64]) {
        let at = (pixel * MODES + mode) * 2 * self.words;
        self.sets[at..at + 2 * self.words].split_at(self.words)
    }

    /// How many photos show a mode; none where there is no such mode.
    pub(crate) fn count(&self, pixel: usize, mode: usize) -> u32 {
        let shows = self.sets(pixel, mode).0;
        shows.iter().map(|word| word.count_ones()).sum()
    }

    /// The background, once it is known which mode of a pixel it is, if any.
    pub(crate) fn backdrop(&self, chosen: &[Option<usize>]) -> Backdrop {
        let image = |data| raster(self.width, self.height, data);
        let pairs = self.colors.iter().zip(chosen);
        let color = |(colors, mode): (&[[u8; 3]; MODES], &Option<usize>)| {
            mode.map_or([0; 3], |m| colors[m])
        };
        Backdrop {
            image: raster(self.width, self.height, pairs.map(color).collect()),
            seen: image(chosen.iter().map(Option::is_some).collect()),
        }
    }
}

/// Writes which photos show a mode and which something else; the colour that they show.
fn written(
    mode: &[Agreement],
    photos: &[Rgb],
    i: usize,
    (shows, rest): (&mut [u64], &mut [u64]),
) -> [u8; 3] {
    let (mut sum, mut count) = ([0u32; 3], 0u32);
    for (k, agreement) in mode.iter().enumerate() {
        match agreement {
            Agreement::Same => {
                shows[k / 64] |= 1 << (k % 64);
                (0..3).for_each(|c| sum[c] += u32::from(photos[k].data[i][c]));
                count += 1;
            }
            Agreement::Other => rest[k / 64] |= 1 << (k % 64),
            Agreement::Unsure => {}
        }
    }
    sum.map(|s| ((s + count / 2) / count.max(1)) as u8)
}

/// Two photos compared pixel by pixel: a patch that holds the pixel is the same, and so
/// is the pixel itself. Beside an outline that is a patch off to one side.
fn compared([a, b]: [&Rgb; 2], rough: [&Vec<f32>; 2]) -> Vec<Agreement> {
    let far = differences(a, b);
    let steep = |i: usize| rough[0][i].min(rough[1][i]);
    let unlike = Unlike::of(&far, &|_| true, &steep);
    let share: Vec<f32> = (0..far.len())
        .map(|i| far[i] / unlike.most(steep(i)))
        .collect();
    let patch = least_around(&share, a.width, REACH);
    let one = |i: usize| {
        let off = |c: usize| f32::from(a.data[i][c].abs_diff(b.data[i][c]));
        let single = (0..3).map(|c| off(c) * off(c)).sum::<f32>() / 3.0;
        let single = single / (SINGLE * unlike.most(steep(i)));
        match patch[i].max(single) {
            far if far < 1.0 => Agreement::Same,
            far if far > APART => Agreement::Other,
            _ => Agreement::Unsure,
        }
    };
    (0..far.len()).map(one).collect()
}

/// What all pairs of photos show of a pixel.
struct Pixel<'a> {
    /// Of each photo: those that it is compared with, and as which pair.
    partners: &'a [Vec<(usize, usize)>],
    agreement: &'a [Vec<Agreement>],
    i: usize,
}

impl Pixel<'_> {
    fn same(&self, pair: usize) -> bool {
        self.agreement[pair][self.i] == Agreement::Same
    }

    /// The levels that two photos show at least, the one of most photos first: what each photo is to it.
    fn modes(&self) -> Vec<Vec<Agreement>> {
        let count = self.partners.len();
        let mut taken = vec![false; count];
        let mut modes = Vec::new();
        while modes.len() < MODES {
            let fans = |k: usize| {
                let fan = |(j, pair): &&(usize, usize)| !taken[*j] && self.same(*pair);
                self.partners[k].iter().filter(fan).count()
            };
            let free = (0..count).filter(|k| !taken[*k]);
            let best = free
                .map(|k| (fans(k), k))
                .max_by_key(|(fans, k)| (*fans, usize::MAX - k));
            let Some((_, best)) = best.filter(|(fans, _)| *fans > 0) else {
                break;
            };
            let mode = self.around(best);
            taken[best] = true;
            let shows = |agreement: &Agreement| *agreement == Agreement::Same;
            taken
                .iter_mut()
                .zip(&mode)
                .for_each(|(t, agreement)| *t |= shows(agreement));
            if mode.iter().filter(|t| shows(t)).count() > 1 {
                modes.push(mode);
            }
        }
        modes
    }

    /// What each photo is to the level that one shows, by most of the photos that show it.
    fn around(&self, best: usize) -> Vec<Agreement> {
        let mut shows = vec![false; self.partners.len()];
        shows[best] = true;
        for (j, pair) in &self.partners[best] {
            shows[*j] = self.same(*pair);
        }
        let agreement = |shows: &[bool], k: usize| {
            let (mut same, mut other, mut asked) = (0, 0, 0);
            for (_, pair) in self.partners[k].iter().filter(|(j, _)| shows[*j]) {
                asked += 1;
                match self.agreement[*pair][self.i] {
                    Agreement::Same => same += 1,
                    Agreement::Other => other += 1,
                    Agreement::Unsure => {}
                }
            }
            if 2 * same >= asked && same > 2 * other {
                Agreement::Same
            } else if 2 * other > asked {
                Agreement::Other
            } else {
                Agreement::Unsure
            }
        };
        // Once more with those that were found.
        let first = |k: usize| agreement(&shows, k) == Agreement::Same;
        let shows: Vec<bool> = (0..shows.len()).map(first).collect();
        (0..shows.len()).map(|k| agreement(&shows, k)).collect()
    }
}
