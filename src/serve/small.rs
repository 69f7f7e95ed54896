//! Photos made small, to look at on a page: made when asked for, upright, without EXIF.

use super::home;
use super::sniff::MOST_PIXELS;
use std::path::{Path, PathBuf};

/// Bytes of a pixel at most, while a photo is read.
const BYTES: u64 = 8;
const QUALITY: u8 = 82;

/// A photo, its longer side so many pixels, as JPEG; kept in `folder` for the next time.
///
/// # Errors
///
/// It cannot be read, or the disk refuses.
pub(super) fn small(photo: &Path, folder: &Path, side: u32) -> Result<Vec<u8>, String> {
    let stem = photo.file_stem().unwrap_or_default().to_string_lossy();
    let kept: PathBuf = folder.join(format!("{stem}-{side}.jpg"));
    let newer = |a: &Path, b: &Path| Some(modified(a)? >= modified(b)?);
    if newer(&kept, photo) == Some(true)
        && let Ok(bytes) = std::fs::read(&kept)
    {
        return Ok(bytes);
    }
    let bytes = io::small(photo, side, QUALITY, BYTES * MOST_PIXELS)?;
    // Kept if it can be; the page does not need it.
    let _ = home::make(folder).and_then(|()| home::write(&kept, &bytes));
    Ok(bytes)
}

fn modified(path: &Path) -> Option<std::time::SystemTime> {
    std::fs::metadata(path).ok()?.modified().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_photo_is_made_small_once_and_again_when_it_changed() {
        let place = tempfile::tempdir().unwrap();
        let (photo, folder) = (place.path().join("0001.png"), place.path().join("small"));
        let of = |value: u8| image::RgbImage::from_pixel(90, 60, image::Rgb([value; 3]));
        of(10).save(&photo).unwrap();
        let first = small(&photo, &folder, 30).unwrap();
        let size = image::load_from_memory(&first).unwrap();
        assert_eq!((size.width(), size.height()), (30, 20));
        assert_eq!(small(&photo, &folder, 30).unwrap(), first);
        std::thread::sleep(std::time::Duration::from_millis(20));
        of(200).save(&photo).unwrap();
        assert_ne!(small(&photo, &folder, 30).unwrap(), first);
        std::fs::write(&photo, "no picture").unwrap();
        assert!(small(&photo, &folder, 31).is_err());
    }
}
