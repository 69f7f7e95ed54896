//! A plate that was exposed otherwise than the photo: its levels brought to the photo's.
//!
//! Most of what both show is the same background, so of all ratios of their levels one is by far the most
//! frequent: that of the exposures, channel by channel (a white balance changes, too).

use shape::{Rgb, Tones};

/// Bins of the logarithm of a ratio, from 0.3 to 3.3 (derived: e^−1.2 to e^1.2).
const BINS: usize = 240;
/// How wide they are (structural: samples; the ratio is the mean of five of them).
const BIN_WIDTH: f32 = 0.01;
/// Levels that tell ratios: darker ones are too coarse, brighter ones may be cut off. By hand: looked at scenes 131 with a
/// plate and 132 without, from level 28 and 56 on: equal masks.
const TELLING_LEVELS: std::ops::RangeInclusive<u8> = 40..=248;
/// Share of the telling pixels that must keep to the ratio. By hand: looked at scene 131 with a plate, at 0.7 and 1.4
/// of it: equal masks.
const KEEPING_SHARE: f32 = 0.12;
/// Pixels that tell what is cut off (structural: a count of samples; the mean of 150 that differ by 3 levels is sure to
/// 0.25).
const ENOUGH_PIXELS: u32 = 150;
/// Telling pixels that a ratio needs (structural: a count of samples; of the fewest that then keep to it, 36 within
/// five bins, the mean is sure to 0.3 %).
const ENOUGH_PAIRS: u32 = 300;
/// Levels from here on may be cut off: what they are on the photo is as bright as so many of a hundred of its pixels
/// there, since what is darker may be in a shadow. By hand: looked at scenes 131 with a plate and 132 without, from
/// level 176 on: mean IoU at most −0.0019 (waist 3.0 %); from 255 on, or as bright as 60 of a hundred: equal masks.
const CUT_OFF: (u8, usize) = (252, 85);

/// Levels of the plate as the photo would show them. `None` if they are exposed alike, or share too
/// little to tell.
pub fn exposure(photo: &Rgb, plate: &Rgb) -> Option<Tones> {
    if (photo.width, photo.height) != (plate.width, plate.height) {
        return None;
    }
    let mut levels = [[0u8; 256]; 3];
    let mut alike = true;
    for (c, levels) in levels.iter_mut().enumerate() {
        let pairs = Pairs::of(photo, plate, c);
        let gain = ratio(&pairs)?;
        // Half a bin is no ratio.
        alike &= (gain - 1.0).abs() < BIN_WIDTH / 2.0;
        for (level, to) in levels.iter_mut().enumerate() {
            *to = (gain * level as f32).round() as u8;
        }
        if let Some(bright) = pairs.where_cut_off() {
            levels[CUT_OFF.0 as usize..].fill(bright);
        }
    }
    (!alike).then_some(levels)
}

/// How often each level of the photo is where the plate has each of its levels: some hundred
/// thousand pixels are far fewer pairs.
struct Pairs(Vec<u32>);

impl Pairs {
    /// Of a channel, one pixel of nine.
    fn of(photo: &Rgb, plate: &Rgb, c: usize) -> Self {
        let mut counts = vec![0; 256 * 256];
        for y in (0..photo.height).step_by(3) {
            for (p, e) in photo.row(y).iter().zip(plate.row(y)).step_by(3) {
                counts[usize::from(e[c]) * 256 + usize::from(p[c])] += 1;
            }
        }
        Pairs(counts)
    }

    /// Level of the photo, level of the plate, how often.
    fn each(&self) -> impl Iterator<Item = (u8, u8, u32)> {
        let met = self.0.iter().enumerate().filter(|(_, count)| **count > 0);
        met.map(|(i, count)| ((i % 256) as u8, (i / 256) as u8, *count))
    }

    /// What the photo shows where the plate is cut off.
    fn where_cut_off(&self) -> Option<u8> {
        let mut counts = [0u32; 256];
        let cut_off = self.each().filter(|(_, e, _)| *e >= CUT_OFF.0);
        cut_off.for_each(|(p, _, count)| counts[usize::from(p)] += count);
        let all: u32 = counts.iter().sum();
        if all < ENOUGH_PIXELS {
            return None;
        }
        let want = (all as usize - 1) * CUT_OFF.1 / 100;
        let mut below = 0;
        let reaches = |count: &u32| {
            below += *count as usize;
            below > want
        };
        Some(counts.iter().position(reaches).unwrap_or(255) as u8)
    }
}

/// The most frequent ratio of photo to plate.
fn ratio(pairs: &Pairs) -> Option<f32> {
    let mut counts = [0u32; BINS];
    let mut all = 0u32;
    for (photo, plate, count) in pairs.each().filter(|(_, e, _)| TELLING_LEVELS.contains(e)) {
        all += count;
        let log = libm::logf(f32::from(photo).max(1.0) / f32::from(plate));
        let bin = log / BIN_WIDTH + BINS as f32 / 2.0;
        if bin >= 0.0 && (bin as usize) < BINS && photo < CUT_OFF.0 {
            counts[bin as usize] += count;
        }
    }
    let around = |b: usize| -> u32 { counts[b - 2..=b + 2].iter().sum() };
    let best = (2..BINS - 2).max_by_key(|b| (around(*b), BINS - b))?;
    if all < ENOUGH_PAIRS || (around(best) as f32) < KEEPING_SHARE * all as f32 {
        return None;
    }
    let place = |b: usize| (b as f32 + 0.5 - BINS as f32 / 2.0) * BIN_WIDTH;
    let moment: f32 = (best - 2..=best + 2)
        .map(|b| place(b) * counts[b] as f32)
        .sum();
    Some(libm::expf(moment / around(best) as f32))
}
