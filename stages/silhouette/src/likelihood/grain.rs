//! Whether what is on the disk shows the grain that the disk shows there without the subject.
//!
//! A shadow on the disk changes from place to place slowly and alike in all channels: in a small window
//! a photo shows what the map of the disk shows there, times a light that is a plane. Feet of the wood's
//! colour in another light have neither its grain nor quite its hue. While the map is made of all photos,
//! what is left after the best light is compared with what is left at the same place of the disk in the other
//! photos: maps are never quite sharp, and tags leave more than wood. Once the scene behind is known, by a
//! plate or by all photos, one photo suffices (`in_photo.rs`).

use crate::likelihood::background::CAP;
use crate::likelihood::body::{OWN_COLOR, body_cost};
use crate::likelihood::gmm::Gmm;
use crate::likelihood::person::SURE;
use crate::likelihood::prepared::{Prepared, UNSEEN};
use crate::scene::disk_map::point;
use crate::scene::disk_plane::on_disk;
use crate::scene::still_and_disk::{Scene, Shot};
use nalgebra::Point2;
use rayon::prelude::*;
use shape::Image;

mod in_photo;
mod window;

pub(crate) use in_photo::missed_in_photo;

/// Least mean square of what is left, over all channels: that of rounding and a little noise. By hand: looked at scenes
/// 131 with a plate and 132 without, at 0.7 and 1.4 of it: mean IoU at most −0.0000 and +0.0000. \[levels²\]
const LEAST_LEFT_OVER: f32 = 1.0;
/// So many independent differences count: neighbours share noise and blur. By hand: looked at scene 131 with a plate,
/// at 0.7 and 1.4 of it: mean IoU +0.0001 and −0.0000.
const COUNTED_DIFFERENCES: f32 = 4.0;

/// Raises what pixels cost as the disk where they lack its grain; where nobody saw the disk nothing can be
/// known. `covered` is what cannot show it; colours that the `body` evidently has not are not asked.
pub(crate) fn missed(
    ready: &mut [Prepared],
    shots: &[Shot],
    around: &Scene,
    covered: &[Image<bool>],
    body: Option<&Gmm>,
) {
    for (ready, strange) in ready.iter_mut().zip(strange(shots, around, covered)) {
        for (i, strange) in strange.into_iter().enumerate() {
            if ready.cost[i] != UNSEEN && has(body, ready.small.data[i]) {
                ready.raise(i, strange.min(CAP));
            }
        }
    }
}

/// What it costs to call each pixel of each photo the bare disk, beyond its own colour: 0 off the
/// disk, and where nothing is known.
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

/// What is left of each pixel of a photo that may show the disk.
fn left_over(shot: &Shot, around: &Scene) -> Image<f32> {
    let behind = around.behind(&shot.small, &shot.camera);
    let (top, width) = (shot.top(around.radius), shot.small.width);
    let on = |i: usize| behind.seen.data[i] && top.at(i % width, i / width).is_some();
    window::left_over(&shot.small, &behind.image, 1, on)
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
            let known = inside && !covered[k].at(x, y) && image.at(x, y) < f32::MAX;
            known.then(|| image.at(x, y))
        };
        let mut all: Vec<f32> = (0..shots.len()).filter_map(of).collect();
        all.sort_by(f32::total_cmp);
        (all.len() >= 3).then(|| all[all.len() / 2].max(LEAST_LEFT_OVER))
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
    // From the side the map's points are elsewhere than from the front.
    let middle = bare.get(bare.len() / 2).map_or(1.0, |m| m.max(1.0));
    let cost = |t: &Option<f32>| t.map_or(0.0, |t| unlikely(t / middle));
    times.iter().map(cost).collect()
}

/// Whether the body evidently has a colour elsewhere; where nothing is evident it may have any. Between feet
/// on a printed mat the light is no plane within a window; there colours tell.
fn has(body: Option<&Gmm>, color: [u8; 3]) -> bool {
    body.is_none_or(|body| body_cost(body, color) < OWN_COLOR)
}

/// -ln of how much less likely a variance `times` the usual is than the usual one; 0 up to where photos
/// differ by themselves.
fn unlikely(times: f32) -> f32 {
    let times = times.max(1.0);
    let cost = COUNTED_DIFFERENCES / 2.0 * (times - 1.0 - libm::logf(times));
    if cost < SURE { 0.0 } else { cost }
}

#[cfg(test)]
mod tests;
