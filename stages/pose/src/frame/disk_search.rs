//! Where a disk's edge is searched: what is still, at the height of soles and tags, outside of all tags.

use crate::frame::disk_edge::{DiskEdge, disk_edge};
use crate::frame::disk_tags::DiskTags;
use crate::frame::stature::Stature;
use rayon::prelude::*;
use shape::{
    Cameras, Gray, PhotoError, Photos, Placed, Reference, Rig, median, register, registered,
};

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
pub(crate) fn still(photos: &Photos, search_px: u32) -> Result<Option<(Gray, Placed)>, PhotoError> {
    let Some(first) = photos.photos.first() else {
        return Ok(None);
    };
    let by = (first.width.max(first.height) / search_px).max(1) as usize;
    let one = |photo: &shape::Photo| Ok(photo.decode()?.gray().reduced(by));
    let fits = |plate: &&shape::Photo| (plate.width, plate.height) == (first.width, first.height);
    if let Some(plate) = photos.plate.as_ref().filter(fits) {
        // All that shows here how it maps to the plate is the two of them.
        let plate = one(plate)?;
        let placed = register(&one(first)?, &plate).unwrap_or(Placed::SAME);
        return Ok(Some((plate, placed.enlarged(by as f64))));
    }
    let every = photos.photos.len().div_ceil(9).max(1);
    let some: Vec<_> = photos.photos.iter().step_by(every).collect();
    let pictures: Vec<Gray> = some.into_par_iter().map(one).collect::<Result<_, _>>()?;
    // Where there is nothing to lay photos on each other by, they stay as they are.
    let (placed, still) = registered(&pictures);
    let first = placed.first().copied().flatten().unwrap_or(Placed::SAME);
    let unmoved = || median(&pictures).map(|still| (still, Placed::SAME));
    let still = still.map(|still| (still, first.enlarged(by as f64)));
    Ok(still.or_else(unmoved))
}

/// The strongest circle near the disk. A ring of tags may be stronger than the edge: where by the stature the
/// disk is another, and a circle of that size is a third as strong, it is that one (both by hand, on made photos).
/// Tags that are on the disk are within its edge, and at its height; what turns is not below the disk.
/// Where no disk is given, its edge is one all around, or there is none.
pub(crate) fn edge(
    (still, first): &(Gray, Placed),
    cameras: &Cameras,
    (body, tags): (Option<&Stature>, Option<DiskTags>),
    rig: &Rig,
    rules: &Rules,
) -> Option<DiskEdge> {
    let ring = ring(cameras)?;
    let disk = |r: &Reference| r.kind == "disk_diameter";
    let given = rig.disk_diameter_mm.is_some() || rig.reference.as_ref().is_some_and(disk);
    let heights = heights(cameras, body, tags, ring)?;
    let least = tags.map_or(0.0, |tags| tags.reach);
    // Silhouettes show how tall the subject is, and whether that contradicts the disk.
    let smallest = smallest(cameras, rig).filter(|_| body.is_none());
    let narrow = smallest.map_or(least, |r| least.max(r * (1.0 - rules.contradiction)));
    // Next to nothing that turns is lower: subject and disk are above.
    let low = turning(cameras, MIRRORED_SHARE);
    let may = |z: f64, r: f64| r >= narrow && low.is_none_or(|low| z <= low + THICKEST_SHARE * r);
    let search = |[low, high]: [f64; 2], least_standout: f64| {
        let radii = [(low * ring).max(least), high * ring];
        let camera = cameras.views.values().next()?.camera;
        let camera = match first.is_identity() {
            true => camera,
            false => first.brought_camera(&camera),
        };
        let within = radii[0] < radii[1];
        let found = within.then(|| disk_edge(still, &camera, heights, radii, &may))??;
        (found.standout >= least_standout && (given || found.round)).then_some(found)
    };
    let found = search([0.06, 0.4], rules.standout);
    let expected = || {
        let (disk, stature, body) = (rig.disk_diameter_mm?, rig.stature_mm?, body?);
        Some(disk / 2.0 * (body.crown - body.ground) / stature)
    };
    let (Some(strongest), Some(expected)) = (found, expected()) else {
        return found;
    };
    if (strongest.radius / expected - 1.0).abs() <= rules.contradiction {
        return found;
    }
    let share = expected / ring;
    let near = [0.9, 1.1].map(|by| by * share);
    let other = search(near, 0.0);
    // Against all circles, not only those beside it.
    let usual = strongest.contrast / strongest.standout;
    let least = (rules.standout * usual).max(strongest.contrast / 3.0);
    let strong = |edge: &DiskEdge| edge.contrast >= least;
    other.filter(strong).or(found)
}

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
        (None, None) => [centre.z - 0.8 * ring, centre.z - 0.1 * ring],
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
