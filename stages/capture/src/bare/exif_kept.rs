//! What of a file's EXIF stays: camera, orientation and time.

use exif::experimental::Writer;
use exif::{Exif, In, Reader, Tag};
use std::io::Cursor;

/// What `exif.rs` reads, and the settings of light; nothing of it names a person or a place.
const KEPT: [Tag; 11] = [
    Tag::Make,
    Tag::Model,
    Tag::Orientation,
    Tag::FocalLength,
    Tag::FocalLengthIn35mmFilm,
    Tag::DateTimeOriginal,
    Tag::SubSecTimeOriginal,
    Tag::ExposureTime,
    Tag::FNumber,
    Tag::PhotographicSensitivity,
    Tag::WhiteBalance,
];

/// What only leads from one part of EXIF to another.
const LEADS: [Tag; 1] = [Tag::ExifVersion];

/// EXIF with what is kept alone, as a TIFF of its own; with the orientation if wanted. None if the file has none of it.
pub(super) fn of(file: &[u8], orientation: bool) -> Option<Vec<u8>> {
    let exif = Reader::new()
        .read_from_container(&mut Cursor::new(file))
        .ok()?;
    written(&exif, orientation)
}

/// Unchanged if there is nothing else in it, else with what is kept alone; none if that is nothing, or if it cannot
/// be read.
pub(super) fn kept(tiff: &[u8]) -> Option<Vec<u8>> {
    let exif = Reader::new().read_raw(tiff.to_vec()).ok()?;
    let known = |field: &exif::Field| {
        let known = KEPT.contains(&field.tag) || LEADS.contains(&field.tag);
        field.ifd_num == In::PRIMARY && known
    };
    let written = written(&exif, true);
    // Longer than what is written of the same fields: something hides in between.
    match &written {
        Some(bytes) if exif.fields().all(known) && tiff.len() <= bytes.len() => Some(tiff.to_vec()),
        _ => written,
    }
}

fn written(exif: &Exif, orientation: bool) -> Option<Vec<u8>> {
    let mut writer = Writer::new();
    let wanted = KEPT
        .iter()
        .filter(|tag| orientation || **tag != Tag::Orientation);
    let fields: Vec<_> = wanted
        .filter_map(|tag| exif.get_field(*tag, In::PRIMARY))
        .collect();
    if fields.is_empty() {
        return None;
    }
    fields
        .into_iter()
        .for_each(|field| writer.push_field(field));
    let mut bytes = Cursor::new(Vec::new());
    writer.write(&mut bytes, true).ok()?;
    Some(bytes.into_inner())
}
