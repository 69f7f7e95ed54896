//! Pixels to files: JPEG for photographs, PNG for masks and drawings.

use crate::{Image, Rgb};
use image::ExtendedColorType::{L8, Rgb8};
use image::ImageEncoder;
use image::codecs::png::{CompressionType, FilterType, PngEncoder};

/// A JPEG file. `quality` 1..=100.
pub fn rgb_to_jpeg(image: &Rgb, quality: u8) -> Vec<u8> {
    let mut file = Vec::new();
    let size = (image.width as u16, image.height as u16);
    let pixels = bytemuck::cast_slice(&image.data);
    jpeg_encoder::Encoder::new(&mut file, quality)
        .encode(pixels, size.0, size.1, jpeg_encoder::ColorType::Rgb)
        .expect("bug: an image that JPEG cannot hold");
    file
}

/// A PNG file in colours.
pub fn rgb_to_png(image: &Rgb) -> Vec<u8> {
    png(
        bytemuck::cast_slice(&image.data),
        image.width,
        image.height,
        Rgb8,
    )
}

/// A PNG file in shades of gray: how masks leave the house.
pub fn gray_to_png(image: &Image<u8>) -> Vec<u8> {
    png(&image.data, image.width, image.height, L8)
}

/// An image file as shades of gray.
///
/// # Errors
///
/// The file cannot be decoded.
pub fn gray_from_file(bytes: &[u8]) -> Result<Image<u8>, String> {
    let gray = image::load_from_memory(bytes)
        .map_err(|e| e.to_string())?
        .into_luma8();
    let (width, height) = (gray.width() as usize, gray.height() as usize);
    Ok(Image {
        width,
        height,
        data: gray.into_raw(),
    })
}

fn png(pixels: &[u8], width: usize, height: usize, color: image::ExtendedColorType) -> Vec<u8> {
    let mut file = Vec::new();
    PngEncoder::new_with_quality(&mut file, CompressionType::Fast, FilterType::Sub)
        .write_image(pixels, width as u32, height as u32, color)
        .expect("bug: an image that PNG cannot hold");
    file
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_png_holds_the_very_pixels() {
        let data = (0..70u8 * 3).map(|i| [i, 255 - i, 7]).collect::<Vec<_>>();
        let image = Rgb {
            width: 30,
            height: 7,
            data,
        };
        let read = image::load_from_memory(&rgb_to_png(&image))
            .unwrap()
            .into_rgb8();
        assert_eq!(
            read.as_raw().as_slice(),
            bytemuck::cast_slice::<_, u8>(&image.data)
        );
    }
}
