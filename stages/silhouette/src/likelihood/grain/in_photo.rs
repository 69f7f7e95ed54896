//! The grain of the disk, of the floor around it and of walls in one photo, where the scene behind it is known at full size.
//!
//! How much of a bare ground is usually left is learned from the photo itself, for no map fits a photo quite exactly, nor is
//! it as sharp.

use super::window::left_over;
use super::{LEAST_LEFT_OVER, has, unlikely};
use crate::likelihood::background::{CAP, FLAT};
use crate::likelihood::body::evident;
use crate::likelihood::disk_colors::mixture;
use crate::likelihood::floor::Floor;
use crate::likelihood::gmm::Gmm;
use crate::likelihood::grounds::{Ground, Grounds};
use crate::likelihood::person::SURE;
use crate::likelihood::prepared::{Prepared, UNSEEN};
use crate::scene::backdrop::thinned;
use crate::scene::disk_map::RIM;
use crate::scene::disk_plane::DiskTop;
use shape::Rgb;

/// How far windows are from each other on disk and floor, where shadows end within one, and on walls (structural: samples).
const APART: [usize; 2] = [1, 2];
/// Fewer bare places give no median (structural: samples).
const FEW: usize = 40;

/// Raises what pixels cost as the disk, the floor or a wall where they lack its grain: on the ground
/// shadows are deep, so light and hue tell little, and cloth of a wall's colour differs from it by its own grain. Nothing where
/// it is not known where the floor is. `map` is what the reduced photo would show without the subject.
pub(crate) fn missed_in_photo(ready: &mut Prepared, map: &Rgb) {
    let Some(before) = ready.floor else {
        return;
    };
    let disk = disk(ready, &before, map);
    let [floor, walls] = still(ready, &before, map);
    let body = colors_above(ready, &disk);
    for places in [disk, floor, walls] {
        let Some(usual) = usual(places.iter().flatten()) else {
            continue;
        };
        for (i, place) in places.iter().enumerate() {
            let strange = place.map_or(0.0, |p| unlikely(p.left / usual).min(CAP));
            if strange > 0.0 && has(body.as_ref(), ready.small.data[i]) {
                ready.raise(i, strange);
            }
        }
    }
}

/// What of the reduced photo may show the disk, if there is one.
fn disk(ready: &Prepared, floor: &Floor, map: &Rgb) -> Vec<Option<Place>> {
    if !floor.is_disk {
        return Vec::new();
    }
    let size = [ready.small.width, ready.small.height];
    let top = DiskTop::of(&floor.camera, floor.touched * RIM, size);
    places(ready, map, APART[0], |x, y| top.at(x, y).is_some())
}

/// What of the reduced photo may show the floor, and what a wall, but for pixels along the outline of what evidently is body:
/// they are mixtures of both.
fn still(ready: &Prepared, floor: &Floor, map: &Rgb) -> [Vec<Option<Place>>; 2] {
    let size = [ready.small.width, ready.small.height];
    let grounds = Grounds::of(Some(floor), 1, size[0], size[1]);
    let off = evident(&ready.cost, &ready.known, size).map(|body| !body);
    let clear = thinned(&off, 1);
    let of = |ground: Ground, apart: usize| {
        let shows = |x: usize, y: usize| grounds.at(x, y) == ground && clear.at(x, y);
        places(ready, map, apart, shows)
    };
    [of(Ground::Floor, APART[0]), of(Ground::Wall, APART[1])]
}

/// What of the reduced photo may show a ground that is at some pixels.
fn places(
    ready: &Prepared,
    map: &Rgb,
    apart: usize,
    on: impl Fn(usize, usize) -> bool,
) -> Vec<Option<Place>> {
    let width = ready.small.width;
    let shows = |i: usize| on(i % width, i / width) && ready.cost[i] != UNSEEN;
    let all = left_over(&ready.small, map, apart, shows).data.into_iter();
    let place = |(i, left): (usize, f32)| {
        (left < f32::MAX).then(|| Place {
            left,
            bare: ready.cost[i] < FLAT + SURE,
        })
    };
    all.enumerate().map(place).collect()
}

/// The colours of what is evidently not the scene behind, above the disk: there a shadow may look evident.
fn colors_above(ready: &Prepared, places: &[Option<Place>]) -> Option<Gmm> {
    let off = evident(
        &ready.cost,
        &ready.known,
        [ready.small.width, ready.small.height],
    );
    let above = |i: &usize| places.get(*i).is_none_or(Option::is_none);
    let some = (0..ready.cost.len()).filter(|i| off.data[*i] && above(i));
    let colors: Vec<[u8; 3]> = some.step_by(7).map(|i| ready.small.data[i]).collect();
    mixture(&colors)
}

/// A place of a photo that may show a ground.
#[derive(Clone, Copy)]
struct Place {
    /// What the best light leaves. \[levels²\]
    left: f32,
    /// Whether it would do as the ground by its colour.
    bare: bool,
}

/// What is usually left of a bare ground: the median. `None` where too little of it is bare. \[levels²\]
fn usual<'a>(places: impl Iterator<Item = &'a Place>) -> Option<f32> {
    let mut bare: Vec<f32> = places.filter(|p| p.bare).map(|p| p.left).collect();
    let middle = bare.len() / 2;
    (bare.len() >= FEW).then(|| {
        let (_, median, _) = bare.select_nth_unstable_by(middle, f32::total_cmp);
        median.max(LEAST_LEFT_OVER)
    })
}
