//! Noise of a photo against the background that is expected of it, measured.

use crate::likelihood::grounds::Ground;
use crate::likelihood::neighbourhoods::{mean, places};
use shape::{QUIET_SHARE, QUIET_SIGMAS, Rgb};

/// What a pixel that matches the background to the level costs: -ln of the greatest density of a normal distribution of
/// 1.8 levels (3/2 ln 2π + 3 ln 1.8). By hand: looked at scene 131 with a plate, at 0.7 and 1.4 of it: mean IoU +0.0001
/// and −0.0001. \[nats\]
pub(crate) const FLAT: f32 = 4.5;
/// Least noise that is believed: that of rounding, and a little more. By hand: looked at scene 131 with a plate, at 0.7 and
/// 1.4 of it: mean IoU +0.0000 and −0.0001. \[levels\]
const LEAST_LEVELS: f32 = 1.0;
/// Some neighbourhoods are noisier than the median, whose deviation is taken so much larger. By hand: looked at scene
/// 131 with a plate, at 0.7 and 1.4 of it: mean IoU −0.0000.
const UNEVEN_FACTOR: f32 = 1.3;
/// Least spread of a neighbourhood's light: half a level of a middle grey (derived).
const LEAST_LIGHT: f32 = 0.5 / 128.0;
/// Spread of the background's light where the subject changes it, and where nothing is known of it. By hand: looked at
/// it for all light, before that was measured (docs/lab/masks.md): mean IoU −0.0005 on four scenes with a plate,
/// −0.0003 without.
pub(crate) const SHADED_LIGHT: f32 = 0.04;
/// Least noise of a neighbourhood's mean, off the disk and on it: light that the subject throws back colours what is
/// near. By hand: looked at 0 in its place (docs/lab/masks.md): mean IoU −0.0002 on two scenes, their least photos
/// −0.0005; on another −0.0007, its hip +0.13 %. \[levels\]
const BOUNCE_LEVELS: [f32; 2] = [1.0, 2.0];
/// By how much less the mean of a neighbourhood is noisy than a pixel, at least. By hand: looked at it for all photos,
/// before that was measured (docs/lab/masks.md): equal bytes on four scenes; noisy photos lose more.
const QUIETER_FACTOR: f32 = 2.5;

/// How a lamp's shadows of the subject look on walls.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cast {
    /// Their share of the walls beside the subject.
    pub share: f32,
    /// The least light in them, as a share of the wall's own.
    pub darkest: f32,
}

impl Cast {
    /// What such a shadow costs beside a light that is normally distributed about the wall's own: densities of both, the
    /// shadow's even from the darkest light to the wall's own. \[nats\]
    pub(crate) fn price(&self, sigma: f32) -> f32 {
        let usual = (1.0 - self.share) / (sigma * std::f32::consts::TAU.sqrt());
        let cast = self.share / (1.0 - self.darkest);
        libm::logf(usual / cast).max(0.0)
    }
}

/// Standard deviations of photo and background against each other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Noise {
    /// Of what does not move. \[levels\]
    pub still: f32,
    /// On the disk, which is turned back and lit otherwise. \[levels\]
    pub disk: f32,
    /// Of the means of neighbourhoods, on what does not move and on the disk: JPEG's noise is alike in neighbours,
    /// a sensor's is not. \[levels\]
    pub means: [f32; 2],
    /// Of the light of the walls' neighbourhoods, as a ratio; at most 4 %.
    pub light: f32,
    /// Shadows that a lamp casts on walls, if they are seen there.
    pub cast: Option<Cast>,
}

impl Noise {
    /// The same everywhere, and of its light nothing is known. \[levels\]
    pub const fn even(levels: f32) -> Self {
        Noise {
            still: levels,
            disk: levels,
            means: [levels / QUIETER_FACTOR; 2],
            light: SHADED_LIGHT,
            cast: None,
        }
    }

    pub(crate) fn on(&self, ground: Ground) -> f32 {
        match ground {
            Ground::Disk => self.disk,
            _ => self.still,
        }
    }

    /// Noise of a neighbourhood's mean, with the light that the subject throws back. \[levels\]
    pub(crate) fn bounced(&self, on: Ground) -> f32 {
        let disk = usize::from(on == Ground::Disk);
        self.means[disk].max(BOUNCE_LEVELS[disk])
    }

    /// By how much the density of the background, of which [`FLAT`] is the cost, is thinner for noise: three channels
    /// whose normal density is e^-FLAT where it is greatest have a standard deviation of 1.8 levels,
    /// FLAT = 3/2 ln 2π + 3 ln σ. Mixtures of the body's colours widen with noise by themselves. \[nats\]
    pub(crate) fn thinner(&self) -> f64 {
        let whole = 1.5 * libm::log(std::f64::consts::TAU) + 3.0 * libm::log(f64::from(self.still));
        (whole - f64::from(FLAT)).max(0.0)
    }

    /// Measured: the subject covers less than half, so small quantiles of the differences are noise. `reach` is
    /// half the side of neighbourhoods. \[px\]
    pub fn measure(
        photo: &Rgb,
        expected: &Rgb,
        ground: &dyn Fn(usize, usize) -> Ground,
        reach: usize,
    ) -> Self {
        let pixels = Spread::of(photo, expected, ground, 0);
        let around = Spread::of(photo, expected, ground, reach);
        let still_or = pixels.colors[0].unwrap_or(4.0);
        let [still, disk] =
            [still_or, pixels.colors[1].unwrap_or(still_or)].map(|s| s.max(LEAST_LEVELS));
        let at_most = |means: Option<f32>, single: f32| {
            means.unwrap_or(f32::MAX).min(single / QUIETER_FACTOR)
        };
        let light = around.light;
        Noise {
            still,
            disk,
            means: [
                at_most(around.colors[0], still),
                at_most(around.colors[1], disk),
            ],
            light: light.map_or(SHADED_LIGHT, |l| l.clamp(LEAST_LIGHT, SHADED_LIGHT)),
            cast: None,
        }
    }
}

/// By how much neighbourhoods differ from what is expected of them; `None` where there are too few.
struct Spread {
    /// Of their colours when both are equally bright, for shadows are no noise: of what does not move, and of
    /// the disk. \[levels\]
    colors: [Option<f32>; 2],
    /// Of the ratio of their light, on walls.
    light: Option<f32>,
}

impl Spread {
    /// Of neighbourhoods that reach so many pixels to each side.
    fn of(
        photo: &Rgb,
        expected: &Rgb,
        ground: &dyn Fn(usize, usize) -> Ground,
        reach: usize,
    ) -> Self {
        let mut colors = [Counts::of_units(8.0), Counts::of_units(8.0)];
        let mut lights = Counts::of_units(2000.0);
        let bright = |c: [f32; 3]| c.iter().sum::<f32>() + 3.0;
        for (x, y) in places(photo, reach) {
            let (p, e) = (mean(photo, x, y, reach), mean(expected, x, y, reach));
            let (light, on) = (bright(p) / bright(e), ground(x, y));
            let of = &mut colors[usize::from(on == Ground::Disk)];
            (0..3).for_each(|c| of.add((p[c] - light * e[c]).abs()));
            if on == Ground::Wall {
                lights.add((light - 1.0).abs());
            }
        }
        // Of three channels that share their brightness two are free.
        let free = 1.5f32.sqrt();
        Spread {
            colors: colors.map(|c| c.sigma().map(|s| s * free)),
            light: lights.sigma(),
        }
    }
}

/// A histogram of absolute differences.
struct Counts {
    classes: [u32; 1024],
    /// Classes to a unit.
    units: f32,
}

impl Counts {
    fn of_units(units: f32) -> Self {
        Counts {
            classes: [0; 1024],
            units,
        }
    }

    fn add(&mut self, off: f32) {
        self.classes[((off * self.units) as usize).min(1023)] += 1;
    }

    /// Standard deviation, by the quantile below which [`QUIET_SHARE`] of a normal distribution's are. `None` for too few.
    fn sigma(&self) -> Option<f32> {
        let total: u32 = self.classes.iter().sum();
        if total < 300 {
            return None;
        }
        let want = total as f32 * QUIET_SHARE as f32;
        let mut below = 0.0;
        for (class, count) in self.classes.iter().enumerate() {
            let here = *count as f32;
            if below + here >= want {
                let quantile = (class as f32 + (want - below) / here) / self.units;
                return Some(quantile / QUIET_SIGMAS as f32 * UNEVEN_FACTOR);
            }
            below += here;
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn noisy(level: f64, sigma: f64, dice: &mut proof::Dice) -> Rgb {
        let mut image = Rgb::filled(160, 120, [0; 3]);
        for p in &mut image.data {
            *p = [0, 1, 2].map(|_| (level + sigma * dice.normal()).round() as u8);
        }
        image
    }

    #[test]
    fn noise_is_found_though_a_subject_covers_a_third() {
        let mut dice = proof::Dice(3);
        let plate = Rgb::filled(160, 120, [120; 3]);
        for sigma in [2.0, 9.0] {
            let mut photo = noisy(120.0, sigma, &mut dice);
            photo.data[..6400].fill([30, 200, 90]);
            let noise = Noise::measure(&photo, &plate, &|_, _| Ground::Wall, 1);
            // A third of the differences are the subject's, so the quantile is somewhat high.
            let times = f64::from(noise.still) / (sigma * f64::from(UNEVEN_FACTOR));
            assert!((1.0..1.8).contains(&times), "{noise:?}");
            // Nine pixels of three channels each.
            let light =
                f64::from(noise.light) / (sigma / 27f64.sqrt() / 123.0 * f64::from(UNEVEN_FACTOR));
            assert!((1.0..1.8).contains(&light), "{noise:?}");
        }
    }

    #[test]
    fn a_density_is_thinner_by_what_a_normal_one_loses() {
        let thinner = |levels| Noise::even(levels).thinner();
        assert_eq!(thinner(1.5), 0.0);
        assert!((thinner(8.0) - thinner(4.0) - 3.0 * libm::log(2.0)).abs() < 1e-6);
        assert!(thinner(1.9) > 0.0 && thinner(1.9) < 0.3);
    }
}
