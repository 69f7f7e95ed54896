//! The grain of the disk in one photo, where the scene behind it is known at full size.
//!
//! How much of the bare disk is usually left is learned from the photo itself: more where the map is
//! rough, for no map fits a photo quite exactly, nor is it as sharp.

use super::window::Laid;
use super::{LEAST, has, unlikely};
use crate::cut::least_cut::Known;
use crate::likelihood::background::{CAP, FLAT};
use crate::likelihood::body::EVIDENT;
use crate::likelihood::disk_colors::mixture;
use crate::likelihood::gmm::Gmm;
use crate::likelihood::prepared::{Prepared, UNSEEN};
use crate::scene::disk_map::RIM;
use crate::scene::disk_plane::on_disk;
use nalgebra::Point2;
use shape::Rgb;

/// What costs so little more than the least as the disk may be it.
const BARE: f32 = 3.0;
/// Classes of places, from smooth to rough, of equal size (structural: samples).
const CLASSES: usize = 12;
/// Fewer bare places of a class give no median (structural: samples).
const FEW: usize = 40;

/// Raises what pixels cost as the disk where they lack its grain, and keeps by how much. `without` is what
/// the photo would show without the subject, at full size.
pub(crate) fn missed_in_photo(ready: &mut Prepared, without: &Rgb) {
    let places = places(ready, without);
    let usual = Usual::of(places.iter().flatten());
    let body = evident(ready, &places);
    let strange = |(place, color): (&Option<Place>, &[u8; 3])| {
        let times = place.and_then(|p| Some(p.left / usual.at(p.rough)?));
        let strange = times.map_or(0.0, |times| unlikely(times).min(CAP));
        if strange > 0.0 && has(body.as_ref(), *color) {
            strange
        } else {
            0.0
        }
    };
    ready.strange = places.iter().zip(&ready.small.data).map(strange).collect();
    for i in 0..ready.strange.len() {
        ready.raise(i, ready.strange[i]);
    }
}

/// What of the reduced photo may show the disk, if there is one.
fn places(ready: &Prepared, without: &Rgb) -> Vec<Option<Place>> {
    let Some(floor) = ready.floor.filter(|floor| floor.is_disk) else {
        return Vec::new();
    };
    let width = ready.small.width;
    let shows = |i: usize| {
        let (x, y) = (i % width, i / width);
        let hit = on_disk(
            &floor.camera,
            Point2::new(x as f64, y as f64),
            floor.touched * RIM,
        );
        hit.is_some() && ready.cost[i] != UNSEEN
    };
    let laid = Laid::new(&ready.small, &without.reduced(ready.factor), shows);
    let place = |(i, left): (usize, f32)| {
        (left < f32::MAX).then(|| Place {
            left,
            rough: laid.rough(i),
            bare: ready.cost[i] < FLAT + BARE,
        })
    };
    let left = laid.left_over().data.into_iter().enumerate();
    left.map(place).collect()
}

/// The colours of what is evidently not the scene behind, above the disk: there a shadow may look evident.
fn evident(ready: &Prepared, places: &[Option<Place>]) -> Option<Gmm> {
    let off = |i: &usize| ready.cost[*i] > EVIDENT && ready.known[*i] == Known::Unknown;
    let above = |i: &usize| places.get(*i).is_none_or(Option::is_none);
    let some = (0..ready.cost.len()).filter(|i| off(i) && above(i));
    let colors: Vec<[u8; 3]> = some.step_by(7).map(|i| ready.small.data[i]).collect();
    mixture(&colors)
}

/// A place of a photo that may show the disk.
#[derive(Clone, Copy)]
struct Place {
    /// What the best light leaves. \[levels²\]
    left: f32,
    /// How rough the map is there. \[levels²\]
    rough: f32,
    /// Whether it would do as the disk by its colour.
    bare: bool,
}

/// What is usually left of the bare disk, by how rough its map is.
struct Usual {
    /// Upper ends of classes, and the median of what is left in each. \[levels²\]
    classes: Vec<(f32, f32)>,
}

impl Usual {
    fn of<'a>(places: impl Iterator<Item = &'a Place>) -> Self {
        let bare = places.filter(|p| p.bare).map(|p| (p.rough, p.left));
        let mut bare: Vec<(f32, f32)> = bare.collect();
        bare.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
        let each = bare.len().div_ceil(CLASSES).max(FEW);
        let class = |some: &[(f32, f32)]| {
            let mut left: Vec<f32> = some.iter().map(|w| w.1).collect();
            left.sort_by(f32::total_cmp);
            (some[some.len() - 1].0, left[left.len() / 2].max(LEAST))
        };
        let full = bare.chunks(each).filter(|some| some.len() >= FEW);
        Usual {
            classes: full.map(class).collect(),
        }
    }

    /// Where the map is so rough. `None` where too little of the disk is bare.
    fn at(&self, rough: f32) -> Option<f32> {
        let class = self.classes.partition_point(|(end, _)| *end < rough);
        let class = self.classes.get(class).or(self.classes.last())?;
        Some(class.1)
    }
}
