//! The edge of a turning disk: its rim is round, so that it projects to one fixed ellipse.
//!
//! A circle about the axis is as good an edge as the lower quartile of its steps of colour: three of four go the same way and
//! are at least so large, on the near side and on the far one. What follows a circle for a part of it (a skirting board, planks,
//! a picture's frame) is none. Circles are looked at on a reduced picture first, where an edge is as wide as the way from one to
//! the next, then the best of them on ever larger ones.

use crate::frame::disk_exact::{NEAR, Rim, angle, aside, exact};
use crate::frame::disk_steps::{Steps, levels};
use nalgebra::{Point3, Vector2, Vector3};
use rayon::prelude::*;
use shape::{Camera, Rgb};
use std::f64::consts::TAU;

/// A disk's upper edge about the z axis, in the camera's unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DiskEdge {
    /// Height of the edge.
    pub height: f64,
    /// Its radius.
    pub radius: f64,
    /// What three in four of the steps of colour across it reach, over the usual size of steps across the circles that were tried.
    pub standout: f64,
}

/// Steps of half a level are none, whatever the rest are: files hold whole levels (derived: what rounding hides).
/// \[levels\]
const LEAST_STEP_LEVELS: f64 = 0.5;
/// By how much the pictures are reduced that are looked at one after the other, and points around an edge on each (structural: a
/// pyramid, samples).
const LOOKS: [(usize, usize); 3] = [(4, 48), (2, 96), (1, 96)];
/// Smaller pictures are not looked at: edges beside each other become one (structural: a pyramid's end). \[px\]
const LEAST_SIDE_PX: usize = 200;
/// Heights and radii that are looked at at most: cameras that hardly turn have no end of them (structural: a bound of work).
const MOST_CELLS: usize = 1000;
/// So many of the strongest circles are looked at on larger pictures; where one edge is no disk's, many are along it.
/// It is structural: the width of a search.
const PEAKS: usize = 30;

/// An edge above the strongest is the disk's from this share of its strength on. By hand: looked at forty captures by twenty
/// cameras, from 0.25 to 0.5 the same edges; at 0.75 the lower one of one, at 1 of two (docs/lab/disks.md).
const UPPER_SHARE: f64 = 0.5;
/// Edges are two from so many cells of the first search on (structural: beside each other they are one).
const OFF_CELLS: f64 = 3.0;

/// Whether a circle of a height and a radius can be a disk's.
pub type May<'a> = &'a (dyn Fn(f64, f64) -> bool + Sync);

/// A rim and how good an edge it is.
type Circle = (Rim, f64);

/// A picture of some size, with its camera.
struct Look {
    picture: Rgb,
    camera: Camera,
    /// Sine and cosine of the angles around the axis.
    around: Vec<[f64; 2]>,
}

/// Finds the round edge with the strongest step, within heights and radii. Of edges nearly as strong (a disk has a lower one
/// too) the upper is taken. `may` is whether a circle of a height and a radius can be a disk's.
pub fn disk_edge(
    picture: &Rgb,
    camera: &Camera,
    heights: [f64; 2],
    radii: [f64; 2],
    may: May<'_>,
) -> Option<DiskEdge> {
    let look = |(by, points): (usize, usize)| {
        let picture = picture.reduced(by);
        let camera = camera.resized(picture.width as u32, picture.height as u32);
        let turns = (0..points).map(|k| angle(&camera, k as f64 / points as f64, TAU));
        let around = turns.map(|turn| libm::sincos(turn).into()).collect();
        Look {
            picture,
            camera,
            around,
        }
    };
    let side = picture.width.max(picture.height);
    let looks = LOOKS
        .into_iter()
        .filter(|(by, _)| *by == 1 || side / by >= LEAST_SIDE_PX);
    let looks: Vec<Look> = looks.map(look).collect();
    let (coarse, whole) = (looks.first()?, looks.last()?);
    let cell = cell(&coarse.camera);
    let far = |at: f64, [low, high]: [f64; 2]| (low - at).max(at - high);
    let may = &|z, r| far(z, heights) <= cell && far(r, radii) <= 0.0 && may(z, r);
    let (mut peaks, usual) = coarse.peaks(heights, radii, cell, may);
    let mut reach = cell;
    for look in &looks {
        peaks = peaks
            .into_par_iter()
            .filter_map(|(rim, _)| look.climbed(rim, reach, may))
            .collect();
        reach *= 0.5;
    }
    let (found, evident) = upper(&peaks, OFF_CELLS * cell)?;
    // To a part of a pixel where that can be a disk's, too.
    let laid = whole.exact(found).filter(|rim| may(rim.x, rim.y));
    let rim = laid.unwrap_or(found);
    Some(DiskEdge {
        height: rim.x,
        radius: rim.y,
        standout: evident / usual.max(LEAST_STEP_LEVELS),
    })
}

/// What is a pixel at the axis.
fn cell(camera: &Camera) -> f64 {
    let centre = camera.centre();
    libm::hypot(centre.x, centre.y) / camera.lens.focal[1]
}

/// The strongest of the circles, or of those that are above it by more than it can be off and nearly as strong.
fn upper(tried: &[Circle], off: f64) -> Option<Circle> {
    let strongest = |of: &mut dyn Iterator<Item = Circle>| of.max_by(|a, b| a.1.total_cmp(&b.1));
    let first = strongest(&mut tried.iter().copied())?;
    let above = |t: &Circle| t.1 >= UPPER_SHARE * first.1 && t.0.x > first.0.x + off;
    strongest(&mut tried.iter().copied().filter(above)).or(Some(first))
}

impl Look {
    /// The strongest of the circles that are edges and better ones than those beside them; beside them the usual size of steps.
    fn peaks(
        &self,
        heights: [f64; 2],
        radii: [f64; 2],
        cell: f64,
        may: May<'_>,
    ) -> (Vec<Circle>, f64) {
        let count = |[low, high]: [f64; 2]| ((high - low) / cell).ceil() as usize;
        let [rows, columns] = [heights, radii].map(|range| count(range).min(MOST_CELLS) + 1);
        let at = |[low, high]: [f64; 2], k: usize, count: usize| {
            low + (high - low) * k as f64 / (count - 1).max(1) as f64
        };
        let tried: Vec<(Circle, f64)> = (0..rows * columns)
            .into_par_iter()
            .map(|k| {
                let z = at(heights, k / columns, rows);
                let r = at(radii, k % columns, columns);
                let rim = Rim::new(z, r, 0.0);
                match may(z, r).then(|| self.steps(&rim)).flatten() {
                    Some(steps) => ((rim, steps.evident()), steps.usual()),
                    None => ((rim, 0.0), 0.0),
                }
            })
            .collect();
        let usual = tried.iter().map(|t| t.1).filter(|u| *u > 0.0);
        let usual = shape::upper_median(usual).unwrap_or(0.0);
        let near = |k: usize, count: usize| k.saturating_sub(1)..=(k + 1).min(count - 1);
        let peak = |k: &usize| {
            let (i, j) = (k / columns, k % columns);
            let mut around =
                near(i, rows).flat_map(|a| near(j, columns).map(move |b| a * columns + b));
            let this = tried[*k].0.1;
            this > 0.0 && around.all(|other| tried[other].0.1 <= this)
        };
        let mut peaks: Vec<Circle> = (0..tried.len()).filter(peak).map(|k| tried[k].0).collect();
        peaks.sort_by(|a, b| b.1.total_cmp(&a.1));
        peaks.truncate(PEAKS);
        (peaks, usual)
    }

    /// The rim near one across which the picture changes most, if it is an edge, and may be a disk's.
    fn climbed(&self, mut rim: Rim, mut reach: f64, may: May<'_>) -> Option<Circle> {
        let mean = |rim: &Rim| self.steps(rim).map(|steps| steps.mean());
        let mut most = mean(&rim)?;
        let sides = [-1.0, 0.0, 1.0];
        let plane = sides.iter().flat_map(|a| sides.map(|b| (*a, b)));
        let ways = plane.flat_map(|(a, b)| sides.map(|c| Rim::new(a, b, c)));
        let ways: Vec<Rim> = ways.collect();
        for _ in 0..12 {
            let mut best = (rim, most);
            for way in &ways {
                let other = rim + way * reach;
                if let Some(c) = mean(&other).filter(|c| *c > best.1) {
                    best = (other, c);
                }
            }
            if best.1 <= most {
                reach *= 0.6;
            }
            (rim, most) = best;
        }
        let evident = self.steps(&rim)?.evident();
        (evident > 0.0 && may(rim.x, rim.y)).then_some((rim, evident))
    }

    /// A rim laid on its edge to a part of a pixel.
    fn exact(&self, rim: Rim) -> Option<Rim> {
        let ways = self.steps(&rim)?.ways();
        let light = shape::light_of_levels().map(|light| 255.0 * light);
        let of = |way: Vector3<f64>| {
            let toward = |c: usize, level: u8| way[c] as f32 * light[usize::from(level)];
            let picture = &self.picture;
            picture.map(|levels| (0..3).map(|c| toward(c, levels[c])).sum())
        };
        exact(&ways.map(of), &self.camera, rim)
    }

    /// Steps outwards along a rim. `None` where half of it is not on the picture.
    fn steps(&self, rim: &Rim) -> Option<Steps> {
        let Look {
            picture, camera, ..
        } = self;
        let (centre, points) = (camera.centre(), self.around.len());
        let middle = Point3::new(0.0, 0.0, rim.x) + aside(camera) * rim.z;
        let mut steps = Steps {
            points,
            ..Steps::default()
        };
        for (k, [sin, cos]) in self.around.iter().copied().enumerate() {
            if steps.count() + points - k < points / 2 {
                return None;
            }
            let at = middle + Vector3::new(cos, sin, 0.0) * rim.y;
            let (at, by_place) = camera.project_with_jacobian(&at)?;
            let along = (by_place * Vector3::new(-sin, cos, 0.0)).try_normalize(1e-9)?;
            let across = NEAR * Vector2::new(along.y, -along.x);
            if let (Some(out), Some(inside)) =
                (levels(picture, at + across), levels(picture, at - across))
            {
                let far = centre.x * cos + centre.y * sin < rim.y;
                steps.sides[usize::from(far)].push(out - inside);
            }
        }
        Some(steps)
    }
}

#[cfg(test)]
mod tests;
