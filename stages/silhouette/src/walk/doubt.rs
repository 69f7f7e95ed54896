//! What is doubtful about the outlines of a walk.

use crate::border::soft_border::MIXED_PX;
use crate::raster::as_mask;
use crate::scene::still_and_disk::Shot;
use crate::walk::colors::Colors;
use nalgebra::Vector2;
use shape::{Image, signed_distance};

/// How far from the outline colours are asked. By hand: looked at the walk of a test, at 0.7 and 1.4 of it: equal
/// masks. \[px of the reduced photo\]
const ASKED_WITHIN_PX: f32 = 12.0;

/// Share of the pixels near an outline that colours alone put on its side, both sides weighing alike.
pub(crate) fn reported(shot: &Shot, sides: &Image<bool>, colors: &Colors) -> f64 {
    let depth = signed_distance(&as_mask(sides));
    let favour = colors.favours(&shot.small);
    let (mut right, mut count) = ([0usize; 2], [0usize; 2]);
    for (depth, favour) in depth.data.iter().zip(&favour.data) {
        if (MIXED_PX as f32..ASKED_WITHIN_PX).contains(&depth.abs()) {
            let side = usize::from(*depth > 0.0);
            count[side] += 1;
            right[side] += usize::from((*favour > 0.0) == (*depth > 0.0));
        }
    }
    let share = |s: usize| right[s] as f64 / count[s].max(1) as f64;
    (share(0) + share(1)) / 2.0
}

/// Intersection over union; 1 of two that are empty.
pub(crate) fn alike(a: &Image<bool>, b: &Image<bool>) -> f64 {
    let pairs = || a.data.iter().zip(&b.data);
    let both = pairs().filter(|(a, b)| **a && **b).count();
    let any = pairs().filter(|(a, b)| **a || **b).count();
    if any == 0 {
        1.0
    } else {
        both as f64 / any as f64
    }
}

/// Share of a photo's border that a mask runs over, as that of its length.
pub(crate) fn over_border(sides: &Image<bool>) -> f64 {
    let (w, h) = (sides.width, sides.height);
    let rows = (0..w).flat_map(|x| [(x, 0), (x, h - 1)]);
    let columns = (0..h).flat_map(|y| [(0, y), (w - 1, y)]);
    let over = rows.chain(columns).filter(|(x, y)| sides.at(*x, *y));
    over.count() as f64 / (2 * (w + h)) as f64
}

/// The widest gap between cameras around the axis. \[°\]
pub(crate) fn widest_gap(shots: &[Shot]) -> f64 {
    let around = |s: &Shot| {
        let c: Vector2<f64> = s.camera.centre().coords.xy();
        libm::atan2(c.y, c.x).to_degrees()
    };
    let mut all: Vec<f64> = shots.iter().map(around).collect();
    all.sort_by(f64::total_cmp);
    let Some((first, last)) = all.first().zip(all.last()) else {
        return 360.0;
    };
    let beside = all.windows(2).map(|w| w[1] - w[0]);
    beside.fold(first + 360.0 - last, f64::max)
}

/// The middle one; 0 of none.
pub(crate) fn middle(all: &[f64]) -> f64 {
    let mut all = all.to_vec();
    all.sort_by(f64::total_cmp);
    all.get(all.len() / 2).copied().unwrap_or(0.0)
}
