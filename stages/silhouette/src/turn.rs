//! The scene without its subject when nobody took a plate: out of all photos of the turn.

use crate::backdrop::{Backdrop, backdrop, middle, still, thinned};
use crate::coherence::agreed;
use crate::disk_top::{laid_out, lay_into, point};
use crate::gmm::Gmm;
use crate::photo_cut::{Prepared, UNSEEN, coarse, prepare};
use crate::segment::{Known, Settings};
use rayon::prelude::*;
use shape::{Camera, Cameras, Image, Mask, PhotoId, Rgb};

/// Rounds of finding masks and the background by turns.
const ROUNDS: usize = 3;
/// Pixels around a mask that do not tell of the background.
pub(crate) const SHY: usize = 2;

/// What it costs to find a colour of the room at another place than there.
const ELSEWHERE: f32 = 4.0;
/// Clusters of the room's colours.
const CLUSTERS: usize = 12;

/// A photo, reduced, with its camera at that size.
pub struct Shot {
    /// Which one.
    pub id: PhotoId,
    /// The pixels.
    pub small: Rgb,
    /// The camera.
    pub camera: Camera,
}

/// The room, which stands still, and the disk, which turns.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// The room as all photos show it.
    pub room: Backdrop,
    /// The map of the disk's top.
    pub disk: Backdrop,
    /// The disk's radius. \[mm\] 0 without one.
    pub radius: f64,
}

impl Scene {
    /// What one camera would see. Where nobody saw it, the photo itself stands in, so that it tells nothing.
    pub fn behind(&self, photo: &Rgb, camera: &Camera) -> Backdrop {
        let mut behind = self.room.clone();
        if self.radius > 0.0 {
            let Backdrop { image, seen } = &mut behind;
            let (map, known) = (&self.disk.image, &self.disk.seen);
            lay_into(image, seen, camera, self.radius, map, known);
        }
        for (i, seen) in behind.seen.data.iter().enumerate() {
            if !seen {
                behind.image.data[i] = photo.data[i];
            }
        }
        behind
    }
}

/// Finds the scene from reduced photos; `covered` as in [`backdrop`].
fn scene(shots: &[Shot], radius: f64, covered: Option<&[Image<bool>]>) -> Scene {
    let smalls: Vec<Rgb> = shots.iter().map(|s| s.small.clone()).collect();
    let room = backdrop(&smalls, covered);
    let cameras: Vec<Camera> = shots.iter().map(|s| s.camera).collect();
    let side = full_side(&cameras, radius);
    let nowhere = Backdrop {
        image: Rgb::filled(1, 1, [0; 3]),
        seen: Image::filled(1, 1, false),
    };
    if radius <= 0.0 {
        return Scene {
            room,
            disk: nowhere,
            radius,
        };
    }
    let maps: Vec<_> = shots
        .par_iter()
        .map(|s| laid_out(&s.small, &s.camera, radius, side))
        .collect();
    let hides = |k: usize, i: usize| -> bool {
        let Some(at) = point(i, radius, side).and_then(|x| shots[k].camera.project(&x)) else {
            return true;
        };
        let (x, y) = (
            at.x.round().max(0.0) as usize,
            at.y.round().max(0.0) as usize,
        );
        covered.is_some_and(|c| x < c[k].width && y < c[k].height && c[k].at(x, y))
    };
    let hidden: Vec<Image<bool>> = (0..shots.len())
        .into_par_iter()
        .map(|k| Image {
            width: side,
            height: side,
            data: (0..side * side)
                .map(|i| maps[k][i].is_none() || hides(k, i))
                .collect(),
        })
        .collect();
    let maps: Vec<Rgb> = maps
        .into_iter()
        .map(|map| Rgb {
            width: side,
            height: side,
            data: map.into_iter().map(|c| c.unwrap_or([0; 3])).collect(),
        })
        .collect();
    Scene {
        room,
        disk: middle(&maps, &hidden),
        radius,
    }
}

/// As many points along the map of the disk as its width has pixels.
pub(crate) fn full_side(cameras: &[Camera], radius: f64) -> usize {
    let width = |c: &Camera| 2.0 * radius * c.lens.focal[0] / c.centre().coords.norm();
    let most = cameras.iter().map(width).fold(0.0, f64::max);
    (most as usize).clamp(64, 2048)
}

/// Share of the pixels that stand still around the turn.
pub(crate) fn standing(shots: &[Shot]) -> f64 {
    let smalls: Vec<Rgb> = shots.iter().map(|s| s.small.clone()).collect();
    let still = still(&smalls);
    let count = still.data.iter().filter(|s| **s == Some(true)).count();
    count as f64 / still.data.len().max(1) as f64
}

/// Masks of reduced photos without a plate. `None` where a photo shows nothing that moves.
pub fn without_plate(
    shots: &[Shot],
    cameras: &Cameras,
    settings: &Settings,
    disk_side_mm: f64,
) -> Vec<Option<Image<bool>>> {
    let radius = cameras.disk_radius_mm.unwrap_or(0.0);
    let smalls: Vec<Rgb> = shots.iter().map(|s| s.small.clone()).collect();
    let still = still(&smalls);
    let mut around = scene(shots, radius, None);
    // What never changes amid the turn may be a body that always covers it.
    for (seen, still) in around.room.seen.data.iter_mut().zip(&still.data) {
        *seen &= *still != Some(false);
    }
    let mut cuts: Vec<Option<Image<bool>>> = Vec::new();
    for _ in 0..ROUNDS {
        let colors = room_colors(&around.room);
        let ready: Vec<Prepared> = shots
            .par_iter()
            .map(|shot| {
                let mut ready = one(shot, &around, radius, disk_side_mm);
                for (i, still) in still.data.iter().enumerate() {
                    if *still == Some(true) {
                        ready.known[i] = Known::Background;
                    }
                    // Where nobody saw the room, its colours elsewhere serve.
                    if let (true, Some(room)) = (ready.cost[i] == UNSEEN, &colors) {
                        let elsewhere = room.cost(shot.small.data[i]) as f32 + ELSEWHERE;
                        ready.cost[i] = ready.cost[i].min(elsewhere);
                    }
                }
                ready
            })
            .collect();
        let first: Vec<(PhotoId, Mask)> = shots
            .par_iter()
            .zip(&ready)
            .filter_map(|(shot, ready)| {
                let (sides, _) = coarse(ready, settings)?;
                Some((shot.id, sides.map(|b| if *b { 255 } else { 0 })))
            })
            .collect();
        let together = agreed(&first, cameras);
        cuts = shots
            .par_iter()
            .zip(ready)
            .map(|(shot, mut ready)| {
                ready.agree(together.get(&shot.id).into_iter().flatten());
                coarse(&ready, settings).map(|(sides, _)| sides)
            })
            .collect();
        let covered: Vec<Image<bool>> = cuts
            .iter()
            .zip(shots)
            .map(|(cut, shot)| match cut {
                Some(sides) => thinned(&sides.map(|b| !b), SHY).map(|b| !b),
                None => Image::filled(shot.small.width, shot.small.height, false),
            })
            .collect();
        around = scene(shots, radius, Some(&covered));
    }
    cuts
}

/// The colours of the room where it was seen, in the columns and rows in which it was not.
fn room_colors(room: &Backdrop) -> Option<Gmm> {
    let (w, h) = (room.seen.width, room.seen.height);
    let unseen = (0..w * h).filter(|i| !room.seen.data[*i]);
    let (mut left, mut right, mut top, mut bottom) = (w, 0, h, 0);
    for i in unseen {
        (left, right) = (left.min(i % w), right.max(i % w));
        (top, bottom) = (top.min(i / w), bottom.max(i / w));
    }
    let near = |i: &usize| {
        (left.saturating_sub(w / 8)..=right + w / 8).contains(&(i % w))
            && (top.saturating_sub(h / 8)..=bottom + h / 8).contains(&(i / w))
    };
    let colors: Vec<[u8; 3]> = (0..w * h)
        .filter(|i| room.seen.data[*i] && near(i))
        .map(|i| room.image.data[i])
        .collect();
    let some: Vec<[u8; 3]> = colors
        .iter()
        .copied()
        .step_by(colors.len() / 8000 + 1)
        .collect();
    Gmm::fit(&some, CLUSTERS)
}

fn one(shot: &Shot, around: &Scene, radius: f64, disk_side_mm: f64) -> Prepared {
    let behind = around.behind(&shot.small, &shot.camera);
    let disk = (radius > 0.0).then_some((&shot.camera, radius));
    prepare(&shot.small, &behind, disk, usize::MAX, disk_side_mm)
}
