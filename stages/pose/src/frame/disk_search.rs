//! Where a disk's edge is searched: what is still, at the height of soles and tags, outside of all tags.

use crate::frame::disk_edge::{DiskEdge, disk_edge};
use crate::frame::disk_tags::DiskTags;
use crate::frame::stature::Stature;
use rayon::prelude::*;
use shape::{Cameras, Gray, PhotoError, Photos, Placed, Rgb, Rig, median, register, registered};

/// What makes a circle the disk's edge.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Rules {
    /// How many times as large as that of other circles its step must be.
    pub(crate) standout: f64,
    /// A circle may be off the stature by this share.
    pub(crate) contradiction: f64,
}

/// The still background, reduced: the plate, or the median of photos laid on each other.
///
/// Beside it how the first photo maps to it, at full size, and so its camera.
pub(crate) fn still(photos: &Photos, search_px: u32) -> Result<Option<(Rgb, Placed)>, PhotoError> {
    let Some(first) = photos.photos.first() else {
        return Ok(None);
    };
    let by = (first.width.max(first.height) / search_px).max(1) as usize;
    let one = |photo: &shape::Photo| Ok(photo.decode()?.reduced(by));
    let fits = |plate: &&shape::Photo| (plate.width, plate.height) == (first.width, first.height);
    if let Some(plate) = photos.plate.as_ref().filter(fits) {
        // All that shows here how it maps to the plate is the two of them.
        let plate = one(plate)?;
        let placed = register(&one(first)?.gray(), &plate.gray()).unwrap_or(Placed::SAME);
        return Ok(Some((plate, placed.enlarged(by as f64))));
    }
    let every = photos.photos.len().div_ceil(9).max(1);
    let some: Vec<_> = photos.photos.iter().step_by(every).collect();
    let pictures: Vec<Rgb> = some.into_par_iter().map(one).collect::<Result<_, _>>()?;
    let gray: Vec<Gray> = pictures.par_iter().map(Rgb::gray).collect();
    let (mut placed, still) = registered(&gray);
    if still.is_none() {
        // Where there is nothing to lay photos on each other by, they stay as they are.
        placed.fill(Some(Placed::SAME));
    }
    let first = placed.first().copied().flatten().unwrap_or(Placed::SAME);
    let still = middle(&pictures, &placed);
    Ok(still.map(|still| (still, first.enlarged(by as f64))))
}

/// The median of photos where they were laid, exposed alike; those that are not left out.
fn middle(pictures: &[Rgb], placed: &[Option<Placed>]) -> Option<Rgb> {
    let laid = pictures.iter().zip(placed);
    let laid = laid.filter_map(|(picture, placed)| placed.map(|p| (p.brought(picture), p)));
    let laid: Vec<(Rgb, Placed)> = laid.collect();
    let channel = |c: usize| {
        let alike =
            |(picture, p): &(Rgb, Placed)| picture.map(|levels| p.levelled(f32::from(levels[c])));
        median(&laid.par_iter().map(alike).collect::<Vec<Gray>>())
    };
    let [red, green, blue] = [channel(0)?, channel(1)?, channel(2)?];
    let mut still = Rgb::filled(red.width, red.height, [0; 3]);
    for (i, to) in still.data.iter_mut().enumerate() {
        *to = [&red, &green, &blue].map(|c| c.data[i].round() as u8);
    }
    Some(still)
}

/// The strongest circle near the disk. A ring of tags may be stronger than the edge: where by the stature the
/// disk is another, and a circle of about that size is as clear, it is that one.
/// Tags that are on the disk are within its edge, and at its height; what turns is not below the disk.
pub(crate) fn edge(
    (still, first): &(Rgb, Placed),
    cameras: &Cameras,
    (body, tags): (Option<&Stature>, Option<DiskTags>),
    rig: &Rig,
    rules: &Rules,
) -> Option<DiskEdge> {
    let ring = ring(cameras)?;
    let heights = heights(cameras, body, tags, ring)?;
    let least = tags.map_or(0.0, |tags| tags.reach);
    // Silhouettes show how tall the subject is, and whether that contradicts the disk.
    let smallest = smallest(cameras, rig).filter(|_| body.is_none());
    let narrow = smallest.map_or(least, |r| least.max(r * (1.0 - rules.contradiction)));
    // Next to nothing that turns is lower: subject and disk are above.
    let low = turning(cameras, MIRRORED_SHARE);
    let may = |z: f64, r: f64| r >= narrow && low.is_none_or(|low| z <= low + THICKEST_SHARE * r);
    let camera = cameras.views.values().next()?.camera;
    let camera = match first.is_identity() {
        true => camera,
        false => first.brought_camera(&camera),
    };
    let search = |[low, high]: [f64; 2]| {
        let radii = [low.max(least), high];
        let within = radii[0] < radii[1];
        let found = within.then(|| disk_edge(still, &camera, heights, radii, &may))??;
        (found.standout >= rules.standout).then_some(found)
    };
    let strongest = search(RADII.map(|share| share * ring))?;
    let expected = || {
        let (disk, stature, body) = (rig.disk_diameter_mm?, rig.stature_mm?, body?);
        Some(disk / 2.0 * (body.crown - body.ground) / stature)
    };
    let contradicts =
        |expected: &f64| (strongest.radius / expected - 1.0).abs() > rules.contradiction;
    let other = expected().filter(contradicts);
    let other = other.and_then(|r| search([0.9, 1.1].map(|by| by * r)));
    Some(other.unwrap_or(strongest))
}

/// A disk's radius as a share of the camera's distance from its axis: wider ones leave the picture of somebody as a whole,
/// smaller ones carry nobody (structural: the range of a search).
const RADII: [f64; 2] = [0.03, 0.5];
/// How far below the camera a disk is, as shares of the camera's distance from its axis: one that is seen from its side has no
/// edge, and from farther above a camera sees no waist (structural: the range of a search).
const BELOW: [f64; 2] = [1.5, 0.1];
/// A disk is no thicker than this share of its radius. By hand: looked at six captures, halved and doubled: nothing
/// changes, nor without it on five (docs/lab/numbers.md).
const THICKEST_SHARE: f64 = 0.5;
/// Share of the features that may be lower, as what a glossy disk mirrors. By hand: looked at six captures, halved and
/// doubled: nothing changes; at 0, one size 10 % off, one edge not found (docs/lab/numbers.md).
const MIRRORED_SHARE: f64 = 0.05;

/// Height below which such a share of the features that turn is. `None` without features.
fn turning(cameras: &Cameras, share: f64) -> Option<f64> {
    let mut all: Vec<f32> = cameras.points.iter().map(|p| p[2]).collect();
    all.sort_by(f32::total_cmp);
    let at = (all.len() as f64 * share) as usize;
    all.get(at).map(|z| f64::from(*z))
}

/// The disk as small as it can be, where its size and the subject's are given: what turns is not taller than the subject.
fn smallest(cameras: &Cameras, rig: &Rig) -> Option<f64> {
    let shares = [MIRRORED_SHARE, 1.0 - MIRRORED_SHARE];
    let [low, high] = shares.map(|share| turning(cameras, share));
    Some(rig.disk_diameter_mm? / 2.0 * (high? - low?) / rig.stature_mm?)
}

/// Distance of the first camera from the axis.
fn ring(cameras: &Cameras) -> Option<f64> {
    let centre = cameras.views.values().next()?.camera.centre();
    Some(libm::hypot(centre.x, centre.y))
}

/// Heights at which the edge may be: at the tags', near the soles, or anywhere below the camera.
fn heights(
    cameras: &Cameras,
    body: Option<&Stature>,
    tags: Option<DiskTags>,
    ring: f64,
) -> Option<[f64; 2]> {
    let centre = cameras.views.values().next()?.camera.centre();
    Some(match (tags, body) {
        (Some(tags), _) => tags.edge,
        (None, Some(body)) => {
            let reach = 0.04 * (body.crown - body.ground);
            [body.ground - reach, body.ground + reach]
        }
        (None, None) => BELOW.map(|share| centre.z - share * ring),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use shape::Scale;

    #[test]
    fn the_circle_that_toes_sweep_is_too_small_for_the_disk_of_somebody_so_tall() {
        // Somebody of 1.7 m and a disk of 0.7 m, with features all over, where a unit is a millimetre.
        let rig = Rig {
            stature_mm: Some(1700.0),
            disk_diameter_mm: Some(700.0),
            ..Rig::default()
        };
        let points = (0..1000).map(|i| [0.0, 0.0, 1.7 * i as f32]);
        let cameras = Cameras {
            points: points.collect(),
            ..Cameras::of([], Scale::Nothing)
        };
        let least = smallest(&cameras, &rig).unwrap() * 0.8;
        assert!(least > 220.0 && least < 350.0, "{least}");
        let of_nobody = Rig {
            stature_mm: None,
            ..rig
        };
        assert_eq!(smallest(&cameras, &of_nobody), None);
    }
}
