//! What a glossy disk mirrors of the body.
//!
//! A level mirror shows the body a second time, upside down below the disk's top. There the disk shows a share of the body's
//! light in place of what it mirrors when it is empty, so a photo gains `share · body − empty`: both are fitted to all photos
//! together by least squares, on pixels of the disk beside the body. Of the body's colour a photo shows nearly what the
//! mirror does. The body is the hull of what evidently is no scene; on the disk that may be a reflection, so there it has
//! colours that are seen above the disk.

use crate::align::cameras::aligned_alike;
use crate::cells::Block;
use crate::consensus::{DISSENT, Together, View};
use crate::likelihood::body::{OWN_COLOR, body_cost, evident};
use crate::likelihood::disk_colors::mixture;
use crate::raster::as_mask;
use crate::scene::disk_map::RIM;
use crate::scene::disk_plane::{DiskTop, on_disk};
use nalgebra::{Point2, Point3};
use rayon::prelude::*;
use shape::{Aligned, ByPhoto, Camera, Mask, PhotoEvidence, PhotoId, Rgb};

/// Cells beside the hull in which it may be mirrored, too (derived: a cell's own size and a coat, as far as the hull may be off).
const COAT: f64 = 2.0;
/// What is farther off than this many standard deviations is no reflection (derived: normal ones of three channels are
/// three times in 10 000).
const OUTLIER: f32 = 2.5;
/// Rounds of leaving such out (structural).
const ROUNDS: usize = 4;
/// Levels of files go by about this power of the light (IEC 61966-2-1, 1999).
const GAMMA: f32 = 2.2;

/// A reduced photo's evidence, and what the photo would show without the body and its reflection.
pub(crate) type Weighed = (PhotoEvidence, Rgb);
/// The light of the body that is mirrored, and the light that the photo gained there.
type Sample = ([f32; 3], [f32; 3]);

/// The light that each photo's pixels gain by what the disk mirrors, three channels a pixel; nothing where that explains
/// less than it leaves.
pub(crate) fn gained(all: &ByPhoto<Weighed>, aligned: &Aligned) -> Option<ByPhoto<Vec<f32>>> {
    let (cameras, radius) = (aligned_alike(aligned)?, aligned.disk_radius_mm()? * RIM);
    let mask = |(id, (evidence, _)): (PhotoId, &Weighed)| {
        let [width, height] = [evidence.photo.width, evidence.photo.height].map(|v| v as u32);
        let camera = cameras.views.get(id)?.camera.resized(width, height);
        Some((id, body(evidence, &camera, radius)))
    };
    let masks: Vec<(PhotoId, Mask)> = all.iter().filter_map(mask).collect();
    let together = Together::of(&masks, &cameras)?;
    let solid: Vec<bool> = together.against.iter().map(|n| *n <= DISSENT).collect();
    let wide = together.block.grown(&together.block.grown(&solid));
    let one = |view: &View<'_>| {
        let (id, mask, camera) = view;
        let (evidence, without) = all.get(*id)?;
        let reflection = Reflection::of(&together.block, &solid, view, &evidence.photo, radius);
        let near = together.block.shown(&wide, camera, mask.width, mask.height);
        let sample = |i: &usize| {
            let off = |c| light(evidence.photo.data[*i][c]) - light(without.data[*i][c]);
            Some((reflection.light[*i]?, [off(0), off(1), off(2)]))
        };
        let free = reflection.middles.iter().filter(|i| !near.data[**i]);
        let samples: Vec<Sample> = free.filter_map(sample).collect();
        Some((*id, reflection.light, samples))
    };
    let each: Vec<_> = together.views.par_iter().filter_map(one).collect();
    let samples = each.iter().flat_map(|(_, _, samples)| samples);
    let gloss = Gloss::of(samples.copied().collect())?;
    let gain = |light: Option<[f32; 3]>| light.map_or([0.0; 3], |light| gloss.gain(light));
    let gains = |light: Vec<Option<[f32; 3]>>| light.into_iter().flat_map(gain).collect();
    let gains = each.into_iter().map(|(id, light, _)| (id, gains(light)));
    Some(gains.collect())
}

/// What a photo would show without the body but with its reflection, by what each of its reduced pixels gains.
pub(crate) fn mirroring(without: &Rgb, gained: &[f32], factor: usize) -> Rgb {
    let (width, wide) = (without.width, without.width / factor);
    let mut image = without.clone();
    for (i, to) in image.data.iter_mut().enumerate() {
        let (x, y) = (i % width / factor, i / width / factor);
        let more = gained
            .get(3 * (y * wide + x)..)
            .and_then(|all| all.first_chunk::<3>());
        if let Some(more) = more.filter(|more| x < wide && **more != [0.0; 3]) {
            *to = [0, 1, 2].map(|c| level(light(to[c]) + more[c]));
        }
    }
    image
}

/// What evidently is no scene, and on the disk has a colour of what is so beyond it.
fn body(evidence: &PhotoEvidence, camera: &Camera, radius: f64) -> Mask {
    let photo = &evidence.photo;
    let size = [photo.width, photo.height];
    let mut shown = evident(&evidence.background, &evidence.known, size);
    let top = DiskTop::of(camera, radius, size);
    let on = |i: usize| top.at(i % photo.width, i / photo.width).is_some();
    let above = (0..photo.data.len()).filter(|i| shown.data[*i] && !on(*i));
    let colors: Vec<[u8; 3]> = above.map(|i| photo.data[i]).collect();
    if let Some(colors) = mixture(&colors) {
        for i in (0..photo.data.len()).filter(|i| on(*i)) {
            shown.data[i] &= body_cost(&colors, photo.data[i]) < OWN_COLOR;
        }
    }
    as_mask(&shown)
}

/// How a disk mirrors.
struct Gloss {
    /// The share of light that it mirrors.
    share: f32,
    /// The light that it mirrors of the empty scene.
    empty: [f32; 3],
}

impl Gloss {
    /// By all that is no outlier, if it explains half of what was gained.
    fn of(mut samples: Vec<Sample>) -> Option<Gloss> {
        let mut gloss = Gloss::fitted(&samples)?;
        for _ in 1..ROUNDS {
            let mean = gloss.left_of(&samples);
            samples.retain(|sample| gloss.left(sample) <= OUTLIER * OUTLIER * mean);
            gloss = Gloss::fitted(&samples)?;
        }
        let matt = Gloss {
            share: 0.0,
            empty: [0.0; 3],
        };
        (gloss.left_of(&samples) < 0.5 * matt.left_of(&samples)).then_some(gloss)
    }

    /// By least squares.
    fn fitted(samples: &[Sample]) -> Option<Gloss> {
        let mean = |of: &dyn Fn(&Sample) -> f32| {
            samples.iter().map(|s| f64::from(of(s))).sum::<f64>() as f32 / samples.len() as f32
        };
        let means = [0, 1, 2].map(|c| [mean(&|s| s.0[c]), mean(&|s| s.1[c])]);
        let sum = |with: &dyn Fn(&Sample, usize) -> f32| {
            let product = |s: &Sample, c: usize| (s.0[c] - means[c][0]) * with(s, c);
            mean(&|s| (0..3).map(|c| product(s, c)).sum())
        };
        let share = sum(&|s, c| s.1[c] - means[c][1]) / sum(&|s, c| s.0[c] - means[c][0]);
        let share = share.clamp(0.0, 1.0);
        let empty = means.map(|[light, gained]| share * light - gained);
        share.is_finite().then_some(Gloss { share, empty })
    }

    /// What a pixel gains that mirrors some light of the body.
    fn gain(&self, light: [f32; 3]) -> [f32; 3] {
        [0, 1, 2].map(|c| self.share * light[c] - self.empty[c])
    }

    /// The square that it leaves of what a sample gained.
    fn left(&self, (light, gained): &Sample) -> f32 {
        let off = self.gain(*light);
        (0..3)
            .map(|c| (off[c] - gained[c]) * (off[c] - gained[c]))
            .sum()
    }

    fn left_of(&self, samples: &[Sample]) -> f32 {
        samples.iter().map(|s| f64::from(self.left(s))).sum::<f64>() as f32 / samples.len() as f32
    }
}

/// The body as a level mirror at z = 0 shows it to a camera.
struct Reflection {
    /// The light of the body that each pixel mirrors, if any; in a coat around it that of what is nearest.
    light: Vec<Option<[f32; 3]>>,
    /// Pixels in the middle of a cell.
    middles: Vec<usize>,
}

impl Reflection {
    /// Of a block of which some cells are the body, whose mask has its colours.
    fn of(block: &Block, solid: &[bool], view: &View<'_>, photo: &Rgb, radius: f64) -> Reflection {
        let (_, mask, camera) = view;
        let (width, height) = (photo.width, photo.height);
        let mut nearest = vec![f64::MAX; width * height];
        let (mut lights, mut middles) = (vec![None; width * height], vec![]);
        let on = |at: Point2<f64>| camera.holds(at) && on_disk(camera, at, radius).is_some();
        for at in (0..solid.len())
            .filter(|i| solid[*i])
            .map(|i| block.centre(i))
        {
            let below = camera.project_with_depth(&Point3::new(at.x, at.y, -at.z));
            let Some((px, depth)) = below.filter(|(px, _)| on(*px)) else {
                continue;
            };
            let Some(shown) = camera.project(&at).filter(|px| mask.shows(*px)) else {
                continue;
            };
            let color = photo.at(shown.x.round() as usize, shown.y.round() as usize);
            middles.push(px.y.round() as usize * width + px.x.round() as usize);
            let reach = (0.5 + COAT) * block.cell * camera.lens.focal[0] / depth;
            let range = |c: f64, size: usize| {
                let from = (c - reach).ceil().max(0.0) as usize;
                from..((c + reach).floor() + 1.0).clamp(from as f64, size as f64) as usize
            };
            for (x, y) in range(px.y, height).flat_map(|y| range(px.x, width).map(move |x| (x, y)))
            {
                let i = y * width + x;
                if depth < nearest[i] && on(Point2::new(x as f64, y as f64)) {
                    (nearest[i], lights[i]) = (depth, Some(color.map(light)));
                }
            }
        }
        middles.sort_unstable();
        middles.dedup();
        Reflection {
            light: lights,
            middles,
        }
    }
}

/// The light of a level of a file. \[1 is white\]
fn light(level: u8) -> f32 {
    libm::powf(f32::from(level) / 255.0, GAMMA)
}

/// And back.
fn level(light: f32) -> u8 {
    (255.0 * libm::powf(light.clamp(0.0, 1.0), 1.0 / GAMMA)).round() as u8
}

#[cfg(test)]
mod tests;
