//! Marker tags in the world: their corners, triangulated from cameras that were found without them.

use nalgebra::{Point3, Vector3};
use shape::triangulate;
use shape::{Camera, Cameras, PhotoId, Tag, Tags};
use std::collections::BTreeMap;

/// A tag whose sides or diagonals differ by a greater share is none, or is not flat. By hand: looked at one capture,
/// halved and doubled: nothing changes, for its tags are squares (docs/lab/numbers.md).
const SQUARE_SHARE: f64 = 0.06;

/// Tags that are within this of level are on the ground. By hand: looked at one capture, halved and doubled: nothing
/// changes, for its tags are level (docs/lab/numbers.md). \[rad\]
pub(crate) const LEVEL_RAD: f64 = 0.12;

/// One tag in the world.
pub(crate) struct PlacedTag {
    pub(crate) id: u32,
    pub(crate) corners: [Point3<f64>; 4],
    /// A pixel where it is seen best, in the cameras' unit.
    pub(crate) pixel: f64,
}

impl PlacedTag {
    pub(crate) fn middle(&self) -> Point3<f64> {
        let sum = self
            .corners
            .iter()
            .fold(Vector3::zeros(), |s, c| s + c.coords);
        Point3::from(sum / 4.0)
    }

    /// Mean of its four sides.
    pub(crate) fn side(&self) -> f64 {
        let side = |k: usize| (self.corners[(k + 1) % 4] - self.corners[k]).norm();
        (0..4).map(side).sum::<f64>() / 4.0
    }

    /// Right angles and even sides: its diagonals are √2 sides long, and so are its sides.
    fn square(&self) -> bool {
        let (c, side) = (&self.corners, self.side());
        let even = |length: f64, of: f64| (length / of - 1.0).abs() < SQUARE_SHARE;
        let diagonal = std::f64::consts::SQRT_2 * side;
        (0..4).all(|k| even((c[(k + 1) % 4] - c[k]).norm(), side))
            && (0..2).all(|k| even((c[k + 2] - c[k]).norm(), diagonal))
    }

    /// Whether it is flat on a level ground.
    pub(crate) fn is_level(&self) -> bool {
        self.normal().angle(&Vector3::z()) < LEVEL_RAD
    }

    /// The unit normal, upward.
    fn normal(&self) -> Vector3<f64> {
        let c = &self.corners;
        let across = (c[2] - c[0]).cross(&(c[3] - c[1])).normalize();
        across * across.z.signum()
    }
}

/// All tags of the numbers that count whose rays meet: each seen once in a photo, by two photos or more.
pub(crate) fn placed(
    cameras: &Cameras,
    tags: &Tags,
    counts: impl Fn(u32) -> bool,
    most_px: f64,
) -> Vec<PlacedTag> {
    let mut seen: BTreeMap<u32, Vec<(PhotoId, &Tag)>> = BTreeMap::new();
    for (id, tags) in tags.views.iter() {
        for tag in tags {
            // Two of one number in one photo: nobody knows which is which elsewhere.
            if tags.iter().filter(|t| t.id == tag.id).count() == 1 {
                seen.entry(tag.id).or_default().push((id, tag));
            }
        }
    }
    seen.retain(|id, _| counts(*id));
    let one = |(id, seen): (u32, Vec<(PhotoId, &Tag)>)| place(cameras, id, seen, most_px);
    seen.into_iter().filter_map(one).collect()
}

/// One tag; photos that disagree with the rest are left out one by one, up to a third.
fn place(
    cameras: &Cameras,
    id: u32,
    seen: Vec<(PhotoId, &Tag)>,
    most_px: f64,
) -> Option<PlacedTag> {
    let with = |(photo, tag): (PhotoId, &Tag)| Some((cameras.views.get(photo)?.camera, *tag));
    let mut seen: Vec<(Camera, Tag)> = seen.into_iter().filter_map(with).collect();
    let least = (seen.len() - seen.len() / 3).max(2);
    loop {
        let views: Vec<Camera> = seen.iter().map(|s| s.0).collect();
        let corner = |k: usize| {
            let at: Vec<_> = seen.iter().map(|s| s.1.corners[k]).enumerate().collect();
            triangulate(&views, &at)
        };
        let found = [corner(0)?, corner(1)?, corner(2)?, corner(3)?];
        let corners = found.map(|f| f.0);
        let px = (found.iter().map(|f| f.1 * f.1).sum::<f64>() / 4.0).sqrt();
        if px <= most_px {
            let pixel = |c: &Camera| (corners[0] - c.centre()).norm() / c.lens.focal[0];
            let pixel = views.iter().map(pixel).fold(f64::MAX, f64::min);
            let placed = PlacedTag { id, corners, pixel };
            return placed.square().then_some(placed);
        }
        if seen.len() <= least {
            return None;
        }
        let miss = |(camera, tag): &(Camera, Tag)| {
            let off = |k: usize| match camera.project(&corners[k]) {
                Some(at) => (at.x - tag.corners[k][0]).powi(2) + (at.y - tag.corners[k][1]).powi(2),
                None => f64::MAX,
            };
            (0..4).map(off).sum::<f64>()
        };
        let worst = (0..seen.len()).max_by(|a, b| miss(&seen[*a]).total_cmp(&miss(&seen[*b])))?;
        seen.remove(worst);
    }
}
