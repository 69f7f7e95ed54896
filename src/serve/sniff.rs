//! What an uploaded file is, by its first bytes and its header: nothing is decoded, no name is believed.

use crate::catalog::{READ, is_raw};
use image::{ImageFormat, ImageReader};
use std::io::BufReader;
use std::path::Path;

/// What a file is.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Sniffed {
    /// The ending that it is kept under.
    pub(super) ending: &'static str,
    /// Width and height, where the header has them. \[px\]
    pub(super) size: Option<[u32; 2]>,
    /// Whether it is a video.
    pub(super) video: bool,
}

/// Why a file is not kept.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub(super) enum Strange {
    /// Neither a photo nor a video.
    #[error("it is neither a photo (JPEG, PNG, TIFF) nor a video (MP4, MOV, MKV, AVI)")]
    Kind,
    /// HEIC, which this build does not read.
    #[error("it is a HEIC photo, which this program was built without")]
    Heic,
    /// The header of a photo is broken.
    #[error("its header is broken: {0}")]
    Broken(String),
    /// More pixels than any camera's.
    #[error("it claims to be {width}×{height} pixels; {most} million are the most that are read")]
    Large {
        /// \[px\]
        width: u32,
        /// \[px\]
        height: u32,
        /// \[million px\]
        most: u64,
    },
}

/// More pixels than this are no photo of a turn. \[px\]
pub(super) const MOST_PIXELS: u64 = 120_000_000;

/// So many bytes show what a file is.
pub(super) const HEAD: usize = 16;

/// The ending of a file with such first bytes.
fn ending(head: &[u8], name: &str) -> Option<(&'static str, Option<ImageFormat>)> {
    let brand = head.get(8..12).unwrap_or_default();
    let found = match head {
        [0xff, 0xd8, 0xff, ..] => ("jpg", Some(ImageFormat::Jpeg)),
        [0x89, b'P', b'N', b'G', 0x0d, 0x0a, 0x1a, 0x0a, ..] => ("png", Some(ImageFormat::Png)),
        [b'I', b'I', 42, 0, ..] | [b'M', b'M', 0, 42, ..] if is_raw(name) => ("dng", None),
        [b'I', b'I', 42, 0, ..] | [b'M', b'M', 0, 42, ..] => ("tif", Some(ImageFormat::Tiff)),
        [_, _, _, _, b'f', b't', b'y', b'p', ..] => match brand {
            b"heic" | b"heix" | b"mif1" | b"msf1" | b"hevc" => ("heic", None),
            b"qt  " => ("mov", None),
            b"avif" | b"avis" => return None,
            _ => ("mp4", None),
        },
        [0x1a, 0x45, 0xdf, 0xa3, ..] => ("mkv", None),
        [b'R', b'I', b'F', b'F', ..] if brand == b"AVI " => ("avi", None),
        _ => return None,
    };
    Some(found)
}

/// What a file is; `name` is what its owner calls it, and decides whether it is a raw photo.
///
/// # Errors
///
/// It is no photo and no video, or one that nobody should decode.
pub(super) fn sniff(file: &Path, head: &[u8], name: &str) -> Result<Sniffed, Strange> {
    let (ending, format) = ending(head, name).ok_or(Strange::Kind)?;
    if ending == "heic" && !READ.contains(&ending) {
        return Err(Strange::Heic);
    }
    let video = ["mp4", "mov", "mkv", "avi"].contains(&ending);
    let Some(format) = format else {
        return Ok(Sniffed {
            ending,
            size: None,
            video,
        });
    };
    let broken = |why: String| Strange::Broken(why);
    let opened = std::fs::File::open(file).map_err(|e| broken(e.to_string()))?;
    let reader = ImageReader::with_format(BufReader::new(opened), format);
    let (width, height) = reader
        .into_dimensions()
        .map_err(|e| broken(e.to_string()))?;
    match u64::from(width) * u64::from(height) {
        0 => Err(broken("it has no pixels".into())),
        pixels if pixels > MOST_PIXELS => Err(Strange::Large {
            width,
            height,
            most: MOST_PIXELS / 1_000_000,
        }),
        _ => Ok(Sniffed {
            ending,
            size: Some([width, height]),
            video,
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(bytes: &[u8], name: &str) -> Result<Sniffed, Strange> {
        let place = tempfile::tempdir().unwrap();
        let file = place.path().join("it");
        std::fs::write(&file, bytes).unwrap();
        sniff(&file, &bytes[..bytes.len().min(HEAD)], name)
    }

    /// The head of a PNG that claims to be so large; a decoder would ask for all of it.
    fn png(width: u32, height: u32) -> Vec<u8> {
        let mut bytes = b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR".to_vec();
        bytes.extend(width.to_be_bytes());
        bytes.extend(height.to_be_bytes());
        bytes.extend([8, 2, 0, 0, 0]);
        // The CRC of chunk and name (ISO 3309).
        let mut crc = !0u32;
        for byte in &bytes[12..] {
            crc ^= u32::from(*byte);
            (0..8).for_each(|_| crc = (crc >> 1) ^ (0xedb8_8320 & (!(crc & 1)).wrapping_add(1)));
        }
        bytes.extend((!crc).to_be_bytes());
        bytes.extend(b"\0\0\0\0IDAT\x35\xaf\x06\x1e");
        bytes
    }

    #[test]
    fn a_picture_that_claims_to_be_huge_is_refused_by_its_header() {
        let size = Some([4000, 3000]);
        assert_eq!(of(&png(4000, 3000), "a.png").unwrap().size, size);
        let huge = of(&png(60_000, 60_000), "a.png");
        assert!(
            matches!(huge, Err(Strange::Large { width: 60_000, .. })),
            "{huge:?}"
        );
    }

    #[test]
    fn names_are_not_believed() {
        assert_eq!(of(b"<!doctype html><script>", "a.jpg"), Err(Strange::Kind));
        assert_eq!(of(b"PK\x03\x04 a zip bomb", "a.jpg"), Err(Strange::Kind));
        assert_eq!(of(b"", "a.jpg"), Err(Strange::Kind));
        let broken = of(b"\xff\xd8\xff\xe0 and no more", "a.jpg");
        assert!(matches!(broken, Err(Strange::Broken(_))), "{broken:?}");
        let video = of(b"\0\0\0\x20ftypisom\0\0\0\0", "a.html").unwrap();
        assert!(video.video && video.ending == "mp4");
        let heic = of(b"\0\0\0\x18ftypheic\0\0\0\0", "a.jpg");
        let read = cfg!(feature = "heic");
        assert_eq!(heic == Err(Strange::Heic), !read, "{heic:?}");
        assert_eq!(of(b"II*\0 more of it", "a.DNG").unwrap().ending, "dng");
    }
}
