//! Where a stabiliser laid the photos of a turn: found by the background, taken out of features before
//! cameras are sought, and given back to each camera.

use rayon::prelude::*;
use shape::{ByPhoto, Cameras, Gray, Photo, Photos, Placed, Tracks, registered};

/// Size to which photos are reduced before they are laid on each other (structural: a cap on work). \[px\]
const LONGEST_PX: u32 = 1200;
/// Longest way of a corner that a stabiliser goes, as a share of a photo's longer side: what went further is a camera
/// that was moved. By hand: looked at two captures, halved and doubled: nothing changes, for a stabiliser shifted both
/// by less (docs/lab/numbers.md).
const FARTHEST_SHARE: f64 = 0.005;

/// How photos of a turn map to the place that they have in common. `None` where all are there, or the background does not show it:
/// photos that share too little with it, or cannot be read.
pub(crate) fn places(photos: &Photos) -> Option<ByPhoto<Placed>> {
    let first = photos.photos.first()?;
    let by = first.width.max(first.height).div_ceil(LONGEST_PX).max(1) as usize;
    let small = |photo: &Photo| Some(photo.decode().ok()?.gray().reduced(by));
    let smalls: Vec<Gray> = photos.photos.par_iter().map(small).collect::<Option<_>>()?;
    let placed: Vec<Placed> = registered(&smalls).0.into_iter().collect::<Option<_>>()?;
    let [w, h] = [smalls[0].width, smalls[0].height];
    let far = |p: &Placed| p.way(w, h) > FARTHEST_SHARE * w.max(h) as f64;
    if placed.iter().all(Placed::is_identity) || placed.iter().any(far) {
        return None;
    }
    let ids = photos.iter().map(|(id, _)| id);
    let placed = placed.iter().map(|p| p.enlarged(by as f64));
    Some(ids.zip(placed).collect())
}

/// Tracks as they would be if all photos lay in their common place.
pub(crate) fn brought(tracks: &Tracks, photos: &Photos, places: &ByPhoto<Placed>) -> Tracks {
    let mut brought = tracks.clone();
    for seen in brought.points.iter_mut().flatten() {
        let (Some(place), Some(photo)) = (places.get(seen.photo), photos.get(seen.photo)) else {
            continue;
        };
        if !place.is_identity() {
            let size = [photo.width as usize, photo.height as usize];
            let there = place.inverse().of(seen.at_px.map(f64::from), size);
            seen.at_px = there.map(|v| v as f32);
        }
    }
    brought
}

/// Cameras of the common place become those of the photos as they are.
pub(crate) fn given_back(cameras: &mut Cameras, places: &ByPhoto<Placed>) {
    cameras.views = cameras.views.map(|id, view| {
        let mut view = view.clone();
        if let Some(place) = places.get(id).filter(|place| !place.is_identity()) {
            view.camera = place.inverse().brought_camera(&view.camera);
        }
        view
    });
}
