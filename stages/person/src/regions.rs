//! Where a mask and the learned one disagree by more than the learned one's own width, by region of the body.

use nalgebra::Point2;
use shape::{Found, Mask, signed_distance};

/// What two masks disagree in.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Disagreement {
    /// How wide the widest piece is that the network is sure of, and the mask leaves out. \[pixels of the network\]
    pub lost_px: f64,
    /// In the mask, but far outside of the learned body; as a share of the learned region.
    pub kept: f64,
}

/// How far the learned outline may be off. By hand: looked at the mean error of its contour, 1 to 2 pixels on all
/// captures. \[pixels of the network\]
const WIDTH_PX: usize = 2;

/// From these log-odds on the network is sure, derived: 19 to 1 by its calibration in `models/person/calibrate.py`.
/// \[sixteenths of a nat\]
const SURE: i8 = 90;

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
    let shows = |[x, y]: &[f32; 2]| mask.shows(Point2::new(f64::from(*x), f64::from(*y)));
    let inside: Vec<bool> = places.iter().map(on_photo).collect();
    let learned: Vec<bool> = (0..places.len())
        .map(|i| inside[i] && found.body.data[i] > 0)
        .collect();
    let near = spread(&learned, width);
    let lost = (0..places.len()).map(|i| {
        let sure = inside[i] && found.body.data[i] >= SURE;
        if sure && !shows(&places[i]) { 255 } else { 0 }
    });
    let depth = signed_distance(&Mask {
        width,
        height,
        data: lost.collect(),
    });
    let (mut area, mut kept) = ([0usize; 5], [0usize; 5]);
    let mut lost_px = [0.0f64; 5];
    for (i, at) in places.iter().enumerate().filter(|(i, _)| inside[*i]) {
        let is_kept = !near[i] && shows(at);
        if !(learned[i] || is_kept) {
            continue;
        }
        let region = found.part_at(*at) as usize;
        area[region] += usize::from(learned[i]);
        kept[region] += usize::from(is_kept);
        lost_px[region] = lost_px[region].max(2.0 * f64::from(depth.data[i]));
    }
    std::array::from_fn(|k| Disagreement {
        lost_px: lost_px[k],
        kept: kept[k] as f64 / area[k].max(1) as f64,
    })
}

/// Widened by the learned outline's width.
fn spread(of: &[bool], width: usize) -> Vec<bool> {
    let height = of.len() / width.max(1);
    let along = |of: &[bool], step: usize, place: &dyn Fn(usize) -> (usize, usize)| -> Vec<bool> {
        let any = |i: usize| {
            let (at, n) = place(i);
            let (from, to) = (at.saturating_sub(WIDTH_PX), (at + WIDTH_PX).min(n - 1));
            (from..=to).any(|k| of[i + k * step - at * step])
        };
        (0..of.len()).map(any).collect()
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
    fn a_lost_leg_is_named_by_its_part_and_width() {
        let found = found();
        let mut mask = found.mask(512, 512);
        assert_eq!(disagreement(&found, &mask), [Disagreement::default(); 5]);
        // Two pixels of the network narrower are that wide, and two wider are nothing.
        let shifted = |by: isize| {
            let mut moved = mask.clone();
            for (i, v) in moved.data.iter_mut().enumerate() {
                let from = i as isize - by;
                *v = mask.data.get(from as usize).copied().unwrap_or(0);
            }
            moved
        };
        let narrower = disagreement(&found, &shifted(4));
        assert!(
            narrower.iter().all(|d| d.lost_px < 2.5 && d.kept == 0.0),
            "{narrower:?}"
        );
        for y in 290..512 {
            (270..512).for_each(|x| *mask.at_mut(x, y) = 0);
        }
        // A leg of twenty pixels from its joint to the photo's right is lost.
        let reported = disagreement(&found, &mask);
        assert!((18.0..22.0).contains(&reported[3].lost_px), "{reported:?}");
        assert!(
            reported[0].lost_px == 0.0 && reported.iter().all(|d| d.kept == 0.0),
            "{reported:?}"
        );
        for y in 100..200 {
            (340..440).for_each(|x| *mask.at_mut(x, y) = 255);
        }
        let reported = disagreement(&found, &mask);
        assert!(reported.iter().any(|d| d.kept > 0.25), "{reported:?}");
    }
}
