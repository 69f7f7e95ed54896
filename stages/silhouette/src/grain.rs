//! Whether what lies on the disk shows the grain that the disk shows there in the other photos.
//!
//! A shadow on the disk changes from place to place slowly and alike in all channels: in a small window
//! a photo shows what the map of the disk shows there, times a light that is a plane. Feet of the wood's
//! colour in another light have neither its grain nor quite its hue. What is left after the best light is
//! held against what is left at the same place of the disk in the other photos: maps are never quite
//! sharp, and tags leave more than wood.

use crate::around::least_around;
use crate::background::on_disk;
use crate::disk_top::point;
use crate::photo_cut::{Prepared, UNSEEN};
use crate::scene::{Scene, Shot};
use crate::unary::{CAP, FLAT, slack};
use nalgebra::{Matrix3, Point2, Vector3};
use rayon::prelude::*;
use shape::{Image, Rgb};

/// Half the side of the window in which the light is a plane. \[px of the reduced photo\]
const REACH: usize = 3;
/// Least mean square of what is left, over all channels: that of rounding and a little noise. \[levels²\]
const LEAST: f32 = 1.0;
/// So many independent differences count in a window: neighbours share noise and blur. Set by hand.
const COUNTED: f32 = 4.0;
/// What costs less tells nothing: beside soles shadows end within a window. Set by hand.
const TELLS: f32 = 3.0;
/// Least share of a window that must lie on the disk.
const ON_IT: f32 = 0.5;

/// Raises what pixels cost as the disk where they lack its grain; where nobody saw the disk nothing can be
/// told. `covered` is what cannot show it.
pub(crate) fn missed(
    ready: &mut [Prepared],
    shots: &[Shot],
    around: &Scene,
    covered: &[Image<bool>],
) {
    for (ready, strange) in ready.iter_mut().zip(strange(shots, around, covered)) {
        for (cost, strange) in ready.cost.iter_mut().zip(strange) {
            if *cost != UNSEEN && strange > 0.0 {
                *cost = cost.max(FLAT + strange.min(CAP));
            }
        }
    }
}

/// What it costs to call each pixel of each photo the bare disk, beyond what its own colour says: 0 off the
/// disk, and where nothing can be told.
fn strange(shots: &[Shot], around: &Scene, covered: &[Image<bool>]) -> Vec<Vec<f32>> {
    if around.radius <= 0.0 {
        return Vec::new();
    }
    let left: Vec<Image<f32>> = shots.par_iter().map(|s| left_over(s, around)).collect();
    let usual = usual(shots, around, &left, covered);
    let all = shots.par_iter().zip(&left).zip(covered);
    all.map(|((shot, left), covered)| costs(shot, around, left, &usual, covered))
        .collect()
}

/// What a window around each pixel leaves at the best light, the least of all windows that hold the pixel;
/// infinite where none lies on the disk far enough.
fn left_over(shot: &Shot, around: &Scene) -> Image<f32> {
    let behind = around.behind(&shot.small, &shot.camera);
    let (width, height) = (shot.small.width, shot.small.height);
    let on: Vec<bool> = (0..width * height)
        .map(|i| behind.seen.data[i] && shot.shows_disk(i, around.radius))
        .collect();
    let disk = Laid {
        photo: &shot.small,
        map: &behind.image,
        on: Image {
            width,
            height,
            data: on,
        },
    };
    let windows: Vec<f32> = (0..width * height)
        .map(|i| match disk.on.data[i] {
            true => disk.window(i % width, i / width).unwrap_or(f32::MAX),
            false => f32::MAX,
        })
        .collect();
    Image {
        width,
        height,
        data: least_around(&windows, width, REACH),
    }
}

/// A photo, what the disk would show there, and where that is known.
struct Laid<'a> {
    photo: &'a Rgb,
    map: &'a Rgb,
    on: Image<bool>,
}

impl Laid<'_> {
    /// The mean square of what the best plane of light leaves of a window around a pixel, all channels
    /// together. \[levels²\] `None` where too little of it lies on the disk.
    fn window(&self, x: usize, y: usize) -> Option<f32> {
        let (width, height) = (self.on.width, self.on.height);
        let rows = y.saturating_sub(REACH)..(y + REACH + 1).min(height);
        let columns = x.saturating_sub(REACH)..(x + REACH + 1).min(width);
        let places = rows.flat_map(|y| columns.clone().map(move |x| (x, y)));
        let places: Vec<(usize, usize)> = places.filter(|(x, y)| self.on.at(*x, *y)).collect();
        let side = (2 * REACH + 1) as f32;
        if (places.len() as f32) < ON_IT * side * side {
            return None;
        }
        let at = |(column, row): (usize, usize)| {
            let place = |v: usize, middle: usize| (v as f32 - middle as f32) / REACH as f32;
            Vector3::new(1.0, place(column, x), place(row, y))
        };
        // Least squares of photo = (a + b x + c y) map; slopes are held a little, for a window may be thin.
        let mut normal = Matrix3::from_diagonal(&Vector3::new(1e-3, 1e-2, 1e-2));
        let mut wanted = Vector3::zeros();
        for place in &places {
            let (p, m) = self.colors(*place);
            let (u, mm, mp) = (at(*place), dot(m, m), dot(m, p));
            normal += u * u.transpose() * mm;
            wanted += u * mp;
        }
        let light = normal.lu().solve(&wanted)?;
        let left = places.iter().map(|place| {
            let (p, _) = self.colors(*place);
            let (lo, hi) = slack(self.map, place.0, place.1);
            let l = light.dot(&at(*place)).max(0.0);
            (0..3)
                .map(|c| (lo[c] * l - p[c]).max(p[c] - hi[c] * l).max(0.0))
                .map(|d| d * d)
                .sum::<f32>()
        });
        Some(left.sum::<f32>() / places.len() as f32)
    }

    fn colors(&self, (x, y): (usize, usize)) -> ([f32; 3], [f32; 3]) {
        let at = |of: &Rgb| of.at(x, y).map(f32::from);
        (at(self.photo), at(self.map))
    }
}

fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// What is usually left at each place of the disk's map: the median of the photos that can show it there,
/// where three can.
fn usual(
    shots: &[Shot],
    around: &Scene,
    left: &[Image<f32>],
    covered: &[Image<bool>],
) -> Image<Option<f32>> {
    let side = around.disk.image.width;
    let one = |i: usize| {
        let at = point(i, around.radius, side)?;
        let of = |k: usize| {
            let px = shots[k].camera.project(&at)?;
            let (x, y) = (px.x.round(), px.y.round());
            let image = &left[k];
            let inside = x >= 0.0 && y >= 0.0 && x < image.width as f64 && y < image.height as f64;
            let (x, y) = (x.max(0.0) as usize, y.max(0.0) as usize);
            let told = inside && !covered[k].at(x, y) && image.at(x, y) < f32::MAX;
            told.then(|| image.at(x, y))
        };
        let mut all: Vec<f32> = (0..shots.len()).filter_map(of).collect();
        all.sort_by(f32::total_cmp);
        (all.len() >= 3).then(|| all[all.len() / 2].max(LEAST))
    };
    Image {
        width: side,
        height: side,
        data: (0..side * side).into_par_iter().map(one).collect(),
    }
}

/// The costs of one photo: by how much more is left than usual there and in this photo.
fn costs(
    shot: &Shot,
    around: &Scene,
    left: &Image<f32>,
    usual: &Image<Option<f32>>,
    covered: &Image<bool>,
) -> Vec<f32> {
    let (width, side, radius) = (left.width, usual.width, around.radius);
    let times: Vec<Option<f32>> = (0..left.data.len())
        .map(|i| {
            let here = left.data[i];
            if here == f32::MAX {
                return None;
            }
            let at = Point2::new((i % width) as f64, (i / width) as f64);
            let hit = on_disk(&shot.camera, at, radius)?;
            let place = |v: f64| {
                let at = ((v / radius + 1.0) / 2.0 * side as f64 - 0.5).round();
                (at.max(0.0) as usize).min(side - 1)
            };
            Some(here / usual.at(place(hit.x), place(hit.y))?)
        })
        .collect();
    let free = times.iter().zip(&covered.data);
    let mut bare: Vec<f32> = free.filter(|(_, c)| !**c).filter_map(|(t, _)| *t).collect();
    bare.sort_by(f32::total_cmp);
    // From the side the map's points lie otherwise than from the front.
    let middle = bare.get(bare.len() / 2).map_or(1.0, |m| m.max(1.0));
    let cost = |t: &Option<f32>| t.map_or(0.0, |t| unlikely(t / middle));
    times.iter().map(cost).collect()
}

/// -ln of how much less likely a variance `times` the usual is than the usual one; 0 up to where photos
/// differ by themselves.
fn unlikely(times: f32) -> f32 {
    let times = times.max(1.0);
    let cost = COUNTED / 2.0 * (times - 1.0 - libm::logf(times));
    if cost < TELLS { 0.0 } else { cost }
}

#[cfg(test)]
mod tests;
