//! How long a unit is, from marker tags of known size that cameras from elsewhere see: their corners are
//! triangulated, and no ring is asked for.

use crate::mat::corners::mat_corners;
use crate::two_view::triangulate::triangulate;
use nalgebra::{Point3, Vector3};
use shape::{Camera, Cameras, Mat, PhotoId, Tag, Tags};
use std::collections::BTreeMap;

/// What the tags tell, in the cameras' unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct TagScale {
    /// Millimetres of a unit.
    pub(crate) mm_per_unit: f64,
    /// Its standard deviation, as a share.
    pub(crate) sigma: f64,
    /// Height of the level ground that the tags lie on; none where they lie on none.
    pub(crate) ground: Option<f64>,
    /// So many tags told.
    pub(crate) tags: usize,
}

/// What is known of the tags.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Known<'a> {
    /// Edge length of a tag's black square. \[mm\]
    pub(crate) tag_mm: f64,
    /// How they lie, where that is known.
    pub(crate) mat: Option<&'a Mat>,
    /// Most by which a tag's corners may miss their rays, root mean square. \[px\]
    pub(crate) most_px: f64,
}

/// A side of a printed square seems so much longer or shorter, by exposure and blur. \[px\]
const BLOOM_PX: f64 = 0.3;

/// A tag whose sides or diagonals differ by more is none, or does not lie flat.
const SQUARE: f64 = 0.06;

/// No scale is surer than this share: paper and its measuring.
const LEAST_SIGMA: f64 = 0.001;

/// Tags that lie within this of level are on the ground. \[rad\]
const LEVEL: f64 = 0.12;

/// One tag in the world.
struct Placed {
    id: u32,
    corners: [Point3<f64>; 4],
    /// A pixel where it is seen best, in the cameras' unit.
    pixel: f64,
}

impl Placed {
    fn middle(&self) -> Point3<f64> {
        let sum = self
            .corners
            .iter()
            .fold(Vector3::zeros(), |s, c| s + c.coords);
        Point3::from(sum / 4.0)
    }

    /// Mean of its four sides.
    fn side(&self) -> f64 {
        let side = |k: usize| (self.corners[(k + 1) % 4] - self.corners[k]).norm();
        (0..4).map(side).sum::<f64>() / 4.0
    }

    /// Right angles and even sides: its diagonals are √2 sides long, and so are its sides.
    fn square(&self) -> bool {
        let (c, side) = (&self.corners, self.side());
        let even = |length: f64, of: f64| (length / of - 1.0).abs() < SQUARE;
        let diagonal = std::f64::consts::SQRT_2 * side;
        (0..4).all(|k| even((c[(k + 1) % 4] - c[k]).norm(), side))
            && (0..2).all(|k| even((c[k + 2] - c[k]).norm(), diagonal))
    }

    /// The unit normal, upward.
    fn normal(&self) -> Vector3<f64> {
        let c = &self.corners;
        let across = (c[2] - c[0]).cross(&(c[3] - c[1])).normalize();
        across * across.z.signum()
    }
}

/// How long a unit is. `None` where no tag is seen well enough from two sides.
pub(crate) fn tag_scale(cameras: &Cameras, tags: &Tags, known: &Known<'_>) -> Option<TagScale> {
    let placed = placed(cameras, tags, known);
    let (mm_per_unit, sigma) = match known.mat.and_then(|mat| by_layout(&placed, mat)) {
        Some(laid) => laid,
        None => by_sides(&placed, known.tag_mm)?,
    };
    Some(TagScale {
        mm_per_unit,
        sigma: libm::hypot(sigma, LEAST_SIGMA),
        ground: ground(&placed),
        tags: placed.len(),
    })
}

/// All tags whose rays meet: each seen once in a photo, by two photos or more.
fn placed(cameras: &Cameras, tags: &Tags, known: &Known<'_>) -> Vec<Placed> {
    let mut seen: BTreeMap<u32, Vec<(PhotoId, &Tag)>> = BTreeMap::new();
    for (id, tags) in tags.views.iter() {
        for tag in tags {
            // Two of one number in one photo: nobody knows which is which elsewhere.
            if tags.iter().filter(|t| t.id == tag.id).count() == 1 {
                seen.entry(tag.id).or_default().push((id, tag));
            }
        }
    }
    let of_mat = |id: &u32| known.mat.is_none_or(|mat| mat_corners(mat, *id).is_some());
    seen.retain(|id, _| of_mat(id));
    let one = |(id, seen): (u32, Vec<(PhotoId, &Tag)>)| place(cameras, id, seen, known.most_px);
    seen.into_iter().filter_map(one).collect()
}

/// One tag; photos that disagree with the others are left out one by one, up to a third.
fn place(cameras: &Cameras, id: u32, seen: Vec<(PhotoId, &Tag)>, most_px: f64) -> Option<Placed> {
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
            let placed = Placed { id, corners, pixel };
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

/// By how far the tags' middles lie apart, which no bloom moves: all lengths of the layout against all that
/// were found, and how far single ones differ.
fn by_layout(placed: &[Placed], mat: &Mat) -> Option<(f64, f64)> {
    let mut pairs = Vec::new();
    for (k, a) in placed.iter().enumerate() {
        for b in &placed[k + 1..] {
            let laid = |tag: &Placed| {
                let sum = mat_corners(mat, tag.id)?;
                Some(sum.iter().fold(Vector3::zeros(), |s, c| s + c.coords) / 4.0)
            };
            pairs.push((
                (laid(a)? - laid(b)?).norm(),
                (a.middle() - b.middle()).norm(),
            ));
        }
    }
    let (mm, units) = pairs.iter().fold((0.0, 0.0), |s, p| (s.0 + p.0, s.1 + p.1));
    if pairs.is_empty() || units <= 0.0 {
        return None;
    }
    let scale = mm / units;
    let squares: f64 = pairs
        .iter()
        .map(|p| (p.1 * scale / p.0 - 1.0).powi(2))
        .sum();
    let one = (squares / pairs.len() as f64).sqrt();
    Some((scale, one / (placed.len() as f64).sqrt()))
}

/// By the tags' sides: the middle one of all, how far tags differ, and the bloom of the one that is seen best.
fn by_sides(placed: &[Placed], tag_mm: f64) -> Option<(f64, f64)> {
    let mut scales: Vec<f64> = placed.iter().map(|tag| tag_mm / tag.side()).collect();
    scales.sort_by(f64::total_cmp);
    let scale = *scales.get(scales.len() / 2)?;
    let bloom = placed
        .iter()
        .map(|tag| 2.0 * BLOOM_PX * tag.pixel / tag.side());
    let bloom = bloom.fold(f64::MAX, f64::min);
    let squares: f64 = scales.iter().map(|s| (s / scale - 1.0).powi(2)).sum();
    let spread = (squares / scales.len() as f64).sqrt() / (scales.len() as f64).sqrt();
    Some((scale, libm::hypot(bloom, spread)))
}

/// The height of tags that lie level, if all that are level lie at one.
fn ground(placed: &[Placed]) -> Option<f64> {
    let level: Vec<&Placed> = placed
        .iter()
        .filter(|tag| tag.normal().angle(&Vector3::z()) < LEVEL)
        .collect();
    let mut heights: Vec<f64> = level.iter().map(|tag| tag.middle().z).collect();
    heights.sort_by(f64::total_cmp);
    let (lowest, highest) = (heights.first()?, heights.last()?);
    (highest - lowest < level[0].side()).then(|| heights[heights.len() / 2])
}

#[cfg(test)]
mod tests;
