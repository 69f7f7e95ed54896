//! See-through holes: holes that one photo alone has, though their rays pass a long way through the hull of the others.
//!
//! A gap through which a photo looks is open to its neighbours from both sides, so that they leave only the
//! middle of it: of a gap of width w that is d deep, d - 2 w / tan θ where they stand θ to either side. A hole
//! that is long in the hull of the others is therefore no gap, but a garment of the wall's colour.

use crate::label::body_hull::Hull;
use crate::label::consensus::Together;
use crate::label::parts::parts;
use nalgebra::Point2;
use shape::{Camera, HullCells, Image, PhotoId};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Half of a tunnel's rays are longer than this share of the body's height. Of 145 gaps on photos of three bodies
/// and of six scans none came to more than 0.022, a shirt's hole to 0.107.
const MAX_GAP_SHARE: f64 = 0.06;
/// Neighbours that stand farther off do not see into a gap. \[deg\]
const NEIGHBOUR_DEG: f64 = 25.0;

/// How long the rays of a photo's pixels are within the hull of the others.
pub struct Depths {
    hull: Arc<Hull>,
    camera: Camera,
}

impl Depths {
    /// Pixels of a cut's holes that are no gaps.
    pub(crate) fn see_through_holes(&self, cut: &Image<bool>) -> Vec<usize> {
        let (of, sizes) = parts(&cut.map(|b| !b), true);
        let mut holes: Vec<Vec<usize>> = vec![Vec::new(); sizes.len()];
        let mut open = vec![false; sizes.len()];
        for (i, of) in of
            .data
            .iter()
            .enumerate()
            .filter(|(_, of)| **of != u32::MAX)
        {
            let (x, y) = (i % cut.width, i / cut.width);
            let edge = x == 0 || y == 0 || x + 1 == cut.width || y + 1 == cut.height;
            open[*of as usize] |= edge;
            holes[*of as usize].push(i);
        }
        let closed = holes.into_iter().zip(open).filter(|(_, open)| !open);
        let no_gap = |hole: &Vec<usize>| {
            let long = hole.iter().filter(|i| self.long(**i, cut.width)).count();
            2 * long > hole.len()
        };
        closed
            .map(|(hole, _)| hole)
            .filter(no_gap)
            .flatten()
            .collect()
    }

    /// Whether the ray of a pixel passes a long way through the hull.
    fn long(&self, i: usize, width: usize) -> bool {
        let at = Point2::new((i % width) as f64, (i / width) as f64);
        let along = self
            .hull
            .along(&self.camera.centre(), &self.camera.ray(at), MAX_GAP_SHARE);
        along > MAX_GAP_SHARE * self.hull.height
    }
}

/// Of each photo that has neighbours to both sides.
pub(crate) fn depths(all: &Together<'_>) -> BTreeMap<PhotoId, Depths> {
    let Some(hull) = Hull::of(all) else {
        return BTreeMap::new();
    };
    let hull = Arc::new(hull);
    let views: Vec<(PhotoId, Camera)> = all.views.iter().map(|(id, _, c)| (*id, *c)).collect();
    among(hull, &views)
}

/// The same of a hull that was found, and the cameras of all photos that have the body on them, at their reduced size.
pub(crate) fn depths_in(
    cells: &HullCells,
    views: &[(PhotoId, Camera)],
) -> BTreeMap<PhotoId, Depths> {
    among(Arc::new(Hull::from(cells)), views)
}

/// The hull that all go by, if there is one.
pub(crate) fn cells(depths: &BTreeMap<PhotoId, Depths>) -> Option<HullCells> {
    Some(depths.values().next()?.hull.cells())
}

/// The photos that have neighbours to both sides.
fn among(hull: Arc<Hull>, views: &[(PhotoId, Camera)]) -> BTreeMap<PhotoId, Depths> {
    let among = views.iter().filter(|view| has_neighbours(view, views));
    let one = |(id, camera): &(PhotoId, Camera)| {
        let (hull, camera) = (Arc::clone(&hull), *camera);
        (*id, Depths { hull, camera })
    };
    among.map(one).collect()
}

/// Whether photos to both sides were taken near by.
fn has_neighbours(view: &(PhotoId, Camera), all: &[(PhotoId, Camera)]) -> bool {
    let azimuth = |view: &(PhotoId, Camera)| {
        let at = view.1.centre();
        libm::atan2(at.y, at.x).to_degrees()
    };
    let here = azimuth(view);
    let ahead = |other: &(PhotoId, Camera)| (azimuth(other) - here).rem_euclid(360.0);
    let others: Vec<f64> = all.iter().filter(|o| o.0 != view.0).map(ahead).collect();
    others.iter().any(|a| *a <= NEIGHBOUR_DEG) && others.iter().any(|a| *a >= 360.0 - NEIGHBOUR_DEG)
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use nalgebra::{Matrix3, Point3, Rotation3, Vector3};
    use shape::{Cameras, Intrinsics, Mask, Pose, Scale};

    pub(crate) const SIZE: (usize, usize) = (240, 320);

    /// A trunk on two legs, 22 mm apart, that stand on a board. \[mm\]
    fn body(x: &Point3<f64>) -> bool {
        let leg = libm::hypot(x.x.abs() - 61.0, x.y) < 50.0;
        let trunk = (x.x / 112.0).powi(2) + (x.y / 55.0).powi(2) < 1.0;
        let board = x.x.abs() < 112.0 && x.y.abs() < 50.0 && (0.0..20.0).contains(&x.z);
        board || (0.0..260.0).contains(&x.z) && leg || (250.0..520.0).contains(&x.z) && trunk
    }

    fn camera(angle: f64) -> Camera {
        let (s, c) = libm::sincos(angle);
        let rows = Matrix3::new(c, s, 0.0, 0.0, 0.0, -1.0, -s, c, 0.0);
        Camera {
            lens: Intrinsics::simple(SIZE.0 as u32, SIZE.1 as u32, 800.0),
            pose: Pose {
                rotation: Rotation3::from_matrix_unchecked(rows),
                translation: Vector3::new(0.0, 260.0, 1600.0),
            },
        }
    }

    fn mask(camera: &Camera) -> Mask {
        let shows = |i: usize| {
            let at = Point2::new((i % SIZE.0) as f64, (i / SIZE.0) as f64);
            let (from, ray) = (camera.centre(), camera.ray(at).into_inner());
            (0..84).any(|k| body(&(from + ray * (1430.0 + 4.0 * f64::from(k)))))
        };
        let pixels = (0..SIZE.0 * SIZE.1).map(|i| if shows(i) { 255 } else { 0 });
        Mask {
            width: SIZE.0,
            height: SIZE.1,
            data: pixels.collect(),
        }
    }

    /// Masks of so many photos of a turn, and their cameras.
    pub(crate) fn turn(photos: usize) -> (Vec<(PhotoId, Mask)>, Cameras) {
        let angle = |k: usize| k as f64 * std::f64::consts::TAU / photos as f64;
        let all: Vec<Camera> = (0..photos).map(|k| camera(angle(k))).collect();
        let masks: Vec<(PhotoId, Mask)> = (0..photos as u32)
            .map(PhotoId)
            .zip(all.iter().map(mask))
            .collect();
        let view = |camera: &Camera| shape::View {
            name: String::new(),
            camera: *camera,
            sigma_mm: None,
            rms_px: None,
            points: 0,
        };
        let views = masks.iter().map(|m| m.0).zip(all.iter().map(view));
        let cameras = Cameras {
            views: views.collect(),
            scale: Scale::Given,
            scale_sigma: None,
            disk_radius_mm: None,
            ground_mm: 0.0,
            points: vec![],
        };
        (masks, cameras)
    }

    /// Whether a pixel of the first photo lies in a square amid the trunk.
    pub(crate) fn amid(i: usize) -> bool {
        (110..126).contains(&(i % SIZE.0)) && (90..106).contains(&(i / SIZE.0))
    }

    /// Pixels of the first photo between the legs.
    pub(crate) fn between_legs(first: &Mask) -> Vec<usize> {
        (0..first.data.len())
            .filter(|i| first.data[*i] == 0 && (117..123).contains(&(i % SIZE.0)))
            .filter(|i| (170..280).contains(&(i / SIZE.0)))
            .collect()
    }

    /// Pixels of the first photo of so many that are a gap, of which found, and of a hole amid the trunk.
    fn found(photos: usize) -> Option<[usize; 4]> {
        let (mut masks, cameras) = turn(photos);
        let gap = between_legs(&masks[0].1);
        (0..SIZE.0 * SIZE.1)
            .filter(|i| amid(*i))
            .for_each(|i| masks[0].1.data[i] = 0);
        let together = Together::of(&masks, &cameras).expect("a hull");
        let depths = depths(&together);
        let see_through_holes = depths
            .get(&PhotoId(0))?
            .see_through_holes(&masks[0].1.map(|c| *c > 127));
        let in_gap = see_through_holes.iter().filter(|i| gap.contains(i)).count();
        let in_hole = see_through_holes.iter().filter(|i| amid(**i)).count();
        Some([gap.len(), in_gap, 256, in_hole])
    }

    #[test]
    fn a_hole_amid_the_trunk_is_a_tunnel_and_a_gap_between_legs_is_not() {
        let [gap, in_gap, hole, in_hole] = found(18).expect("neighbours");
        assert!(gap > 600 && in_gap == 0, "{in_gap} of {gap}");
        assert!(in_hole * 10 > hole * 9, "{in_hole} of {hole}");
    }

    #[test]
    fn photos_far_apart_tell_no_gap_from_a_tunnel() {
        assert_eq!(found(12), None);
    }
}
