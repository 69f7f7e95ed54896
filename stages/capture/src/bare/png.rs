//! PNG by its chunks: the W3C's Portable Network Graphics.

use super::exif_kept::kept;

/// What a PNG begins with (structural: the file's form).
pub(super) const SIGNATURE: &[u8] = b"\x89PNG\r\n\x1a\n";

/// Chunks that define how the picture looks.
const PICTURE: [&[u8; 4]; 11] = [
    b"IHDR", b"PLTE", b"IDAT", b"tRNS", b"gAMA", b"cHRM", b"sRGB", b"iCCP", b"sBIT", b"bKGD",
    b"pHYs",
];

/// The file without what is no picture; none if it cannot be parsed.
pub(super) fn bare(file: &[u8]) -> Option<Vec<u8>> {
    let mut out = SIGNATURE.to_vec();
    let mut rest = file.strip_prefix(SIGNATURE)?;
    loop {
        let length = u32::from_be_bytes(*rest.first_chunk()?) as usize;
        let (chunk, after) = rest.split_at_checked(length.checked_add(12)?)?;
        let (name, data) = (&chunk[4..8], &chunk[8..8 + length]);
        rest = after;
        match name {
            b"IEND" => {
                out.extend(chunk);
                return Some(out);
            }
            b"eXIf" => {
                let kept = kept(data);
                out.extend(kept.map_or(vec![], |kept| exif(&kept)));
            }
            _ if PICTURE.iter().any(|known| known[..] == *name) => out.extend(chunk),
            _ => {}
        }
    }
}

/// A PNG of ours with EXIF behind its header.
pub(super) fn with_exif(file: &[u8], tiff: &[u8]) -> Vec<u8> {
    /// How long they are (structural: signature and first chunk, ISO 15948 of 2004).
    const HEAD: usize = 8 + 25;
    [&file[..HEAD], &exif(tiff), &file[HEAD..]].concat()
}

/// A chunk of EXIF.
fn exif(tiff: &[u8]) -> Vec<u8> {
    let length = (tiff.len() as u32).to_be_bytes();
    let sum = crc(b"eXIf".iter().chain(tiff));
    [&length[..], b"eXIf", tiff, &sum.to_be_bytes()].concat()
}

/// The check sum of a chunk, as the standard's annex D has it.
fn crc<'a>(bytes: impl Iterator<Item = &'a u8>) -> u32 {
    let mut sum = u32::MAX;
    for byte in bytes {
        sum ^= u32::from(*byte);
        for _ in 0..8 {
            sum = (sum >> 1) ^ (0xedb8_8320 & (0u32.wrapping_sub(sum & 1)));
        }
    }
    !sum
}
