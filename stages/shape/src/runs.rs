//! Pixels as runs of equal values: how masks and what else is mostly even is stored.

use stage::Corrupt;
use std::cmp::Ordering;

/// Pixels as runs: value, then length as three bytes.
pub(crate) fn runs(pixels: &[u8]) -> Vec<u8> {
    let mut runs = Vec::new();
    for run in pixels.chunk_by(|a, b| a == b) {
        for run in run.chunks(0xff_ffff) {
            runs.push(run[0]);
            runs.extend_from_slice(&(run.len() as u32).to_le_bytes()[..3]);
        }
    }
    runs
}

/// How many pixels a run is.
pub(crate) fn run_length(run: &[u8; 4]) -> usize {
    u32::from_le_bytes([run[1], run[2], run[3], 0]) as usize
}

/// The runs of so many pixels, one by one.
///
/// # Errors
///
/// They are of more pixels, or of fewer.
pub(crate) fn checked(runs: &[u8], count: usize) -> Result<&[[u8; 4]], Corrupt> {
    let (runs, []) = runs.as_chunks::<4>() else {
        return Err(Corrupt("half a run".into()));
    };
    match runs.iter().map(run_length).sum::<usize>().cmp(&count) {
        Ordering::Greater => Err(Corrupt("a mask longer than its size".into())),
        Ordering::Less => Err(Corrupt("a mask shorter than its size".into())),
        Ordering::Equal => Ok(runs),
    }
}

/// Runs as pixels; never more than `count` of them.
pub(crate) fn pixels(runs: &[u8], count: usize) -> Result<Vec<u8>, Corrupt> {
    let runs = checked(runs, count)?;
    let mut pixels = Vec::with_capacity(count);
    for run in runs {
        pixels.resize(pixels.len() + run_length(run), run[0]);
    }
    Ok(pixels)
}

/// Two sides as runs.
pub(crate) fn sides(sides: &[bool]) -> Vec<u8> {
    runs(&sides.iter().map(|s| u8::from(*s)).collect::<Vec<u8>>())
}

/// Runs as two sides; never more than `count` of them.
pub(crate) fn from_sides(runs: &[u8], count: usize) -> Result<Vec<bool>, Corrupt> {
    Ok(pixels(runs, count)?.into_iter().map(|s| s != 0).collect())
}

/// Fewer equal numbers in a row are stored one by one (structural: below it nothing is saved).
const MIN_REPEATS: usize = 4;

/// Numbers that often repeat: how many are kept one by one and how often the next repeats, in turns; and those that
/// are kept, each that repeats once. Equal means the same bits.
pub(crate) fn repeats(values: &[f32]) -> (Vec<u32>, Vec<f32>) {
    let (mut lengths, mut kept, mut single) = (Vec::new(), Vec::new(), 0);
    for run in values.chunk_by(|a, b| a.to_bits() == b.to_bits()) {
        if run.len() < MIN_REPEATS {
            kept.extend_from_slice(run);
            single += run.len() as u32;
        } else {
            lengths.extend([single, run.len() as u32]);
            kept.push(run[0]);
            single = 0;
        }
    }
    lengths.push(single);
    (lengths, kept)
}

/// What [`repeats`] took apart, of so many numbers.
pub(crate) fn repeated(lengths: &[u32], kept: &[f32], count: usize) -> Result<Vec<f32>, Corrupt> {
    let wrong = || Corrupt("numbers that do not fill their picture".into());
    if lengths.iter().map(|n| *n as usize).sum::<usize>() != count {
        return Err(wrong());
    }
    let (mut values, mut at) = (Vec::with_capacity(count), 0);
    for (i, length) in lengths.iter().enumerate() {
        let length = *length as usize;
        if i % 2 == 0 {
            values.extend_from_slice(kept.get(at..at + length).ok_or_else(wrong)?);
            at += length;
        } else {
            let value = *kept.get(at).ok_or_else(wrong)?;
            values.resize(values.len() + length, value);
            at += 1;
        }
    }
    if at != kept.len() {
        return Err(wrong());
    }
    Ok(values)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_come_back_and_cut_short_they_do_not() {
        let mut values = vec![4.5f32; 40];
        values.extend([1.0, 2.0, 2.0, 2.0, 2.0, -0.0, 0.0, 0.0, 0.0, 0.0, f32::MAX]);
        let (lengths, kept) = repeats(&values);
        assert_eq!((&lengths[..], kept.len()), (&[0, 40, 1, 4, 1, 4, 1][..], 6));
        let back = repeated(&lengths, &kept, values.len()).unwrap();
        let bits = |v: &[f32]| v.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&back), bits(&values));
        assert!(repeated(&lengths, &kept, values.len() - 1).is_err());
        assert!(repeated(&lengths, &kept, values.len() + 1).is_err());
        assert!(repeated(&lengths, &kept[1..], values.len()).is_err());
        assert_eq!(repeated(&[0], &[], 0).unwrap(), []);
    }
}
