//! Photos of one fixed camera laid onto each other, though a body turns in them and automatic exposure
//! changes their brightness.
//!
//! Gauss-Newton steps on shift, roll, gain and bias together, coarse to fine, with Tukey's weights: what
//! moves and what is lit otherwise has none.

use crate::{Gray, Placed};
use stage::machine::widest;
use step::{Sums, middle, residuals, sums};

mod step;

/// Longest side of the coarsest picture that is laid on another (structural: where a search begins). \[px\]
const COARSEST: usize = 100;
/// Steps at each size (structural: a search's end).
const STEPS: usize = 12;
/// Steps below this are the last (structural: a search's end). \[px\]
const SMALL: f64 = 0.002;
/// Share of the pixels whose differences give the noise: at least so many do not move (structural: any share of them that
/// is still).
pub const QUIET_SHARE: f64 = 0.4;
/// Within so many standard deviations of its mean is that share of a normal variable (derived: Φ(0.5244) = 0.7).
pub const QUIET_SIGMAS: f64 = 0.5244;
/// Tukey's bound in standard deviations (Beaton and Tukey 1974, for 95 % efficiency).
const BOUND: f64 = 4.685;
/// Least standard deviation of a pixel: that of rounding, 1/√12 = 0.29 (derived). \[levels\]
const LEAST_NOISE_LEVELS: f64 = 0.3;
/// A picture is not aligned to another where less than this share of the pixels has half their weight. By hand: not on
/// record.
const SHARED_SHARE: f64 = 0.15;
/// Longest way of a corner that is believed, as a share of the picture's longer side. By hand: not on record.
const FARTHEST_SHARE: f64 = 0.05;

/// Ways of corners below this are none: photos that are where they should be stay as they are. By hand: not on record.
/// \[px\]
const LEAST_WAY_PX: f64 = 0.06;
/// How a picture is aligned to another of its size. `None` where they share too little.
pub fn register(picture: &Gray, other: &Gray) -> Option<Placed> {
    laid(&pyramid(picture), &pyramid(other), Placed::SAME).map(|p| or_unmoved(p, picture))
}

/// The placement, its shift and roll none where corners go less than [`LEAST_WAY_PX`].
pub(crate) fn or_unmoved(placed: Placed, picture: &Gray) -> Placed {
    let half = libm::hypot(picture.width as f64, picture.height as f64) / 2.0;
    let [dx, dy] = placed.shift;
    Placed {
        shift: if libm::hypot(dx, dy) < LEAST_WAY_PX {
            [0.0; 2]
        } else {
            placed.shift
        },
        roll: if placed.roll.abs() * half < LEAST_WAY_PX {
            0.0
        } else {
            placed.roll
        },
        ..placed
    }
}

/// From the size itself to the coarsest, each softened.
pub(crate) fn pyramid(picture: &Gray) -> Vec<Gray> {
    let mut all = vec![softened(picture)];
    while let Some(last) = all.last()
        && last.width.max(last.height) >= 2 * COARSEST
    {
        let half = last.reduced(2);
        all.push(softened(&half));
    }
    all
}

/// Softened by 1 2 1 along both sides: what is between pixels is then nearly linear.
fn softened(picture: &Gray) -> Gray {
    let (w, h) = (picture.width, picture.height);
    let soft = |before: f32, here: f32, after: f32| 0.25 * (before + after) + 0.5 * here;
    let mut across = picture.clone();
    for (to, from) in across
        .data
        .chunks_mut(w.max(1))
        .zip(picture.data.chunks(w.max(1)))
    {
        for (to, three) in to[1..].iter_mut().zip(from.windows(3)) {
            *to = soft(three[0], three[1], three[2]);
        }
        to[0] = soft(from[0], from[0], from[1.min(w - 1)]);
        to[w - 1] = soft(from[w.max(2) - 2], from[w - 1], from[w - 1]);
    }
    let mut out = across.clone();
    for (y, to) in out.data.chunks_mut(w.max(1)).enumerate() {
        let (before, after) = (across.row(y.max(1) - 1), across.row((y + 1).min(h - 1)));
        let rows = before.iter().zip(across.row(y)).zip(after);
        for (to, ((before, here), after)) in to.iter_mut().zip(rows) {
            *to = soft(*before, *here, *after);
        }
    }
    out
}

/// Coarse to fine from a first guess at full size.
pub(crate) fn laid(picture: &[Gray], other: &[Gray], first: Placed) -> Option<Placed> {
    let fits = |a: &Gray, b: &Gray| (a.width, a.height) == (b.width, b.height);
    if !fits(picture.first()?, other.first()?) {
        return None;
    }
    let mut placed = first.enlarged(0.5f64.powi(picture.len() as i32 - 1));
    let mut shared = 0.0;
    for (level, (a, b)) in picture.iter().zip(other).enumerate().rev() {
        for _ in 0..STEPS {
            let (better, step, share) = stepped(a, b, &placed)?;
            (placed, shared) = (better, share);
            let longest = a.width.max(a.height) as f64;
            if placed.way(a.width, a.height) > FARTHEST_SHARE * longest {
                return None;
            }
            if step < SMALL {
                break;
            }
        }
        if level > 0 {
            placed = placed.enlarged(2.0);
        }
    }
    (shared >= SHARED_SHARE).then_some(placed)
}

/// One step: the better place, how far a corner went \[px\], and the share of the pixels that give it.
fn stepped(picture: &Gray, other: &Gray, from: &Placed) -> Option<(Placed, f64, f64)> {
    let (w, h) = (other.width, other.height);
    // Of large pictures every second pixel in both directions does.
    let every = if w.max(h) > 500 { 2 } else { 1 };
    let rim = 2 + from.way(w, h).ceil() as usize;
    if w.min(h) < 2 * rim + 8 {
        return None;
    }
    let residuals = widest(
        #[inline(always)]
        || residuals([picture, other], from, (rim, every)),
    );
    let mut far: Vec<f64> = residuals.iter().map(|r| r.abs()).collect();
    let quiet = (far.len() as f64 * QUIET_SHARE) as usize;
    let (_, quiet, _) = far.select_nth_unstable_by(quiet, f64::total_cmp);
    let bound = BOUND * (*quiet / QUIET_SIGMAS).max(LEAST_NOISE_LEVELS);
    let (_, half) = middle(w, h);
    let Sums {
        normal,
        right,
        kept,
    } = widest(
        #[inline(always)]
        || sums(&residuals, (other, from.gain), (rim, every), bound),
    );
    let step = normal.cholesky()?.solve(&right);
    let placed = Placed {
        shift: [from.shift[0] + step[0], from.shift[1] + step[1]],
        roll: from.roll + step[2] / half,
        gain: from.gain + step[3] / 100.0,
        bias: from.bias + step[4],
    };
    if !(0.2..5.0).contains(&placed.gain) {
        return None;
    }
    let way = libm::hypot(step[0], step[1]) + step[2].abs();
    Some((placed, way, kept as f64 / residuals.len() as f64))
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// A background of blobs, with a disk of other blobs in its middle at an angle.
    pub(crate) fn photo(placed: &Placed, angle: f64, dice: &mut proof::Dice) -> Gray {
        let (w, h) = (240usize, 320usize);
        let background = |x: f64, y: f64| {
            120.0
                + 40.0 * libm::sin(x / 9.0) * libm::cos(y / 7.0)
                + 30.0 * libm::sin((x + 2.0 * y) / 23.0)
        };
        let mut image = Gray::filled(w, h, 0.0);
        for i in 0..w * h {
            let at = [(i % w) as f64, (i / w) as f64];
            let [x, y] = placed.inverse().of(at, [w, h]);
            let (dx, dy) = (x - 120.0, y - 170.0);
            let (s, c) = libm::sincos(angle);
            let shown = if libm::hypot(dx / 60.0, dy / 110.0) < 1.0 {
                background(300.0 + c * dx - s * dy, 500.0 + s * dx + c * dy)
            } else {
                background(x, y)
            };
            image.data[i] = (placed.gain * shown + placed.bias + dice.normal()) as f32;
        }
        image
    }

    pub(crate) fn off(a: &Placed, b: &Placed) -> f64 {
        let by = Placed {
            shift: [a.shift[0] - b.shift[0], a.shift[1] - b.shift[1]],
            roll: a.roll - b.roll,
            ..*a
        };
        by.way(240, 320)
    }

    #[test]
    fn shift_roll_and_exposure_are_found_though_a_third_turns() {
        let mut dice = proof::Dice(2);
        let other = photo(&Placed::SAME, 0.0, &mut dice);
        for (shift, roll, gain, bias) in [
            ([0.0, 0.0], 0.0, 1.0, 0.0),
            ([0.31, -0.22], 0.0, 1.06, -3.0),
            ([5.3, 2.8], 0.004, 0.85, 5.0),
        ] {
            let true_one = Placed {
                shift,
                roll,
                gain,
                bias,
            };
            let found = register(&photo(&true_one, 0.7, &mut dice), &other).unwrap();
            assert!(off(&found, &true_one) < 0.04, "{found:?} {true_one:?}");
            assert!((found.gain / gain - 1.0).abs() < 0.004, "{found:?}");
        }
    }

    #[test]
    fn another_background_is_not_registered() {
        let mut dice = proof::Dice(3);
        let mut noise = || {
            let mut image = Gray::filled(240, 320, 0.0);
            image
                .data
                .iter_mut()
                .for_each(|v| *v = dice.within(0.0, 255.0) as f32);
            image
        };
        let (a, b) = (noise(), noise());
        let found = register(&a, &b);
        assert!(
            found.is_none_or(|p| (p.gain - 1.0).abs() > 0.5),
            "{found:?}"
        );
    }
}
