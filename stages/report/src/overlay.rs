//! A small picture of each photo with the silhouette's outline and the sections over it.

use crate::tables::escaped;
use base64::prelude::{BASE64_STANDARD, Engine as _};
use nalgebra::{Point2, Point3};
use shape::{Camera, Girth, Girths, Mask, Rgb, rgb_to_jpeg};
use std::fmt::Write;

/// The whole factor by which a photo of some height is reduced to at most `most_px`.
pub(crate) fn factor(height: usize, most_px: usize) -> usize {
    height.div_ceil(most_px.max(1)).max(1)
}

/// The photo, reduced by a whole factor.
pub(crate) fn reduced(photo: &Rgb, factor: usize) -> Rgb {
    let (width, height) = (photo.width / factor, photo.height / factor);
    let mut small = Rgb::filled(width, height, [0; 3]);
    for (y, x) in (0..height).flat_map(|y| (0..width).map(move |x| (y, x))) {
        let mut sum = [0u32; 3];
        for dy in 0..factor {
            let row = &photo.row(y * factor + dy)[x * factor..(x + 1) * factor];
            row.iter()
                .for_each(|p| (0..3).for_each(|c| sum[c] += u32::from(p[c])));
        }
        *small.at_mut(x, y) = sum.map(|s| (s / (factor * factor) as u32) as u8);
    }
    small
}

/// What one figure shows.
pub(crate) struct Shown<'a> {
    /// The photo's place in the turn.
    pub(crate) index: usize,
    /// Its file name.
    pub(crate) name: &'a str,
    /// Width and height of the photo. \[px\]
    pub(crate) size: [usize; 2],
    /// The whole factor by which it is reduced.
    pub(crate) factor: usize,
    /// The reduced photo, if it may be shown.
    pub(crate) photo: Option<Rgb>,
    /// Its silhouette.
    pub(crate) mask: Option<&'a Mask>,
    /// Its camera.
    pub(crate) camera: Option<&'a Camera>,
}

/// One figure: the reduced photo, the outline of its mask and the sections as SVG paths over it.
pub(crate) fn figure(shown: &Shown<'_>, girths: &Girths) -> String {
    let [w, h] = shown.size.map(|s| s / shown.factor);
    let mut svg = format!(
        "<figure data-photo=\"{}\">\
         <svg viewBox=\"0 0 {w} {h}\" tabindex=\"0\" role=\"button\" aria-label=\"enlarge {}\">",
        shown.index,
        escaped(shown.name)
    );
    if let Some(photo) = &shown.photo {
        let _ = write!(
            svg,
            "<image width=\"{w}\" height=\"{h}\" href=\"data:image/jpeg;base64,{}\"/>",
            BASE64_STANDARD.encode(rgb_to_jpeg(photo, 70))
        );
    }
    if let Some(mask) = shown.mask {
        let d = outline(mask, shown.factor, w, h);
        let _ = write!(svg, "<path class=\"outline\" d=\"{d}\"/>");
    }
    if let Some(camera) = shown.camera {
        for girth in &girths.girths {
            let name = escaped(&girth.name);
            for (class, d) in ["tape far", "tape"]
                .iter()
                .zip(section(girth, camera, shown.factor))
            {
                let _ = write!(
                    svg,
                    "<path class=\"{class}\" data-name=\"{name}\" d=\"{d}\"/>"
                );
            }
        }
    }
    svg + "</svg><figcaption>" + &escaped(shown.name) + "</figcaption></figure>"
}

/// The section on the reduced photo: what is behind the body, and what the camera sees. A piece
/// of the contour counts as seen if its outward normal in the plane points to the camera.
fn section(girth: &Girth, camera: &Camera, factor: usize) -> [String; 2] {
    let step = (girth.contour.len() / 160).max(1);
    let points: Vec<Point3<f64>> = girth
        .contour
        .iter()
        .step_by(step)
        .map(|p| Point3::from(p.map(f64::from)))
        .collect();
    let normal = nalgebra::Vector3::from(girth.plane.normal);
    let middle = Point3::from(girth.plane.point_mm);
    // The sign of twice the area gives which way the contour runs around the normal.
    let pairs = || points.iter().zip(points.iter().cycle().skip(1));
    let turns: f64 = pairs()
        .map(|(a, b)| (a - middle).cross(&(b - middle)).dot(&normal))
        .sum();
    let mut paths = [String::new(), String::new()];
    let mut before = None;
    for (a, b) in pairs() {
        let outward = (b - a).cross(&normal) * turns.signum();
        let seen = usize::from(outward.dot(&(camera.centre() - a)) > 0.0);
        let (Some(from), Some(to)) = (camera.project(a), camera.project(b)) else {
            before = None;
            continue;
        };
        // In SVG the middle of the first pixel is at (0.5, 0.5).
        let small = |p: Point2<f64>| p.coords.add_scalar(0.5) / factor as f64;
        if before != Some(seen) {
            let at = small(from);
            let _ = write!(paths[seen], "M{:.1},{:.1}", at.x, at.y);
        }
        let at = small(to);
        let _ = write!(paths[seen], "L{:.1},{:.1}", at.x, at.y);
        before = Some(seen);
    }
    paths
}

/// The border of a mask on the reduced photo, as pieces along pixel edges.
fn outline(mask: &Mask, factor: usize, w: usize, h: usize) -> String {
    let at = |x: usize, y: usize| {
        let (x, y) = (x * factor + factor / 2, y * factor + factor / 2);
        x < mask.width && y < mask.height && mask.at(x, y) > 127
    };
    let mut d = String::new();
    for y in 1..h {
        let mut x = 0;
        while x < w {
            let run = (x..w).take_while(|x| at(*x, y) != at(*x, y - 1)).count();
            if run > 0 {
                let _ = write!(d, "M{x},{y}h{run}");
            }
            x += run.max(1);
        }
    }
    for x in 1..w {
        let mut y = 0;
        while y < h {
            let run = (y..h).take_while(|y| at(x, *y) != at(x - 1, *y)).count();
            if run > 0 {
                let _ = write!(d, "M{x},{y}v{run}");
            }
            y += run.max(1);
        }
    }
    d
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_outline_runs_around_the_mask() {
        let mut mask = Mask::filled(8, 8, 0);
        (2..6).for_each(|y| (3..5).for_each(|x| *mask.at_mut(x, y) = 255));
        assert_eq!(outline(&mask, 1, 8, 8), "M3,2h2M3,6h2M3,2v4M5,2v4");
    }

    #[test]
    fn half_of_a_circle_is_seen_from_far_whichever_way_it_runs() {
        let rotation = nalgebra::Rotation3::from_matrix_unchecked(nalgebra::Matrix3::new(
            1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0,
        ));
        let camera = Camera {
            lens: shape::Intrinsics::simple(400, 400, 40_000.0),
            pose: shape::Pose {
                rotation,
                translation: nalgebra::Vector3::new(0.0, 0.0, 50_000.0),
            },
        };
        for turn in [1.0f32, -1.0] {
            let at = |i: i32| libm::sincosf(turn * i as f32 * std::f32::consts::TAU / 100.0);
            let contour = (0..100).map(at).map(|(s, c)| [50.0 * c, 50.0 * s, 0.0]);
            let plane = shape::Plane {
                point_mm: [0.0; 3],
                normal: [0.0, 0.0, 1.0],
            };
            let mark = shape::Landmark::new(shape::GirthId::Waist, plane, shape::Part::Trunk);
            let girth = Girth {
                contour: contour.collect(),
                ..Girth::at(&mark, 314.0)
            };
            let [far, near] = section(&girth, &camera, 1);
            let lines = |d: &str| d.matches('L').count() as i32;
            assert_eq!(lines(&far) + lines(&near), 100);
            assert!((lines(&near) - 50).abs() <= 1, "{near}");
        }
    }
}
