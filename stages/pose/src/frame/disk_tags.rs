//! Marker tags of any size that turn with a disk: they are on it, so its edge is outside of them and at their height.

use crate::frame::placed_tag::{PlacedTag, placed};
use crate::frame::stature::Stature;
use shape::{Cameras, Tags};

/// The disk by the tags on it, in the cameras' unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct DiskTags {
    /// Height of the tags.
    pub(crate) height: f64,
    /// How far the tags reach from the axis: the disk's edge is not nearer.
    pub(crate) reach: f64,
    /// Heights at which the disk's edge may be: a mat is no thicker than one of the eight modules of a tag's side, and a
    /// height is found to a pixel.
    pub(crate) edge: [f64; 2],
}

/// Tags that turn with the cameras and are level, two or more at one height. A tag beside the disk or on a wall does
/// not turn, so its rays do not meet; one that is higher than the feet, as on clothes or a box, does not count.
pub(crate) fn on_disk(
    cameras: &Cameras,
    tags: &Tags,
    body: Option<&Stature>,
    most_px: f64,
) -> Option<DiskTags> {
    let low = |z: f64| body.is_none_or(|b| z < b.ground + 0.1 * (b.crown - b.ground));
    let mut all = placed(cameras, tags, |_| true, most_px);
    all.retain(|tag| tag.is_level() && low(tag.middle().z));
    let height = shape::upper_median(all.iter().map(|tag| tag.middle().z))?;
    let side = shape::upper_median(all.iter().map(PlacedTag::side))?;
    all.retain(|tag| (tag.middle().z - height).abs() < side / 2.0);
    // The second farthest: one that is none, or is placed badly, does not count.
    let mut far: Vec<f64> = all.iter().map(outermost).collect();
    far.sort_by(|a, b| b.total_cmp(a));
    let reach = *far.get(1)?;
    let height = shape::upper_median(all.iter().map(|tag| tag.middle().z))?;
    let pixel = shape::upper_median(all.iter().map(|tag| tag.pixel))?;
    Some(DiskTags {
        height,
        reach,
        edge: [height - side / 8.0, height + pixel],
    })
}

/// How far a tag's outermost corner is from the axis, for sure: a pixel less than it was found.
fn outermost(tag: &PlacedTag) -> f64 {
    let far = |c: &nalgebra::Point3<f64>| libm::hypot(c.x, c.y);
    tag.corners.iter().map(far).fold(0.0, f64::max) - tag.pixel
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::tag_scale::tests::{MAT, MM_PER_UNIT, seen, walk};
    use shape::{PhotoId, Tag};

    #[test]
    fn tags_give_their_reach_and_their_height_whatever_their_size() {
        let cameras = walk();
        let found = on_disk(&cameras, &seen(&cameras, -31.0, 0.0), None, 2.0).unwrap();
        let corner = libm::hypot(MAT.ring_mm + MAT.tag_mm / 2.0, MAT.tag_mm / 2.0) / MM_PER_UNIT;
        proof::near(found.reach, corner, 1.0);
        assert!(found.reach < corner, "{} of {corner}", found.reach);
        proof::near(found.height, -31.0, 0.5);
    }

    #[test]
    fn tags_that_are_none_do_not_tell() {
        let cameras = walk();
        let tag = |id, at: [f64; 2]| {
            let corners = [[0.0, 0.0], [40.0, 0.0], [40.0, 30.0], [0.0, 30.0]];
            let corners = corners.map(|c| [c[0] + at[0], c[1] + at[1]]);
            Tag { id, corners }
        };
        // The same places of all photos: something that does not turn, or the background's own patterns.
        let still = |id: PhotoId| (id, vec![tag(50, [300.0, 1300.0]), tag(51, [800.0, 1250.0])]);
        let alone = Tags {
            views: cameras.views.iter().map(|(id, _)| still(id)).collect(),
        };
        assert_eq!(on_disk(&cameras, &alone, None, 2.0), None);
        let mut tags = seen(&cameras, 0.0, 0.0);
        let found = on_disk(&cameras, &tags, None, 2.0);
        for id in cameras.views.iter().map(|(id, _)| id) {
            let Some(of) = tags.views.get_mut(id) else {
                continue;
            };
            of.extend(still(id).1);
        }
        assert_eq!(on_disk(&cameras, &tags, None, 2.0), found);
    }
}
