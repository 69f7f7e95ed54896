//! Which photo has how much of each fault.

use crate::dice::Dice;
use crate::phone::params::PhoneParams;
use std::f64::consts::TAU;

/// The faults that differ from photo to photo.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Fault {
    /// Light of each channel against the photo as it came.
    pub(crate) gains: [f32; 3],
    /// How far the picture is right of and below where it was. \[px\]
    pub(crate) shift: [f32; 2],
    /// Standard deviation of the blur. \[px\]
    pub(crate) blur: f32,
    /// The line along which it was shaken. \[px\]
    pub(crate) shake: [f32; 2],
    /// Share of what surroundings differ by that is taken back.
    pub(crate) tone: f32,
}

impl Fault {
    /// A photo without faults.
    pub(crate) const NONE: Fault = Fault {
        gains: [1.0; 3],
        shift: [0.0; 2],
        blur: 0.0,
        shake: [0.0; 2],
        tone: 0.0,
    };
}

/// The faults of each photo of a turn, and those of the plate. Each kind has a stream of chance of its
/// own, so that turning one on moves no other.
pub(crate) fn draw(p: &PhoneParams, count: usize) -> (Vec<Fault>, Fault) {
    let [ev, red, blue] = [1, 2, 3].map(|kind| drift(count, p.seed, kind));
    let shaken = chosen(count, p.shaken as usize, p.seed);
    let one = |i: usize| {
        let stream = |kind: u32| Dice::new(p.seed, (kind << 20) + i as u32);
        let gain = libm::exp2(p.exposure_ev * ev[i] + p.over_ev);
        let [red, blue] = [red[i], blue[i]].map(|d| 1.0 + p.white * d);
        let (mut blur, mut shake) = (stream(5), stream(6));
        let tone = p.local_tone * (0.5 + 0.5 * stream(7).unit());
        let angle = TAU * shake.unit();
        let along = if shaken.contains(&i) { p.shake_px } else { 0.0 };
        Fault {
            gains: [gain * red, gain, gain * blue].map(|g| g as f32),
            shift: shift(p.seed, i as u32, p.shift_px),
            blur: (p.blur_px * (0.75 + 0.5 * blur.unit())) as f32,
            shake: [libm::cos(angle), libm::sin(angle)].map(|d| (along * d) as f32),
            tone: tone as f32,
        }
    };
    let faults = (0..=count).map(one).collect::<Vec<_>>();
    let (plate, photos) = (faults[count], faults[..count].to_vec());
    (photos, plate)
}

/// How far the stabiliser moves one photo, with so many pixels as standard deviation. \[px\]
pub(crate) fn shift(seed: u32, number: u32, sigma_px: f64) -> [f32; 2] {
    let mut dice = Dice::new(seed, (4 << 20) + number);
    [dice.normal(), dice.normal()].map(|d| (sigma_px * d) as f32)
}

/// From -1 to 1 over the turn, and one number more for the plate, which is taken at another time: a slow
/// wave and steps, the greatest of the turn's values of size 1.
fn drift(count: usize, seed: u32, kind: u32) -> Vec<f64> {
    let mut dice = Dice::new(seed, kind << 20);
    let (speed, phase) = (0.6 + dice.unit(), TAU * dice.unit());
    let mut step = dice.unit() - 0.5;
    let mut all = Vec::with_capacity(count + 1);
    for i in 0..count {
        let t = i as f64 / count as f64;
        if dice.unit() < 0.2 {
            step = dice.unit() - 0.5;
        }
        all.push(0.5 * libm::sin(TAU * speed * t + phase) + step);
    }
    let most = all.iter().map(|v| v.abs()).fold(0.0, f64::max);
    if most > 0.0 {
        all.iter_mut().for_each(|v| *v /= most);
    }
    all.push(2.0 * dice.unit() - 1.0);
    all
}

/// So many different photos.
fn chosen(count: usize, wanted: usize, seed: u32) -> Vec<usize> {
    let mut dice = Dice::new(seed, 7 << 20);
    let mut left: Vec<usize> = (0..count).collect();
    let take = |_| left.swap_remove((dice.unit() * left.len() as f64) as usize);
    (0..wanted.min(count)).map(take).collect()
}
