//! All photos of a turn aligned to each other, and what does not move in them.

use crate::register::{laid, or_unmoved, pyramid};
use crate::{Gray, Placed};
use rayon::prelude::*;
use stage::machine::widest;

/// Rounds in which all photos of a turn are laid on the median of all (structural: a search's end).
const ROUNDS: usize = 2;

/// How each photo of a turn is aligned to what does not move in any of them, and that: their median once all
/// are laid on each other and exposed alike. Photos that do not share it have none.
pub fn registered(pictures: &[Gray]) -> (Vec<Option<Placed>>, Option<Gray>) {
    let all: Vec<Vec<Gray>> = pictures.par_iter().map(pyramid).collect();
    let Some(first) = all.first() else {
        return (vec![], None);
    };
    let mut reference = first.clone();
    let mut placed = vec![None; all.len()];
    let mut still = None;
    for round in 1..=ROUNDS {
        placed = all
            .par_iter()
            .zip(&placed)
            .map(|(p, before): (_, &Option<Placed>)| {
                laid(p, &reference, before.unwrap_or(Placed::SAME))
            })
            .collect();
        centred(&mut placed);
        let all = placed.iter_mut().flatten().zip(pictures);
        all.for_each(|(p, picture)| *p = or_unmoved(*p, picture));
        let shown: Vec<Gray> = pictures
            .par_iter()
            .zip(&placed)
            .filter_map(|(picture, placed)| Some(levelled(picture, placed.as_ref()?)))
            .collect();
        still = median(&shown);
        if round < ROUNDS {
            reference = pyramid(still.as_ref().unwrap_or(&pictures[0]));
        }
    }
    (placed, still)
}

/// A photo at the place and exposure of the other photos.
fn levelled(picture: &Gray, placed: &Placed) -> Gray {
    let mut out = placed.brought_gray(picture);
    out.data.iter_mut().for_each(|v| *v = placed.levelled(*v));
    out
}

/// Moved so that the middle one of all shifts, rolls, gains and biases is none: photos of a camera that moved
/// only once stay where they are.
fn centred(placed: &mut [Option<Placed>]) {
    let middle = |of: &dyn Fn(&Placed) -> f64| crate::upper_median(placed.iter().flatten().map(of));
    let shift = [0, 1].map(|i| middle(&|p| p.shift[i]));
    let (roll, gain) = (middle(&|p| p.roll), middle(&|p| p.gain));
    let ([Some(dx), Some(dy)], Some(roll), Some(gain)) = (shift, roll, gain) else {
        return;
    };
    let Some(bias) = middle(&|p| p.bias) else {
        return;
    };
    for p in placed.iter_mut().flatten() {
        // I = g B + b, B = (C - bias) / gain.
        let own = p.gain / gain;
        *p = Placed {
            shift: [p.shift[0] - dx, p.shift[1] - dy],
            roll: p.roll - roll,
            gain: own,
            bias: p.bias - own * bias,
        };
    }
}

/// Pixels whose medians are found side by side (structural: whole registers).
const LANES: usize = 8;

/// The median of each pixel over pictures of one size; `None` without pictures.
pub fn median(pictures: &[Gray]) -> Option<Gray> {
    let mut out = pictures.first()?.clone();
    let blocks = out.data.par_chunks_mut(LANES).enumerate();
    blocks.for_each_init(
        || vec![[0; LANES]; pictures.len()],
        |all, (block, out)| {
            for (lanes, picture) in all.iter_mut().zip(pictures) {
                let values = &picture.data[block * LANES..][..out.len()];
                (lanes.iter_mut().zip(values)).for_each(|(lane, v)| *lane = ordered(v.to_bits()));
            }
            let middle = widest(
                #[inline(always)]
                || upper_middle(all),
            );
            (out.iter_mut().zip(middle)).for_each(|(out, v)| *out = f32::from_bits(v));
        },
    );
    Some(out)
}

/// The upper middle of each lane.
#[inline(always)]
fn upper_middle(all: &mut [[i32; LANES]]) -> [u32; LANES] {
    let mut least = [0; LANES];
    // The least of all comes first, then the least of the rest.
    for first in 0..=all.len() / 2 {
        least = all[first];
        for other in &mut all[first + 1..] {
            for l in 0..LANES {
                (least[l], other[l]) = (least[l].min(other[l]), least[l].max(other[l]));
            }
        }
    }
    least.map(|v| ordered(v as u32) as u32)
}

/// Bits of a number as a whole number of the same order ([`f32::total_cmp`]), and back.
#[inline(always)]
fn ordered(bits: u32) -> i32 {
    let bits = bits as i32;
    bits ^ (((bits >> 31) as u32) >> 1) as i32
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::register::tests::{off, photo};

    #[test]
    fn a_turn_is_aligned_to_what_does_not_move_and_photos_in_place_stay() {
        let mut dice = proof::Dice(4);
        let shifts: Vec<Placed> = (0..9)
            .map(|k| Placed {
                shift: if k % 3 == 1 { [1.2, -0.7] } else { [0.0; 2] },
                gain: if k % 4 == 3 { 1.05 } else { 1.0 },
                ..Placed::SAME
            })
            .collect();
        let turned = |(k, p): (usize, &Placed)| photo(p, 0.7 * k as f64, &mut dice);
        let photos: Vec<Gray> = shifts.iter().enumerate().map(turned).collect();
        let (found, still) = registered(&photos);
        for (found, true_one) in found.iter().zip(&shifts) {
            let found = found.unwrap();
            assert!(off(&found, true_one) < 0.05, "{found:?} {true_one:?}");
            assert!((found.gain / true_one.gain - 1.0).abs() < 0.01, "{found:?}");
        }
        let clean = photo(&Placed::SAME, 0.0, &mut dice);
        let still = still.unwrap();
        assert!((still.at(20, 20) - clean.at(20, 20)).abs() < 4.0);
    }

    #[test]
    fn what_passes_by_is_not_in_the_median() {
        let pictures: Vec<Gray> = (0..5)
            .map(|i| {
                let mut g = Gray::filled(8, 8, 10.0);
                *g.at_mut(i, 3) = 200.0;
                g
            })
            .collect();
        assert_eq!(median(&pictures).unwrap(), Gray::filled(8, 8, 10.0));
        assert_eq!(pictures[0].reduced(2).at(0, 1), 57.5);
    }
}
