//! A plate mended by the photos: where the network is sure of nobody, they show the scene, too, and in their own light.
//!
//! Something was moved, the lens was focused elsewhere, the sun came out: then a plate is not what is behind somebody. At each
//! pixel where it is farther from the mean of what photos show than they differ among each other, that mean takes its place.

use crate::align::reduced::factor;
use crate::likelihood::grounds::Ground;
use crate::likelihood::local_light::{lit, local_light};
use crate::likelihood::noise::Noise;
use crate::likelihood::person::{sense, surely_nobody};
use crate::likelihood::prepared::COARSE_REACH_PX;
use crate::scene::disk_map::RIM;
use crate::scene::disk_plane::DiskTop;
use rayon::prelude::*;
use shape::{Aligned, People, PhotoId, Rgb, Scene, Tones};

/// Photos that are decoded at a time (structural: memory; sums are of whole numbers, in whatever order).
const AT_A_TIME: usize = 8;
/// A mean of fewer is none (structural: a mean of two hardly shows how far they differ).
const FEW: u32 = 3;
/// So many variances of one channel is the plate off in all three (derived: 0.3 % of χ² with three degrees are beyond).
const BEYOND_VARIANCES: f64 = 13.9;
/// Variance of a level that was rounded on a photo and on the plate (derived: twice 1/12).
const ROUNDED: f64 = 1.0 / 6.0;

/// What photos show at a pixel, in the plate's levels.
#[derive(Clone, Copy, Default)]
struct Shown {
    count: u32,
    sums: [u32; 3],
    /// Sum of the squares of all channels.
    squares: u32,
    /// Sum of the squares by which they are off the plate.
    off: u32,
}

impl Shown {
    fn add(&mut self, color: [u8; 3], plate: [u8; 3]) {
        self.count += 1;
        for c in 0..3 {
            let (v, far) = (u32::from(color[c]), u32::from(color[c].abs_diff(plate[c])));
            self.sums[c] += v;
            self.squares += v * v;
            self.off += far * far;
        }
    }

    /// The mean, if the plate is farther from it than noise brings one photo more.
    fn better(&self) -> Option<[u8; 3]> {
        let count = f64::from(self.count);
        let square = |sum: &u32| f64::from(*sum) * f64::from(*sum);
        let within = f64::from(self.squares) - self.sums.iter().map(square).sum::<f64>() / count;
        let plate_off = (f64::from(self.off) - within) / count;
        // Of one channel, about the mean of so many.
        let variance = within / (3.0 * (count - 1.0)) * (1.0 + 1.0 / count);
        let mean = self.sums.map(|s| (f64::from(s) / count).round() as u8);
        (self.count >= FEW && plate_off > BEYOND_VARIANCES * variance.max(ROUNDED)).then_some(mean)
    }
}

/// A photo in the plate's levels and light, and where the network is sure that it shows nobody.
struct Free {
    pixels: Rgb,
    /// Log-odds of a person on reduced pixels, row by row.
    odds: Vec<f32>,
    /// How many pixels along a side became one of those.
    by: usize,
}

impl Free {
    fn at(&self, x: usize, y: usize) -> bool {
        let (x, y, wide) = (x / self.by, y / self.by, self.pixels.width / self.by);
        x < wide && surely_nobody(&self.odds, y * wide + x)
    }
}

/// The scene of a plate, mended where photos show another; as it is where no person is seen. `photo` is each, where all are
/// aligned.
pub(crate) fn mended<E: Send>(
    known: &Scene,
    aligned: &Aligned,
    people: Option<&People>,
    photo: impl Fn(PhotoId) -> Result<Option<Rgb>, E> + Sync,
) -> Result<Scene, E> {
    let mut scene = known.clone();
    let plate = &known.still.image;
    let seen = |id: &PhotoId| people.is_some_and(|people| people.subject(*id).is_some());
    let all = known.views.iter().map(|(id, _)| id);
    let all: Vec<PhotoId> = all.filter(seen).collect();
    if all.is_empty() {
        return Ok(scene);
    }
    let mut shown = vec![Shown::default(); plate.data.len()];
    let turns = on_disk(aligned, [plate.width, plate.height]);
    for some in all.chunks(AT_A_TIME) {
        let one = |id: &PhotoId| -> Result<Option<Free>, E> {
            let fits = |p: &Rgb| (p.width, p.height) == (plate.width, plate.height);
            let Some(mut pixels) = photo(*id)?.filter(fits) else {
                return Ok(None);
            };
            if let Some(tones) = known.views.get(*id).and_then(|view| view.tones.as_ref()) {
                pixels = shape::toned(&pixels, &undone(tones));
            }
            let by = factor(&pixels, aligned.coarse_px as usize);
            let odds = sense(people, *id, [pixels.width / by, pixels.height / by], by);
            let pixels = in_plates_light(&pixels, plate, &turns, &odds, by);
            Ok(Some(Free { pixels, odds, by }))
        };
        let some: Vec<_> = some.par_iter().map(one).collect::<Result<_, _>>()?;
        let rows = shown.par_chunks_mut(plate.width).enumerate();
        rows.for_each(|(y, row)| {
            for photo in some.iter().flatten() {
                for (x, shown) in row.iter_mut().enumerate() {
                    let i = y * plate.width + x;
                    if !turns[i] && photo.at(x, y) {
                        shown.add(photo.pixels.data[i], plate.data[i]);
                    }
                }
            }
        });
    }
    let still = scene.still.image.data.iter_mut().zip(&shown);
    still.for_each(|(to, shown)| *to = shown.better().unwrap_or(*to));
    Ok(scene)
}

/// A photo in the light of the plate: where that differs place by place, nothing was moved.
fn in_plates_light(pixels: &Rgb, plate: &Rgb, turns: &[bool], odds: &[f32], by: usize) -> Rgb {
    let (small, expected) = (pixels.reduced(by), plate.reduced(by));
    let on = |x: usize, y: usize| match turns[y * by * plate.width + x * by] {
        true => Ground::Disk,
        false => Ground::Wall,
    };
    let both = [&small, &expected];
    let noise = Noise::measure(&small, &expected, &on, COARSE_REACH_PX);
    let mut light = local_light(both, &on, odds, &noise, COARSE_REACH_PX);
    light.iter_mut().for_each(|times| *times = 1.0 / *times);
    lit(pixels, &light, by)
}

/// Where the disk's top is, which turns.
fn on_disk(aligned: &Aligned, [width, height]: [usize; 2]) -> Vec<bool> {
    let mut on = vec![false; width * height];
    let first = aligned.cameras.as_ref().and_then(|c| c.views.iter().next());
    let camera = first.and_then(|(id, _)| aligned.camera(id));
    let Some((camera, radius)) = camera.zip(aligned.disk_radius_mm()) else {
        return on;
    };
    let top = DiskTop::of(&camera, radius * RIM, [width, height]);
    top.pixels().for_each(|(x, y, _)| on[y * width + x] = true);
    on
}

/// What brings levels back: of each level the one that becomes it, or the nearest to it.
fn undone(tones: &Tones) -> Tones {
    tones.map(|of| {
        let mut back = [0u8; 256];
        for (level, to) in back.iter_mut().enumerate() {
            let far = |from: &usize| usize::from(of[*from]).abs_diff(level);
            *to = (0..256).min_by_key(far).unwrap_or(level) as u8;
        }
        back
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(colors: &[[u8; 3]], plate: [u8; 3]) -> Option<[u8; 3]> {
        let mut shown = Shown::default();
        colors.iter().for_each(|color| shown.add(*color, plate));
        shown.better()
    }

    #[test]
    fn where_photos_agree_on_another_colour_it_is_the_scenes() {
        let wall = [
            [100, 120, 140],
            [102, 119, 141],
            [99, 121, 139],
            [101, 120, 140],
        ];
        assert_eq!(shown(&wall, [60, 40, 30]), Some([101, 120, 140]));
        assert_eq!(shown(&wall, [102, 119, 142]), None, "as near as a photo");
        assert_eq!(shown(&wall[..2], [60, 40, 30]), None, "too few");
        // They differ by as much among each other as from the plate.
        let moving = [[20, 20, 20], [220, 220, 220], [20, 20, 20], [220, 220, 220]];
        assert_eq!(shown(&moving, [120, 120, 120]), None);
    }

    #[test]
    fn levels_come_back() {
        let mut brighter = [[0u8; 256]; 3];
        for tones in &mut brighter {
            for (level, to) in tones.iter_mut().enumerate() {
                *to = (1.25 * level as f32).round().min(255.0) as u8;
            }
        }
        let back = undone(&brighter);
        for level in 0..200 {
            let there = brighter[1][level] as usize;
            assert!(back[1][there].abs_diff(level as u8) <= 1, "{level}");
        }
    }
}
