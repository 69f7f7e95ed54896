//! Outlines corrected by hand: what was painted is laid over the masks of the last measuring, and the next one
//! takes those as own masks (`photos/masks`), so that only what comes after them is made again.

use super::answer::{Wrong, aside};
use super::app::App;
use super::home::{self, Place};
use super::sniff::{HEAD, sniff};
use super::upload;
use axum::body::Body;
use axum::http::StatusCode;
use http_body_util::{BodyExt, Limited};
use image::{GrayImage, ImageFormat, Luma, RgbaImage};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A painted picture is no larger. \[bytes\]
const MOST: usize = 16 << 20;

/// Nor is its longer side. \[px\]
const MOST_SIDE: u32 = 4096;

/// The file of a photo's mask in a folder.
fn file(folder: &Path, number: u32) -> PathBuf {
    folder.join(format!("{number:04}.png"))
}

/// The mask of a photo as it is now: corrected, else as it was found; PNG.
///
/// # Errors
///
/// None was found.
pub(super) fn mask(place: &Place, number: u32) -> Result<Vec<u8>, Wrong> {
    let corrected = file(&corrected(place), number);
    let found = file(&place.out().join("masks"), number);
    let bytes = std::fs::read(corrected).or_else(|_| std::fs::read(found));
    bytes.map_err(|_| Wrong::missing())
}

fn corrected(place: &Place) -> PathBuf {
    place.photos().join("masks")
}

/// A mask with what was painted over it, at whatever size: opaque and light is body, opaque and dark is background.
fn painted_over(mask: &GrayImage, painted: &RgbaImage) -> GrayImage {
    let ((w, h), (pw, ph)) = (mask.dimensions(), painted.dimensions());
    // The pixel of the painting whose square holds the middle of the mask's.
    let from = |v: u32, of: u32, to: u32| {
        let at = (2 * u64::from(v) + 1) * u64::from(to) / (2 * u64::from(of));
        (at as u32).min(to - 1)
    };
    GrayImage::from_fn(w, h, |x, y| {
        let stroke = painted.get_pixel(from(x, w, pw), from(y, h, ph));
        match (stroke[3] > 127, stroke[0] > 127) {
            (true, true) => Luma([255]),
            (true, false) => Luma([0]),
            (false, _) => *mask.get_pixel(x, y),
        }
    })
}

/// Lays what was painted over the mask of a photo; the first time, the masks of all photos are taken along.
///
/// # Errors
///
/// It is no PNG, nothing was measured yet, something is being measured, or the disk refuses.
pub(super) async fn paint(
    app: &Arc<App>,
    place: &Place,
    number: u32,
    body: Body,
) -> Result<(), Wrong> {
    let large =
        |_| Wrong::new(StatusCode::PAYLOAD_TOO_LARGE, "wrong-large").put("most", MOST >> 20);
    let bytes = Limited::new(body, MOST)
        .collect()
        .await
        .map_err(large)?
        .to_bytes();
    let (app, place) = (Arc::clone(app), place.clone());
    aside(move || {
        if app.jobs.progress(&place).goes_on() {
            return Err(Wrong::new(StatusCode::CONFLICT, "wrong-busy"));
        }
        let painting = place.folder.join("painting.png");
        home::write(&painting, &bytes)?;
        let head = &bytes[..bytes.len().min(HEAD)];
        let known = sniff(&painting, head, "").map_err(upload::strange);
        let gone = std::fs::remove_file(&painting);
        let known = known?;
        let side = known.size.unwrap_or_default().into_iter().max();
        if known.ending != "png" || side > Some(MOST_SIDE) {
            return Err(Wrong::new(StatusCode::UNSUPPORTED_MEDIA_TYPE, "wrong-kind"));
        }
        gone?;
        let read = |bytes: &[u8]| image::load_from_memory_with_format(bytes, ImageFormat::Png);
        let header = |why: image::ImageError| Wrong::unfit(why);
        let painted = read(&bytes).map_err(header)?.to_rgba8();
        let before = read(&mask(&place, number)?).map_err(header)?.to_luma8();
        all_along(&place)?;
        let after = painted_over(&before, &painted);
        let after = shape::Image {
            width: after.width() as usize,
            height: after.height() as usize,
            data: after.into_raw(),
        };
        let png = shape::gray_to_png(&after);
        Ok(home::write(&file(&corrected(&place), number), &png)?)
    })
    .await
}

/// Takes the masks of the last measuring along, so that none is lacking.
fn all_along(place: &Place) -> std::io::Result<()> {
    let folder = corrected(place);
    if folder.exists() {
        return Ok(());
    }
    // Whole or not at all: a folder with some of them would be taken for all.
    let part = place.folder.join("masks.part");
    let _ = std::fs::remove_dir_all(&part);
    home::make(&part)?;
    for entry in std::fs::read_dir(place.out().join("masks"))? {
        let entry = entry?;
        home::write(&part.join(entry.file_name()), &std::fs::read(entry.path())?)?;
    }
    std::fs::rename(part, folder)
}

/// Takes all corrections back.
///
/// # Errors
///
/// Something is being measured, or the disk refuses.
pub(super) fn forget(app: &App, place: &Place) -> Result<(), Wrong> {
    if app.jobs.progress(place).goes_on() {
        return Err(Wrong::new(StatusCode::CONFLICT, "wrong-busy"));
    }
    match corrected(place).exists() {
        true => Ok(std::fs::remove_dir_all(corrected(place))?),
        false => Ok(()),
    }
}

/// Whether outlines were corrected.
pub(super) fn are_corrected(place: &Place) -> bool {
    corrected(place).is_dir()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_painted_goes_over_the_mask_at_whatever_size() {
        let mask = GrayImage::from_fn(8, 4, |x, _| Luma([if x < 4 { 255 } else { 0 }]));
        let mut painted = RgbaImage::new(4, 2);
        painted.put_pixel(0, 0, image::Rgba([0, 0, 0, 255]));
        painted.put_pixel(3, 1, image::Rgba([255, 255, 255, 255]));
        painted.put_pixel(2, 0, image::Rgba([255, 255, 255, 100]));
        let over = painted_over(&mask, &painted);
        let row = |y: u32| {
            (0..8)
                .map(|x| over.get_pixel(x, y)[0] / 255)
                .collect::<Vec<_>>()
        };
        assert_eq!(
            (row(0), row(1)),
            (vec![0, 0, 1, 1, 0, 0, 0, 0], vec![0, 0, 1, 1, 0, 0, 0, 0])
        );
        assert_eq!(
            (row(2), row(3)),
            (vec![1, 1, 1, 1, 0, 0, 1, 1], vec![1, 1, 1, 1, 0, 0, 1, 1])
        );
    }
}
