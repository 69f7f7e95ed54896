//! JPEG by its segments: ITU-T T.81, annex B.

use super::exif_kept::kept;

/// Before EXIF in its segment (structural: by the standard, CIPA DC-008 of 2012).
const EXIF: &[u8] = b"Exif\0\0";

/// Before a colour profile in its segment (structural: the file's form).
const PROFILE: &[u8] = b"ICC_PROFILE\0";

/// Before Adobe's word on the colours, which decoders heed.
const ADOBE: &[u8] = b"Adobe";

/// Before the version and density of JFIF (structural: the file's form).
const JFIF: &[u8] = b"JFIF\0";

/// The bytes of JFIF's segment without a preview (structural: the file's form). \[bytes\]
const JFIF_BYTES: usize = 14;

/// The file without what is no picture; none if it cannot be parsed.
pub(super) fn bare(file: &[u8]) -> Option<Vec<u8>> {
    let mut out = file.get(..2)?.to_vec();
    let (mut at, mut exif) = (2, false);
    loop {
        // Any number of fill bytes may precede a marker.
        let marker_at = at + file.get(at..)?.iter().take_while(|b| **b == 0xff).count();
        let marker = *file.get(marker_at)?;
        if marker_at == at {
            return None;
        }
        match marker {
            0xd9 => {
                out.extend([0xff, 0xd9]);
                return Some(out);
            }
            0x01 | 0xd0..=0xd7 => {
                out.extend([0xff, marker]);
                at = marker_at + 1;
            }
            _ => {
                let length = file.get(marker_at + 1..marker_at + 3)?;
                let length = usize::from(u16::from_be_bytes([length[0], length[1]]));
                let body = file.get(marker_at + 3..marker_at + 1 + length)?;
                at = marker_at + 1 + length;
                match marker {
                    0xe1 if body.starts_with(EXIF) && !exif => {
                        exif = true;
                        if let Some(tiff) = kept(&body[EXIF.len()..]) {
                            segment(&mut out, marker, &[EXIF, &tiff].concat())?;
                        }
                    }
                    0xe0 if body.starts_with(JFIF) && body.len() >= JFIF_BYTES => {
                        let mut body = body[..JFIF_BYTES].to_vec();
                        // No preview.
                        body[JFIF_BYTES - 2..].fill(0);
                        segment(&mut out, marker, &body)?;
                    }
                    0xe2 if body.starts_with(PROFILE) => segment(&mut out, marker, body)?,
                    0xee if body.starts_with(ADOBE) => segment(&mut out, marker, body)?,
                    0xe0..=0xef | 0xfe => {}
                    _ => segment(&mut out, marker, body)?,
                }
                if marker == 0xda {
                    let scan = scan(file.get(at..)?);
                    out.extend(&file[at..at + scan]);
                    at += scan;
                }
            }
        }
    }
}

fn segment(out: &mut Vec<u8>, marker: u8, body: &[u8]) -> Option<()> {
    let length = u16::try_from(body.len() + 2).ok()?;
    out.extend([0xff, marker]);
    out.extend(length.to_be_bytes());
    out.extend(body);
    Some(())
}

/// How long the coded picture is that begins here: to the next marker that is neither a stuffed byte nor a restart.
fn scan(bytes: &[u8]) -> usize {
    let marker = |pair: &[u8]| pair[0] == 0xff && !matches!(pair[1], 0 | 0xd0..=0xd7 | 0xff);
    bytes.windows(2).position(marker).unwrap_or(bytes.len())
}
