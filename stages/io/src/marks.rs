//! What was found on photos as pictures to look at.

use shape::{Features, Keypoints, PhotoError, PhotoId, Photos, Rgb, Tracks, rgb_to_png};

/// Longer side of the pictures (structural: size of a picture). \[px\]
const LONGER: usize = 1200;

/// A photo reduced by a whole factor and dimmed, so that marks are easy to see; and the factor.
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

/// A straight line of one pixel; what is outside the picture is not drawn.
pub(crate) fn line(picture: &mut Rgb, from: [f32; 2], to: [f32; 2], colour: [u8; 3]) {
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
            let (sin, cos) = libm::sincosf(turn);
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
///
/// # Errors
///
/// A photo cannot be decoded.
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
///
/// # Errors
///
/// A photo cannot be decoded.
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
            let far = libm::hypotf(to[0] - from[0], to[1] - from[1]);
            let red = (far / (0.1 * LONGER as f32)).min(1.0);
            let colour = [(80.0 + 175.0 * red) as u8, (230.0 * (1.0 - red)) as u8, 60];
            line(picture, from, to, colour);
        }
    })
}

/// Each photo, reduced and dimmed, with what `draw` draws on it; `draw` is given the factor by which it is reduced.
pub(crate) fn drawn(
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_ends_where_it_should_and_stays_inside() {
        let mut picture = Rgb::filled(8, 6, [0; 3]);
        line(&mut picture, [-5.0, 2.0], [6.0, 2.0], [9, 9, 9]);
        let on = |x: usize, y: usize| picture.at(x, y) == [9; 3];
        assert!((0..=6).all(|x| on(x, 2)) && !on(7, 2) && !on(3, 3));
    }

    #[test]
    fn a_feature_is_drawn_around_its_place() {
        let mut picture = Rgb::filled(60, 60, [0; 3]);
        let mut own = Features::default();
        own.points.push(shape::Keypoint {
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
