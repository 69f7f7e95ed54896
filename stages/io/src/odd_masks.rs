//! Masks of a turn that look wrong beside the other masks.

use shape::{Mask, MaskRuns};

/// A border that shows so much more body than this share of its length has cut it off. By hand: not on record.
const CUT_OFF_SHARE: f64 = 0.01;
/// How far a mask's area may be off those of its neighbours and its opposite. By hand: not on record.
const AREA_SHARE: f64 = 0.12;
/// A part beside the largest that is at least this share of the body. By hand: not on record.
const PART_SHARE: f64 = 0.01;

/// What is odd about each mask of a turn, in turning order, in a few words; nothing where all is well.
///
/// A body's outline from one side is that from the other mirrored, and changes slowly: an area that
/// neither the opposite mask nor the two beside it lead one to expect is odd.
pub(crate) fn odd(masks: &[Option<&MaskRuns>]) -> Vec<Vec<String>> {
    let areas: Vec<Option<f64>> = masks.iter().map(|m| m.map(MaskRuns::share)).collect();
    let n = masks.len();
    let one = |(k, mask): (usize, &Option<&MaskRuns>)| {
        let Some(mask) = mask else {
            return vec!["no mask".to_owned()];
        };
        let area = areas[k].unwrap_or(0.0);
        if area < 1e-4 {
            return vec!["empty".to_owned()];
        }
        if area > 0.95 {
            return vec!["full".to_owned()];
        }
        let mask = mask.pixels();
        let mut odd = cut_off(&mask);
        let parts = parts(&mask);
        if parts > 1 {
            odd.push(format!("{parts} parts"));
        }
        let beside = areas[(k + n - 1) % n].zip(areas[(k + 1) % n]);
        let beside = beside.map(|(a, b)| (a + b) / 2.0);
        let across = areas[(k + n / 2) % n].filter(|_| n.is_multiple_of(2));
        let off = |other: Option<f64>| other.filter(|o| *o > 1e-4).map(|o| area / o - 1.0);
        let off_by = [off(beside), off(across)].into_iter().flatten();
        let least = off_by.min_by(|a, b| a.abs().total_cmp(&b.abs()));
        if let Some(off) = least.filter(|off| off.abs() > AREA_SHARE && n > 5) {
            odd.push(format!("area {:+.0} %", off * 100.0));
        }
        odd
    };
    masks.iter().enumerate().map(one).collect()
}

/// Sides of the photo that the body runs over, but for the bottom, where a disk may be low.
fn cut_off(mask: &Mask) -> Vec<String> {
    let (w, h) = (mask.width, mask.height);
    let on = |x: usize, y: usize| mask.at(x, y) > 127;
    let share = |count: usize, of: usize| count as f64 / of.max(1) as f64;
    let sides = [
        ("left", share((0..h).filter(|y| on(0, *y)).count(), h)),
        ("right", share((0..h).filter(|y| on(w - 1, *y)).count(), h)),
        ("top", share((0..w).filter(|x| on(*x, 0)).count(), w)),
    ];
    let cut = sides.into_iter().filter(|s| s.1 > CUT_OFF_SHARE);
    cut.map(|(side, _)| format!("cut off {side}")).collect()
}

/// How many parts of the mask are worth the name; looked at in steps of a few pixels.
fn parts(mask: &Mask) -> usize {
    let step = (mask.width.max(mask.height) / 400).max(1);
    let (w, h) = (mask.width / step, mask.height / step);
    let mut open: Vec<bool> = (0..w * h)
        .map(|i| mask.at(i % w * step, i / w * step) > 127)
        .collect();
    let all = open.iter().filter(|o| **o).count();
    let mut count = 0;
    for start in 0..open.len() {
        let (mut front, mut size) = (vec![start], 0usize);
        while let Some(i) = front.pop() {
            if !std::mem::replace(&mut open[i], false) {
                continue;
            }
            size += 1;
            let (x, y) = (i % w, i / w);
            for v in y.max(1) - 1..(y + 2).min(h) {
                front.extend((x.max(1) - 1..(x + 2).min(w)).map(|u| v * w + u));
            }
        }
        count += usize::from(size as f64 > PART_SHARE * all as f64 && size > 0);
    }
    count
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A body half as wide from the side as from the front, on 18 photos.
    fn turn() -> Vec<Mask> {
        let one = |k: usize| {
            let wide = 30.0 + 10.0 * libm::cos(k as f64 * 0.698);
            let mut mask = Mask::filled(120, 160, 0);
            for y in 20..140 {
                let half = wide as usize;
                (60 - half..60 + half).for_each(|x| *mask.at_mut(x, y) = 255);
            }
            mask
        };
        (0..18).map(one).collect()
    }

    fn odd_of(masks: &[Mask]) -> Vec<Vec<String>> {
        let kept: Vec<MaskRuns> = masks.iter().map(MaskRuns::from).collect();
        odd(&kept.iter().map(Some).collect::<Vec<_>>())
    }

    #[test]
    fn a_good_turn_has_nothing_odd() {
        assert!(odd_of(&turn()).iter().all(Vec::is_empty));
    }

    #[test]
    fn what_is_wrong_is_named_at_the_mask_that_is_wrong() {
        let mut masks = turn();
        // A lost half, a part of the background, a body at the photo's side, nothing, everything.
        for y in 80..140 {
            (0..120).for_each(|x| *masks[3].at_mut(x, y) = 0);
        }
        for y in 0..25 {
            (100..119).for_each(|x| *masks[7].at_mut(x, y) = 255);
        }
        for y in 60..100 {
            (60..120).for_each(|x| *masks[10].at_mut(x, y) = 255);
        }
        masks[14] = Mask::filled(120, 160, 0);
        masks[16] = Mask::filled(120, 160, 255);
        let found = odd_of(&masks);
        assert!(
            found[3].iter().any(|t| t.starts_with("area -")),
            "{found:?}"
        );
        assert!(found[7].contains(&"2 parts".into()), "{found:?}");
        assert!(found[7].contains(&"cut off top".into()), "{found:?}");
        assert!(found[10].contains(&"cut off right".into()), "{found:?}");
        assert_eq!(
            (found[14][0].as_str(), found[16][0].as_str()),
            ("empty", "full")
        );
        assert!(
            [0, 1, 5, 9].iter().all(|k| found[*k].is_empty()),
            "{found:?}"
        );
        assert_eq!(odd(&[None]), [["no mask"]]);
    }
}
