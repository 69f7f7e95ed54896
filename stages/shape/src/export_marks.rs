//! What was found on photos, and where cameras stand, as pictures to look at.

use crate::{
    Cameras, Features, Keypoints, PhotoError, PhotoId, Photos, Rgb, Tracks, Unit,
    bounding_cylinder, rgb_to_png,
};
use nalgebra::{Point3, Vector3};
use std::fmt::Write as _;

/// Longer side of the pictures. \[px\]
const LONGER: usize = 1200;

/// A photo reduced by a whole factor and dimmed, so that marks stand out; and the factor.
fn dimmed(photos: &Photos, id: PhotoId) -> Option<Result<(Rgb, f32), PhotoError>> {
    let photo = photos.get(id)?;
    Some(photo.decode().map(|rgb| {
        let by = rgb.width.max(rgb.height).div_ceil(LONGER);
        let (width, height) = (rgb.width / by, rgb.height / by);
        let mut small = Rgb::filled(width, height, [0; 3]);
        for (i, pixel) in small.data.iter_mut().enumerate() {
            let from = rgb.at(i % width * by, i / width * by);
            let light = from.iter().map(|v| u32::from(*v)).sum::<u32>() / 6;
            *pixel = [light as u8; 3];
        }
        (small, by as f32)
    }))
}

/// A straight line of one pixel; what lies outside the picture is not drawn.
fn line(picture: &mut Rgb, from: [f32; 2], to: [f32; 2], colour: [u8; 3]) {
    let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
    let steps = dx.abs().max(dy.abs()).ceil().clamp(1.0, 1e5);
    for k in 0..=steps as usize {
        let t = k as f32 / steps;
        let (x, y) = ((from[0] + t * dx).round(), (from[1] + t * dy).round());
        if x >= 0.0 && y >= 0.0 && x < picture.width as f32 && y < picture.height as f32 {
            *picture.at_mut(x as usize, y as usize) = colour;
        }
    }
}

/// A photo's features: a circle of three times their scale each, a line along their direction.
fn features(picture: &mut Rgb, by: f32, features: &Features) {
    for k in &features.points {
        let at = |turn: f32, far: f32| {
            let (sin, cos) = turn.sin_cos();
            [k.x / by + far * cos, k.y / by + far * sin]
        };
        let far = (3.0 * k.scale / by).max(1.0);
        let colour = if k.scale < 3.0 {
            [255, 210, 60]
        } else {
            [90, 200, 255]
        };
        let corner = |i: u8| at(k.angle + f32::from(i) * std::f32::consts::TAU / 12.0, far);
        (0..12).for_each(|i| line(picture, corner(i), corner(i + 1), colour));
        line(picture, at(0.0, 0.0), at(k.angle, far), colour);
    }
}

/// Each photo with its features drawn on it, named as the photo.
pub fn keypoints_to_png(
    found: &Keypoints,
    photos: &Photos,
) -> Result<Vec<(String, Vec<u8>)>, PhotoError> {
    drawn(photos, |id, picture, by| {
        if let Some(own) = found.views.get(id) {
            features(picture, by, own);
        }
    })
}

/// Each photo with lines from where points are seen on it to where they are seen on the next one,
/// named as the photo. Long lines are red: they are the first to be looked at.
pub fn tracks_to_png(
    tracks: &Tracks,
    photos: &Photos,
) -> Result<Vec<(String, Vec<u8>)>, PhotoError> {
    let count = photos.photos.len().max(1) as u32;
    drawn(photos, |id, picture, by| {
        let next = PhotoId((id.0 + 1) % count);
        for track in &tracks.points {
            let on = |id: PhotoId| track.iter().find(|s| s.photo == id);
            let Some((a, b)) = on(id).zip(on(next)) else {
                continue;
            };
            let (from, to) = (a.at_px.map(|v| v / by), b.at_px.map(|v| v / by));
            let far = (to[0] - from[0]).hypot(to[1] - from[1]);
            let red = (far / (0.1 * LONGER as f32)).min(1.0);
            let colour = [(80.0 + 175.0 * red) as u8, (230.0 * (1.0 - red)) as u8, 60];
            line(picture, from, to, colour);
        }
    })
}

fn drawn(
    photos: &Photos,
    mut draw: impl FnMut(PhotoId, &mut Rgb, f32),
) -> Result<Vec<(String, Vec<u8>)>, PhotoError> {
    let mut files = Vec::new();
    for (id, photo) in photos.iter() {
        let Some(picture) = dimmed(photos, id) else {
            continue;
        };
        let (mut picture, by) = picture?;
        draw(id, &mut picture, by);
        let stem = photo
            .name
            .rsplit_once('.')
            .map_or(photo.name.as_str(), |n| n.0);
        files.push((format!("{stem}.png"), rgb_to_png(&picture)));
    }
    Ok(files)
}

/// The cameras around the subject, seen from above at a slant: their path, where each looks, the
/// disk, the cylinder that all of them have in view, and the points that hold them (the paper's Fig. 2).
pub fn cameras_to_svg(cameras: &Cameras) -> String {
    let centres: Vec<Point3<f64>> = cameras.views.values().map(|v| v.camera.centre()).collect();
    let radius = centres
        .iter()
        .map(|c| c.x.hypot(c.y))
        .fold(1.0f64, f64::max);
    // Seen along -y and down by 35°.
    let (sin, cos) = 35f64.to_radians().sin_cos();
    let unit = 260.0 / radius;
    let flat = |p: &Point3<f64>| [p.x * unit, -(p.y * sin + p.z * cos) * unit];
    let path = |points: &[Point3<f64>]| {
        let one = |p: &Point3<f64>| format!("{:.1},{:.1} ", flat(p)[0], flat(p)[1]);
        points.iter().map(one).collect::<String>()
    };
    let mut svg = String::from(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"-320 -330 640 600\" font-family=\"sans-serif\" font-size=\"11\">\n<rect x=\"-320\" y=\"-330\" width=\"640\" height=\"600\" fill=\"white\"/>\n<g fill=\"#888\">\n",
    );
    let every = cameras.points.len().div_ceil(3000).max(1);
    for p in cameras.points.iter().step_by(every) {
        let at = flat(&Point3::from(p.map(f64::from)));
        if at[0].hypot(at[1]) < 900.0 {
            let _ = writeln!(
                svg,
                "<circle cx=\"{:.1}\" cy=\"{:.1}\" r=\"0.8\"/>",
                at[0], at[1]
            );
        }
    }
    svg.push_str("</g>\n");
    if let Some(disk) = cameras.disk_radius_mm {
        let rim: Vec<_> = (0..72)
            .map(|i| {
                let (s, c) = (f64::from(i) * 5f64.to_radians()).sin_cos();
                Point3::new(disk * c, disk * s, 0.0)
            })
            .collect();
        let _ = writeln!(
            svg,
            "<polygon points=\"{}\" fill=\"none\" stroke=\"#b80\"/>",
            path(&rim)
        );
    }
    if let Some(cylinder) = bounding_cylinder(cameras) {
        let angle = |i: i32| f64::from(i) * 5f64.to_radians();
        for share in [0.0, 1.0] {
            let rim: Vec<_> = (0..72).map(|i| cylinder.point(angle(i), share)).collect();
            let _ = writeln!(
                svg,
                "<polygon points=\"{}\" fill=\"#d43\" fill-opacity=\"0.13\" stroke=\"#c33\"/>",
                path(&rim)
            );
        }
        // Its outline as seen from here.
        for i in [0, 36] {
            let side = [0.0, 1.0].map(|share| cylinder.point(angle(i), share));
            let _ = writeln!(
                svg,
                "<polyline points=\"{}\" stroke=\"#c33\"/>",
                path(&side)
            );
        }
        let unit = match cameras.scale.unit() {
            Unit::Metric => " mm",
            Unit::Relative => " of a ring of 1000",
        };
        let _ = writeln!(
            svg,
            "<text x=\"-310\" y=\"-312\" fill=\"#c33\">in view of all cameras: radius {:.0}{unit}, height {:.0} to {:.0}{unit}</text>",
            cylinder.radius, cylinder.bottom, cylinder.top
        );
    }
    let _ = writeln!(
        svg,
        "<polyline points=\"{}\" fill=\"none\" stroke=\"#bbb\" stroke-dasharray=\"3 3\"/>",
        path(&centres)
    );
    for (view, centre) in cameras.views.values().zip(&centres) {
        let lens = &view.camera.lens;
        let reach = 0.12 * radius;
        let corner = |x: f64, y: f64| {
            let ray = Vector3::new(
                (x * f64::from(lens.width) - lens.centre[0]) / lens.focal[0],
                (y * f64::from(lens.height) - lens.centre[1]) / lens.focal[1],
                1.0,
            );
            centre + view.camera.pose.rotation.inverse() * ray * reach
        };
        let frame = [
            corner(0.0, 0.0),
            corner(1.0, 0.0),
            corner(1.0, 1.0),
            corner(0.0, 1.0),
        ];
        let _ = writeln!(
            svg,
            "<polygon points=\"{}\" fill=\"#7ac\" fill-opacity=\"0.27\" stroke=\"#27a\"/>",
            path(&frame)
        );
        for c in &frame {
            let _ = writeln!(
                svg,
                "<polyline points=\"{}\" stroke=\"#27a\"/>",
                path(&[*centre, *c])
            );
        }
        let at = flat(centre);
        let name = view.name.replace('&', "&amp;").replace('<', "&lt;");
        let _ = writeln!(
            svg,
            "<text x=\"{:.1}\" y=\"{:.1}\">{name}</text>",
            at[0] + 4.0,
            at[1] - 4.0
        );
    }
    svg.push_str("</svg>\n");
    svg
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_ends_where_it_is_told_and_stays_inside() {
        let mut picture = Rgb::filled(8, 6, [0; 3]);
        line(&mut picture, [-5.0, 2.0], [6.0, 2.0], [9, 9, 9]);
        let on = |x: usize, y: usize| picture.at(x, y) == [9; 3];
        assert!((0..=6).all(|x| on(x, 2)) && !on(7, 2) && !on(3, 3));
    }

    #[test]
    fn a_feature_is_drawn_around_its_place() {
        let mut picture = Rgb::filled(60, 60, [0; 3]);
        let mut own = Features::default();
        own.points.push(crate::Keypoint {
            x: 60.0,
            y: 60.0,
            scale: 6.0,
            angle: 0.0,
        });
        features(&mut picture, 2.0, &own);
        assert_ne!(picture.at(39, 30), [0; 3]);
        assert_ne!(picture.at(21, 30), [0; 3]);
        assert_eq!(picture.at(30, 25), [0; 3]);
    }
}
