//! Where a mask and the learned one disagree by more than the learned one's own width, by region of the body.

use nalgebra::Point2;
use shape::{Found, Mask};

/// What two masks disagree in, as shares of the region.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Disagreement {
    /// Not in the mask, of what is deep inside of the learned body.
    pub lost: f64,
    /// In the mask, but far outside of the learned body; as a share of the learned region.
    pub kept: f64,
}

/// How far the learned outline may be off: the mean error of its contour was 1 to 2 pixels on all captures that were
/// looked at. \[pixels of the network\]
const WIDTH_PX: usize = 2;

/// By region, in the order of [`BodyPart::ALL`](shape::BodyPart::ALL).
pub fn disagreement(found: &Found, mask: &Mask) -> [Disagreement; 5] {
    let (width, height) = (found.body.width, found.body.height);
    // Both masks on the network's pixels; what is outside of the photo is neither.
    let places: Vec<[f32; 2]> = (0..width * height)
        .map(|i| {
            let (x, y) = ((i % width) as f32 + 0.5, (i / width) as f32 + 0.5);
            found.crop.on_photo([x / width as f32, y / height as f32])
        })
        .collect();
    let on_photo = |[x, y]: &[f32; 2]| {
        let right = mask.width as f32 - 0.5;
        *x >= -0.5 && *y >= -0.5 && *x < right && *y < mask.height as f32 - 0.5
    };
    let inside: Vec<bool> = places.iter().map(on_photo).collect();
    let learned: Vec<bool> = (0..places.len())
        .map(|i| inside[i] && found.body.data[i] > 0)
        .collect();
    let deep = spread(&learned, width, false);
    let near = spread(&learned, width, true);
    let (mut area, mut inner) = ([0usize; 5], [0usize; 5]);
    let (mut lost, mut kept) = (area, area);
    for (i, at) in places.iter().enumerate().filter(|(i, _)| inside[*i]) {
        let shown = mask.shows(Point2::new(f64::from(at[0]), f64::from(at[1])));
        let (is_lost, is_kept) = (deep[i] && !shown, shown && !near[i]);
        if !(learned[i] || is_kept) {
            continue;
        }
        let region = found.part_at(*at) as usize;
        area[region] += usize::from(learned[i]);
        inner[region] += usize::from(deep[i]);
        lost[region] += usize::from(is_lost);
        kept[region] += usize::from(is_kept);
    }
    std::array::from_fn(|k| {
        let share = |count: usize, of: usize| count as f64 / of.max(1) as f64;
        Disagreement {
            lost: share(lost[k], inner[k]),
            kept: share(kept[k], area[k]),
        }
    })
}

/// Widened by the learned outline's width where `wider`, else narrowed; beyond the border is what is at it.
fn spread(of: &[bool], width: usize, wider: bool) -> Vec<bool> {
    let height = of.len() / width.max(1);
    let along = |of: &[bool], step: usize, place: &dyn Fn(usize) -> (usize, usize)| -> Vec<bool> {
        let any = |i: usize| {
            let (at, n) = place(i);
            let (from, to) = (at.saturating_sub(WIDTH_PX), (at + WIDTH_PX).min(n - 1));
            (from..=to).any(|k| of[i + k * step - at * step] == wider)
        };
        (0..of.len()).map(|i| any(i) == wider).collect()
    };
    let rows = along(of, 1, &|i| (i % width, width));
    along(&rows, width, &|i| (i / width, height))
}

#[cfg(test)]
mod tests {
    use super::*;
    use shape::{Crop, Image, Joint};

    /// A trunk of 60 × 100 and two legs of 20 × 100 of the network's pixels, two photo pixels each.
    fn found() -> Found {
        let mut body = Image::filled(256, 256, -127i8);
        let mut fill = |left: usize, top: usize, right: usize, bottom: usize| {
            for y in top..bottom {
                (left..right).for_each(|x| *body.at_mut(x, y) = 127);
            }
        };
        fill(98, 40, 158, 140);
        fill(98, 140, 118, 240);
        fill(138, 140, 158, 240);
        let mut at = [[256.0, 60.0]; 33];
        for (joint, place) in [
            (11, [296.0, 100.0]),
            (12, [216.0, 100.0]),
            (23, [296.0, 280.0]),
            (24, [216.0, 280.0]),
            (25, [296.0, 380.0]),
            (26, [216.0, 380.0]),
        ] {
            at[joint] = place;
        }
        (13..23).for_each(|k| at[k] = [900.0, 100.0]);
        (27..33).for_each(|k| at[k] = [if k % 2 == 1 { 296.0 } else { 216.0 }, 475.0]);
        let joint = |at_px| Joint {
            at_px,
            visibility: 1.0,
            presence: 1.0,
        };
        Found {
            score: 1.0,
            presence: 1.0,
            head_px: [0.0; 4],
            crop: Crop {
                centre_px: [255.5, 255.5],
                side_px: 512.0,
                angle: 0.0,
            },
            body,
            joints: at.map(joint).to_vec(),
        }
    }

    #[test]
    fn a_lost_leg_is_told_by_its_region_and_the_outlines_width_is_not() {
        let found = found();
        let mut mask = found.mask(512, 512);
        assert_eq!(disagreement(&found, &mask), [Disagreement::default(); 5]);
        // Two pixels of the network narrower or wider is nothing.
        let shifted = |by: isize| {
            let mut moved = mask.clone();
            for (i, v) in moved.data.iter_mut().enumerate() {
                let from = i as isize - by;
                *v = mask.data.get(from as usize).copied().unwrap_or(0);
            }
            moved
        };
        assert_eq!(
            disagreement(&found, &shifted(4)),
            [Disagreement::default(); 5]
        );
        for y in 290..512 {
            (270..512).for_each(|x| *mask.at_mut(x, y) = 0);
        }
        let reported = disagreement(&found, &mask);
        assert!((0.25..0.6).contains(&reported[3].lost), "{reported:?}");
        assert!(
            reported[1].lost < 0.01 && reported.iter().all(|d| d.kept == 0.0),
            "{reported:?}"
        );
        for y in 100..200 {
            (340..440).for_each(|x| *mask.at_mut(x, y) = 255);
        }
        let reported = disagreement(&found, &mask);
        assert!(reported.iter().any(|d| d.kept > 0.25), "{reported:?}");
    }
}
