//! Whether the background is elsewhere on the second of two photos: then the camera was moved.
//!
//! A camera that is nudged turns about itself, so that all of the background, far and near, follows one
//! rotation of its rays; no disk turns like that, and no subject fills the photo.

use crate::two_view::epipolar::draws;
use crate::two_view::five_point::Both;
use nalgebra::{Matrix3, Rotation3, Vector3};
use shape::Intrinsics;

/// How the background moved between two photos.
#[derive(Debug, Clone, PartialEq)]
pub struct BackgroundShift {
    /// How far it moved, its median. \[px\]
    pub by_px: f64,
    /// Which pairs belong to it.
    pub of: Vec<bool>,
    /// Whether they reach over so much of the photo that they can be no subject.
    pub wide: bool,
}

/// Matches of the background are this near to where the background went. By hand: looked at two captures, halved and
/// doubled: nothing changes, for none has a camera that was nudged (docs/lab/numbers.md). \[px\]
const WITH_BACKGROUND_PX: f64 = 4.0;
/// Fewest matches that make a background. By hand: looked at two captures, halved and doubled: nothing changes, for
/// none has a camera that was nudged (docs/lab/numbers.md).
const LEAST_MATCHES: usize = 40;
/// Share of the matches that belong to the background, at least: more than anything else has (derived: a half).
const LEAST_SHARE: f64 = 0.5;
/// Most that a nudge turns the camera. By hand: looked at two captures, halved and doubled: nothing changes, nor
/// without it on five, for none has a camera that was nudged (docs/lab/numbers.md). \[rad\]
const MOST_TURN_RAD: f64 = 0.15;
/// Four fifths of the background reach over so much of the photo, both ways. By hand: looked at one capture with a nudged
/// camera: over 0.80 of the width and 0.38 of the height, so it is found by what is still on far photos only.
const SPREAD_SHARE: f64 = 0.5;

/// The shift of the background, from the pairs of pixels that are not where they were. `None` where no
/// such share of them moved as one.
pub fn background_shift(
    lens: &Intrinsics,
    pairs: &[Both],
    rounds: usize,
    seed: u64,
) -> Option<BackgroundShift> {
    if pairs.len() < LEAST_MATCHES {
        return None;
    }
    let (f, [cx, cy]) = (lens.focal[0], lens.centre);
    let ray = |[x, y]: [f64; 2]| Vector3::new(x - cx, y - cy, f).normalize();
    let all: Vec<[Vector3<f64>; 2]> = pairs.iter().map(|both| both.map(ray)).collect();
    let near = |r: &Rotation3<f64>, wide: f64| -> Vec<bool> {
        let off = |both: &[Vector3<f64>; 2]| (r * both[0] - both[1]).norm() * f;
        all.iter()
            .map(|both| off(both) < wide * WITH_BACKGROUND_PX)
            .collect()
    };
    let count = |of: &[bool]| of.iter().filter(|of| **of).count();
    let mut place = draws(seed, all.len());
    let mut draw = || all[place()];
    let mut of = vec![];
    for _ in 0..rounds {
        let two = [draw(), draw()];
        if (two[0][0] - two[1][0]).norm() * f < 50.0 {
            continue;
        }
        let found = rotation(&two).filter(|r| r.angle() < MOST_TURN_RAD);
        let own = found.map(|r| near(&r, 1.5)).unwrap_or_default();
        if count(&own) > count(&of) {
            of = own;
        }
    }
    for _ in 0..3 {
        let some = all.iter().zip(&of).filter(|(_, of)| **of);
        let some: Vec<_> = some.map(|(both, _)| *both).collect();
        of = near(&rotation(&some)?, 1.0);
    }
    let background: Vec<&Both> = pairs
        .iter()
        .zip(&of)
        .filter(|p| *p.1)
        .map(|p| p.0)
        .collect();
    if background.len() < LEAST_MATCHES
        || (background.len() as f64) < LEAST_SHARE * pairs.len() as f64
    {
        return None;
    }
    let sorted = |mut all: Vec<f64>| {
        all.sort_by(f64::total_cmp);
        all
    };
    let wide = |i: usize, size: u32| {
        let all = sorted(background.iter().map(|pair| pair[0][i]).collect());
        all[all.len() * 9 / 10] - all[all.len() / 10] > SPREAD_SHARE * f64::from(size)
    };
    let moves = background
        .iter()
        .map(|[a, b]| libm::hypot(a[0] - b[0], a[1] - b[1]));
    let moves = sorted(moves.collect());
    let by_px = moves[moves.len() / 2];
    let wide = wide(0, lens.width) && wide(1, lens.height);
    Some(BackgroundShift { by_px, of, wide })
}

/// The rotation that takes the first of each pair nearest to the second (Kabsch 1976).
fn rotation(pairs: &[[Vector3<f64>; 2]]) -> Option<Rotation3<f64>> {
    let sum = |m: Matrix3<f64>, [a, b]: &[Vector3<f64>; 2]| m + b * a.transpose();
    let svd = pairs.iter().fold(Matrix3::zeros(), sum).svd(true, true);
    let (u, v) = (svd.u?, svd.v_t?);
    let sign = (u * v).determinant().signum();
    let flip = Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, sign));
    Some(Rotation3::from_matrix_unchecked(u * flip * v))
}

#[cfg(test)]
mod tests {
    use super::*;

    const LENS: fn() -> Intrinsics = || Intrinsics::simple(1600, 2400, 2600.0);

    fn seen(x: Vector3<f64>) -> [f64; 2] {
        LENS().project(&x).unwrap().into()
    }

    /// Matches of a trunk on a disk that turned by 20°, and of a background if the camera was nudged.
    fn pairs(still: usize, nudge: &Rotation3<f64>) -> Vec<Both> {
        let mut dice = proof::Dice(4);
        let mut pairs = Vec::new();
        for _ in 0..300 {
            let (angle, y) = (dice.within(-1.2, 1.2), dice.within(-700.0, 700.0));
            let mut at = |a: f64| {
                let x = Vector3::new(170.0 * libm::sin(a), y, 2600.0 - 120.0 * libm::cos(a));
                x + Vector3::new(dice.normal(), dice.normal(), 0.0) * 0.2
            };
            let (before, after) = (at(angle), at(angle + 0.35));
            pairs.push([seen(before), seen(nudge * after)]);
        }
        for _ in 0..still {
            let x = Vector3::new(
                dice.within(-1000.0, 1000.0),
                dice.within(-1600.0, 1600.0),
                dice.within(3200.0, 5000.0),
            );
            pairs.push([seen(x), seen(nudge * x)]);
        }
        pairs
    }

    #[test]
    fn a_nudged_camera_is_no_disk_that_turned() {
        assert_eq!(
            background_shift(&LENS(), &pairs(0, &Rotation3::identity()), 500, 1),
            None
        );
        let nudge = Rotation3::from_euler_angles(0.004, 0.013, 0.03);
        let all = pairs(600, &nudge);
        let found = background_shift(&LENS(), &all, 500, 1).unwrap();
        let of_background = found.of[300..].iter().filter(|of| **of).count();
        let of_body = found.of[..300].iter().filter(|of| **of).count();
        assert!(
            of_background > 590 && of_body < 15,
            "{of_background} {of_body}"
        );
        assert!((20.0..80.0).contains(&found.by_px), "{}", found.by_px);
    }
}
