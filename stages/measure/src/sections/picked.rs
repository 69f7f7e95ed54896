//! The paper's girth from points picked by hand (§III-E): plane, more points (eq. 8), spline.

use crate::geometry::section::{flat, length, tape};
use crate::geometry::slices::nearest_ring;
use crate::geometry::slices::rings;
use crate::geometry::spline::{fitted_plane, grown, paper_girth};
use nalgebra::{Point3, Vector3};
use shape::{Girth, GirthId, Landmark, Mesh, Part, Sigmas};

/// Points that give no girth.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum BadPoints {
    /// A point has not three coordinates.
    #[error(
        "a point of `points` has not three numbers: give [[x, y, z], ...] in millimetres, in the turntable frame"
    )]
    NotThree,
    /// Too few, or on one line.
    #[error("`points` give no plane: pick at least three around the body, not on one line")]
    NoPlane,
    /// The plane misses the surface.
    #[error(
        "the plane through `points` meets no closed section of the surface near them: are they in millimetres, \
         in the turntable frame?"
    )]
    NoSection,
}

/// How far from where it was meant a hand picks, along the limb: one standard deviation.
/// By hand: looked at three scans and five captures, at 0.7 and 1.4 of it: nothing changes, for nobody picked. \[mm\]
const HAND_MM: f64 = 3.0;

/// The girth through points picked around a limb or the trunk, by the paper's procedure. How sure it is
/// tells of the hand alone: how the tape changes where it is taken a little beside.
///
/// # Errors
///
/// Too few points, or points that give no plane with a section.
pub fn picked(mesh: &Mesh, points: &[Vec<f64>]) -> Result<Girth, BadPoints> {
    let points: Vec<Point3<f64>> = points
        .iter()
        .map(|p| match p.as_slice() {
            [x, y, z] => Ok(Point3::new(*x, *y, *z)),
            _ => Err(BadPoints::NotThree),
        })
        .collect::<Result<_, _>>()?;
    let first = fitted_plane(&points).ok_or(BadPoints::NoPlane)?;
    let middle = Point3::from(first.point_mm);
    let across = |p: &Point3<f64>| (p - middle).cross(&(points[0] - middle)).norm();
    let wide = points.iter().map(across).fold(0.0, f64::max);
    if wide < 1.0 {
        return Err(BadPoints::NoPlane);
    }
    let (plane, _) = grown(mesh, &points).ok_or(BadPoints::NoSection)?;
    // The ring that the picked points are on.
    let off = |curve: &[Point3<f64>]| {
        let least = |p: &Point3<f64>| {
            let all = curve.iter().map(|c| (c - p).norm());
            all.fold(f64::MAX, f64::min)
        };
        points.iter().map(least).fold(0.0, f64::max)
    };
    let reach = points
        .iter()
        .map(|p| (p - middle).norm())
        .fold(0.0, f64::max);
    let ring = rings(mesh, &plane)
        .into_iter()
        .min_by(|a, b| off(&a.curve).total_cmp(&off(&b.curve)))
        .filter(|r| off(&r.curve) < 0.5 * reach)
        .ok_or(BadPoints::NoSection)?;
    let flat = flat(&ring.curve, &plane);
    let spline_mm = paper_girth(mesh, &ring.curve).ok_or(BadPoints::NoSection)?;
    let normal = Vector3::from(plane.normal);
    let up = if normal.z < 0.0 { -normal } else { normal };
    let plane = shape::Plane {
        point_mm: ring.centre.into(),
        normal: up.into(),
    };
    let tape_mm = tape(&flat);
    let beside = |by: f64| {
        let point = ring.centre + up * by;
        let moved = shape::Plane {
            point_mm: point.into(),
            ..plane
        };
        Some(nearest_ring(mesh, &moved)?.tape - tape_mm)
    };
    let changes: Vec<f64> = [-HAND_MM, HAND_MM].into_iter().filter_map(beside).collect();
    let square = changes.iter().map(|c| c * c).sum::<f64>() / changes.len() as f64;
    let mark = Landmark::new(GirthId::Picked, plane, Part::Trunk);
    Ok(Girth {
        contour_mm: length(&flat),
        spline_mm,
        sigmas: Sigmas {
            level_mm: (!changes.is_empty()).then(|| square.sqrt()),
            split_mm: Some(0.0),
            ..Sigmas::default()
        },
        contour: ring
            .curve
            .iter()
            .map(|p| [p.x as f32, p.y as f32, p.z as f32])
            .collect(),
        ..Girth::at(&mark, tape_mm)
    })
}
