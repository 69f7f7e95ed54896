//! HEIC photos, as phones write them, become JPEG: what comes later reads JPEG, PNG and TIFF.

/// Quality of the JPEG files that HEIC, raw photos and frames of a video become. By hand: looked at a made turn, where
/// it is 46.6 dB from the frame.
pub(crate) const QUALITY: u8 = 97;

/// Whether a file is of the family of HEIC, by its head (ISO/IEC 23008-12): a box `ftyp` with such a brand.
pub(crate) fn is_heic(bytes: &[u8]) -> bool {
    let brands: [&[u8]; 8] = [
        b"heic", b"heix", b"heim", b"heis", b"hevc", b"mif1", b"msf1", b"avif",
    ];
    bytes.get(4..8) == Some(b"ftyp") && bytes.get(8..12).is_some_and(|b| brands.contains(&b))
}

/// The picture, upright, in sRGB, as a JPEG file.
///
/// # Errors
///
/// The file cannot be decoded: why.
#[cfg(feature = "heic")]
pub(crate) fn jpeg(bytes: &[u8]) -> Result<Vec<u8>, String> {
    let options = heifer::Options {
        max_threads: rayon::current_num_threads(),
        ..heifer::Options::default()
    };
    let image = heifer::decode_srgb_rgba8(bytes, &options).map_err(|e| e.to_string())?;
    let (width, height) = (image.width as usize, image.height as usize);
    if width.max(height) > usize::from(u16::MAX) {
        return Err(format!("it is {width}×{height} pixels"));
    }
    let pixels = image.into_rgb8();
    let rgb = shape::Rgb {
        width,
        height,
        data: pixels.chunks_exact(3).map(|p| [p[0], p[1], p[2]]).collect(),
    };
    Ok(shape::rgb_to_jpeg(&rgb, QUALITY))
}

/// Nothing here reads it.
///
/// # Errors
///
/// Always: what reads it.
#[cfg(not(feature = "heic"))]
pub(crate) fn jpeg(_: &[u8]) -> Result<Vec<u8>, String> {
    Err("it is HEIC, which this build does not read: heif-convert -q 95 makes a JPEG of it, of Debian's libheif-examples; \
         or build with --features heic"
        .into())
}
