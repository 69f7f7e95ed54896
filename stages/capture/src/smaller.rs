//! Photos reduced by a whole factor, and what the user pointed at in them.

use shape::{Photo, PhotoError, Rgb, Rig, rgb_to_png};

/// The greatest whole factor by which a photo so long is reduced and still has `least_px`; 1 with 0.
pub(crate) fn factor(longest: u32, least_px: u32) -> usize {
    longest.checked_div(least_px).unwrap_or(1).max(1) as usize
}

/// The photo reduced as far as its longest side stays so long, pixels averaged.
pub(crate) fn smaller(photo: Photo, pixels: &Rgb, least_px: u32) -> Photo {
    let by = factor(photo.width.max(photo.height), least_px);
    if by == 1 {
        return photo;
    }
    let small = pixels.reduced(by);
    Photo {
        width: small.width as u32,
        height: small.height as u32,
        orientation: 1,
        file: rgb_to_png(&small).into(),
        ..photo
    }
}

/// The same of a plate that nobody has decoded yet.
pub(crate) fn plate_too(plate: Photo, least_px: u32) -> Result<Photo, PhotoError> {
    if factor(plate.width.max(plate.height), least_px) == 1 {
        return Ok(plate);
    }
    let pixels = plate.decode()?;
    Ok(smaller(plate, &pixels, least_px))
}

/// What is known in pixels of photos, in those of photos reduced by a factor.
pub(crate) fn on_smaller(rig: &mut Rig, by: usize) {
    if by == 1 {
        return;
    }
    let by = by as f64;
    let moved = |at: &mut [f64; 2]| at.iter_mut().for_each(|at| *at = (*at + 0.5) / by - 0.5);
    rig.focal_px = rig.focal_px.map(|focal| focal / by);
    rig.centre_px.iter_mut().for_each(moved);
    let seen = rig.reference.iter_mut().flat_map(|r| &mut r.seen);
    seen.flat_map(|ends| &mut ends.px).for_each(moved);
}

#[cfg(test)]
mod tests {
    use super::*;
    use shape::{Reference, SeenEnds};

    /// A striped photo, and its pixels.
    fn photo(width: usize, height: usize) -> (Photo, Rgb) {
        let pixels = Rgb {
            width,
            height,
            data: (0..width * height)
                .map(|i| [(i % 7) as u8 * 30; 3])
                .collect(),
        };
        let photo = Photo {
            focal_35mm: Some(50.0),
            ..Photo::of("a.png", [width as u32, height as u32], rgb_to_png(&pixels))
        };
        (photo, pixels)
    }

    #[test]
    fn a_photo_is_reduced_by_the_greatest_whole_factor_that_leaves_enough() {
        let (whole, pixels) = photo(13, 9);
        for (least, size) in [(0, (13, 9)), (7, (13, 9)), (6, (6, 4)), (4, (4, 3))] {
            let small = smaller(whole.clone(), &pixels, least);
            assert_eq!((small.width, small.height), size, "{least}");
            let there = small.decode().unwrap();
            assert_eq!((there.width as u32, there.height as u32), size);
        }
        let small = smaller(whole, &pixels, 6).decode().unwrap();
        let four = [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(x, y)| u32::from(pixels.at(x, y)[0]));
        assert_eq!(
            u32::from(small.at(0, 0)[0]),
            (four.iter().sum::<u32>() + 2) / 4
        );
    }

    #[test]
    fn what_is_known_in_pixels_is_where_it_was() {
        let mut rig = Rig {
            focal_px: Some(3000.0),
            centre_px: Some([799.5, 1199.5]),
            reference: Some(Reference {
                kind: "points".into(),
                length_mm: 100.0,
                seen: vec![SeenEnds {
                    photo: "a.png".into(),
                    px: [[0.5, 2.5], [-0.5, 2399.5]],
                }],
            }),
            ..Rig::default()
        };
        on_smaller(&mut rig, 2);
        assert_eq!(rig.focal_px, Some(1500.0));
        assert_eq!(rig.centre_px, Some([399.5, 599.5]));
        let seen = &rig.reference.unwrap().seen[0];
        assert_eq!(seen.px, [[0.0, 1.0], [-0.5, 1199.5]]);
    }
}
