//! Whether a JPEG was copied whole: decoders fill what is missing with grey without a warning.
//!
//! ITU-T T.81 B.1.1: a picture ends with the marker EOI (FF D9), and within the data of a scan, which
//! follows its marker SOS (FF DA), no other FF D9 can follow. Bytes after it are allowed: some
//! phones keep more there.

/// Whether the bytes are a JPEG that ends before its end. What is no JPEG is not cut off.
pub(crate) fn is_cut_off(bytes: &[u8]) -> bool {
    let last = |marker: u8| bytes.windows(2).rposition(|w| w == [0xff, marker]);
    if !bytes.starts_with(&[0xff, 0xd8]) {
        return false;
    }
    match (last(0xda), last(0xd9)) {
        (Some(scan), Some(end)) => end < scan,
        _ => true,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A picture with a small one inside, as cameras write it.
    const WHOLE: &[u8] =
        b"\xff\xd8\xff\xe1 \xff\xd8\xff\xda small \xff\xd9 \xff\xda data \xff\x00 \xff\xd9 and more";

    #[test]
    fn a_jpeg_cut_within_its_data_is_refused_and_a_whole_one_is_not() {
        assert!(!is_cut_off(WHOLE));
        let data = WHOLE.len() - b"\xff\x00 \xff\xd9 and more".len();
        for end in data..WHOLE.len() - b"\xd9 and more".len() {
            assert!(is_cut_off(&WHOLE[..end]), "{end}");
        }
        assert!(!is_cut_off(b"\x89PNG"));
    }
}
