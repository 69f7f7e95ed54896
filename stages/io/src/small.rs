//! Photos made small, to look at: upright, as JPEG, without EXIF.

use image::{DynamicImage, ImageDecoder, ImageReader, Limits};
use std::path::Path;

/// A photo's file as JPEG whose longer side has so many pixels, of a quality of 1 to 100; `most` bytes are taken while it is read.
///
/// # Errors
///
/// It cannot be read, or would take more.
pub fn small(photo: &Path, side: u32, quality: u8, most: u64) -> Result<Vec<u8>, String> {
    let picture = upright(photo, most).map_err(|e| e.to_string())?;
    let mut bytes = Vec::new();
    let encoder = image::codecs::jpeg::JpegEncoder::new_with_quality(&mut bytes, quality);
    let picture = picture.thumbnail(side, side).to_rgb8();
    picture
        .write_with_encoder(encoder)
        .map_err(|e| e.to_string())?;
    Ok(bytes)
}

fn upright(photo: &Path, most: u64) -> image::ImageResult<DynamicImage> {
    let mut reader = ImageReader::open(photo)?.with_guessed_format()?;
    let mut limits = Limits::default();
    limits.max_alloc = Some(most);
    reader.limits(limits);
    let mut decoder = reader.into_decoder()?;
    let turn = decoder.orientation()?;
    let mut picture = DynamicImage::from_decoder(decoder)?;
    picture.apply_orientation(turn);
    Ok(picture)
}
