//! A photo's file without what is no picture: places, names, comments, previews and other pictures in it go; what the
//! program reads (`exif.rs`) stays. Pixels are the same, and so are files that have nothing else.

mod exif_kept;
mod jpeg;
mod png;

use shape::{Photo, PhotoError, rgb_to_png};

/// A photo whose file holds nothing but the picture and what the program reads of the camera.
///
/// # Errors
///
/// The file is none of those whose parts are known, and cannot be decoded to be written anew.
pub(crate) fn bare(photo: Photo) -> Result<Photo, PhotoError> {
    let file = match &photo.file[..] {
        file if file.starts_with(b"\xff\xd8") => jpeg::bare(file),
        file if file.starts_with(png::SIGNATURE) => png::bare(file),
        _ => None,
    };
    let Some(file) = file else {
        return anew(photo);
    };
    Ok(match file[..] == photo.file[..] {
        true => photo,
        false => Photo {
            file: file.into(),
            ..photo
        },
    })
}

/// The picture alone as a PNG, upright: of a TIFF, whose tags are anywhere among the pixels, or of a file whose parts
/// cannot be parsed.
fn anew(photo: Photo) -> Result<Photo, PhotoError> {
    let kept = exif_kept::of(&photo.file, false);
    let file = rgb_to_png(&photo.decode()?);
    let file = match kept {
        Some(kept) => png::with_exif(&file, &kept),
        None => file,
    };
    Ok(Photo {
        orientation: 1,
        file: file.into(),
        ..photo
    })
}
