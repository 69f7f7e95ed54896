//! One photo of the user's: the head of its file, and whether it is whole and shows something.

use crate::bare::bare;
use crate::error::CaptureError;
use crate::exif::{self, Exif};
use crate::heic::{is_heic, jpeg};
use shape::{Photo, Rgb};

fn no_picture(name: &str, why: impl ToString) -> CaptureError {
    CaptureError::NoPicture {
        name: name.to_owned(),
        why: why.to_string(),
    }
}

/// A photo whose pixels nobody has looked at yet; `path` is what the user calls it.
pub(crate) fn header(path: &str, name: &str, bytes: Vec<u8>) -> Result<Photo, CaptureError> {
    if bytes.is_empty() {
        return Err(no_picture(path, "it is empty"));
    }
    if crate::whole::is_cut_off(&bytes) {
        return Err(no_picture(path, "it ends too early: copied whole?"));
    }
    let exif = exif::read(&bytes);
    if is_heic(&bytes) {
        let file = jpeg(&bytes).map_err(|why| no_picture(path, why))?;
        // The file's own transformations are done; EXIF's orientation repeats them.
        return of(
            path,
            &as_jpeg(name),
            Exif {
                orientation: 1,
                ..exif
            },
            file,
        );
    }
    of(path, name, exif, bytes)
}

/// A photo that another program, or another decoder, made of a file: its name with the ending of JPEG.
pub(crate) fn as_jpeg(name: &str) -> String {
    let stem = name.rsplit_once('.').map_or(name, |(stem, _)| stem);
    format!("{stem}.jpg")
}

/// A photo and what its file records.
fn of(path: &str, name: &str, exif: Exif, bytes: Vec<u8>) -> Result<Photo, CaptureError> {
    let (width, height) = image::ImageReader::new(std::io::Cursor::new(&bytes))
        .with_guessed_format()
        .map_err(|e| no_picture(path, e))?
        .into_dimensions()
        .map_err(|e| no_picture(path, e))?;
    let on_its_side = exif.orientation >= 5;
    let (width, height) = if on_its_side {
        (height, width)
    } else {
        (width, height)
    };
    let photo = Photo {
        name: name.to_owned(),
        width,
        height,
        orientation: exif.orientation,
        focal_35mm: exif.focal_35mm,
        device: exif.device,
        time_s: exif.time_s,
        file: bytes.into(),
    };
    bare(photo).map_err(|e| no_picture(path, e.why))
}

/// The photo, decoded once to see that it is whole and shows something; and its pixels.
pub(crate) fn photo(photo: Photo) -> Result<(Photo, Rgb), CaptureError> {
    let pixels = photo.decode().map_err(|e| no_picture(&photo.name, e.why))?;
    let (mut lo, mut hi, mut white) = ([255u8; 3], [0u8; 3], 0usize);
    for p in &pixels.data {
        (0..3).for_each(|c| (lo[c], hi[c]) = (lo[c].min(p[c]), hi[c].max(p[c])));
        white += usize::from(p.iter().all(|c| *c >= 254));
    }
    let flat = (0..3).all(|c| hi[c] - lo[c] < 8);
    let name = || photo.name.clone();
    match (flat, white * 10 > pixels.data.len() * 9) {
        (true, _) => Err(CaptureError::OneColour { name: name() }),
        (_, true) => Err(CaptureError::Overexposed { name: name() }),
        _ => Ok((photo, pixels)),
    }
}
