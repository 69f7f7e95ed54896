//! How long a unit is, from marker tags of known size that cameras from elsewhere see: their corners are
//! triangulated, and no ring is asked for.

use crate::frame::placed_tag::{PlacedTag, placed};
use crate::mat::corners::mat_corners;
use nalgebra::Vector3;
use shape::{Cameras, Mat, Tags};

/// The scale by the tags, in the cameras' unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct TagScale {
    /// Millimetres of a unit.
    pub(crate) mm_per_unit: f64,
    /// Its standard deviation, as a share.
    pub(crate) sigma: f64,
    /// Height of the level ground that the tags are on; none where they are on none.
    pub(crate) ground: Option<f64>,
    /// So many tags gave it.
    pub(crate) tags: usize,
}

/// What is known of the tags.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Known<'a> {
    /// Edge length of a tag's black square. \[mm\]
    pub(crate) tag_mm: f64,
    /// Their layout, where that is known.
    pub(crate) mat: Option<&'a Mat>,
    /// Most by which a tag's corners may miss their rays, root mean square. \[px\]
    pub(crate) most_px: f64,
}

/// A side of a printed square seems so much longer or shorter, by exposure and blur. By hand: looked at one capture,
/// halved and doubled: no more than chance (docs/lab/numbers.md). \[px\]
const BLOOM_PX: f64 = 0.3;

/// No scale is surer than this share: what is printed or measured, and its reading. By hand: looked at two captures,
/// halved and doubled: no more than chance (docs/lab/numbers.md).
pub(super) const LEAST_SCALE_SIGMA: f64 = 0.001;

/// How long a unit is. `None` where no tag is seen well enough from two sides.
pub(crate) fn tag_scale(cameras: &Cameras, tags: &Tags, known: &Known<'_>) -> Option<TagScale> {
    let of_mat = |id: u32| known.mat.is_none_or(|mat| mat_corners(mat, id).is_some());
    let placed = placed(cameras, tags, of_mat, known.most_px);
    let (mm_per_unit, sigma) = match known.mat.and_then(|mat| by_layout(&placed, mat)) {
        Some(laid) => laid,
        None => by_sides(&placed, known.tag_mm)?,
    };
    Some(TagScale {
        mm_per_unit,
        sigma: libm::hypot(sigma, LEAST_SCALE_SIGMA),
        ground: ground(&placed),
        tags: placed.len(),
    })
}

/// By how far the tags' middles are apart, which no bloom moves: all lengths of the layout against all that
/// were found, and how far single ones differ.
fn by_layout(placed: &[PlacedTag], mat: &Mat) -> Option<(f64, f64)> {
    let mut pairs = Vec::new();
    for (k, a) in placed.iter().enumerate() {
        for b in &placed[k + 1..] {
            let laid = |tag: &PlacedTag| {
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
fn by_sides(placed: &[PlacedTag], tag_mm: f64) -> Option<(f64, f64)> {
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

/// The height of tags that are level, if all that are level are at one.
fn ground(placed: &[PlacedTag]) -> Option<f64> {
    let level: Vec<&PlacedTag> = placed.iter().filter(|tag| tag.is_level()).collect();
    let mut heights: Vec<f64> = level.iter().map(|tag| tag.middle().z).collect();
    heights.sort_by(f64::total_cmp);
    let (lowest, highest) = (heights.first()?, heights.last()?);
    (highest - lowest < level[0].side()).then(|| heights[heights.len() / 2])
}

#[cfg(test)]
pub(crate) mod tests;
