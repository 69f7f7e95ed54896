//! Bytes that are almost what they were.

use proof::Dice;

/// A file of the corpus with some of its bytes otherwise; `other` is another one, to take pieces of.
pub(crate) fn mutated(seed: &[u8], other: &[u8], dice: &mut Dice) -> Vec<u8> {
    let mut bytes = seed.to_vec();
    let below = |dice: &mut Dice, n: usize| dice.bits() as usize % n.max(1);
    for _ in 0..1 + below(dice, 4) {
        let at = below(dice, bytes.len() + 1);
        let bits = below(dice, 8);
        let length = 1 + below(dice, 1 << bits);
        let end = (at + length).min(bytes.len());
        match below(dice, 9) {
            0 => bytes.truncate(at),
            1 => {
                if let Some(byte) = bytes.get_mut(at) {
                    *byte ^= 1 << bits;
                }
            }
            2 => bytes[at..end].fill_with(|| dice.bits() as u8),
            3 => drop(bytes.drain(at..end)),
            4 => {
                let piece = bytes[at..end].to_vec();
                bytes.splice(at..at, piece);
            }
            5 => {
                let from = below(dice, other.len() + 1);
                let to = (from + length).min(other.len());
                bytes.splice(at..end, other[from..to].iter().copied());
            }
            6 => {
                // Where a length or a count may be.
                let odd = [0, 1, 0x7f, 0x80, 0xff, 0x7fff_ffff, 0xffff_ffff, u64::MAX];
                let odd = odd[below(dice, odd.len())].to_le_bytes();
                let width = [1, 2, 4, 8][below(dice, 4)];
                let end = (at + width).min(bytes.len());
                bytes[at..end].copy_from_slice(&odd[..end - at]);
            }
            7 => {
                let words = [
                    "-1",
                    "1e309",
                    "NaN",
                    "0",
                    "99999999999999999999",
                    "\"",
                    "[",
                    "{",
                    "\n",
                ];
                let word = words[below(dice, words.len())];
                bytes.splice(at..end, word.bytes());
            }
            _ => bytes[at..end].reverse(),
        }
    }
    bytes.truncate(1 << 20);
    bytes
}
