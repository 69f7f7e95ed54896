//! A section completed from a clear one: where another limb hides it, the clear one is carried over.

use std::f64::consts::TAU;

/// Directions around the middle (structural: samples).
pub const RAYS: usize = 360;

/// How far a closed curve reaches from the origin in each of [`RAYS`] directions: the farthest
/// crossing. `None` where the ray misses it. \[mm\]
pub fn reaches(curve: &[[f64; 2]]) -> Vec<Option<f64>> {
    crossings(curve, f64::max)
}

/// How far it is from the origin to a closed curve in each of [`RAYS`] directions: the first crossing. \[mm\]
pub(crate) fn first_reaches(curve: &[[f64; 2]]) -> Vec<Option<f64>> {
    crossings(curve, f64::min)
}

/// One crossing of each ray: of two the one that is chosen. \[mm\]
fn crossings(curve: &[[f64; 2]], chosen: fn(f64, f64) -> f64) -> Vec<Option<f64>> {
    let step = TAU / RAYS as f64;
    let mut far: Vec<Option<f64>> = vec![None; RAYS];
    for (i, a) in curve.iter().enumerate() {
        let b = curve[(i + 1) % curve.len()];
        let cross = a[0] * b[1] - a[1] * b[0];
        let (from, turn) = (
            libm::atan2(a[1], a[0]),
            libm::atan2(cross, a[0] * b[0] + a[1] * b[1]),
        );
        let (low, high) = (from.min(from + turn), from.max(from + turn));
        let mut k = (low / step).ceil() as i64;
        while (k as f64) * step <= high {
            let (s, c) = libm::sincos(k as f64 * step);
            let across = (b[0] - a[0]) * s - (b[1] - a[1]) * c;
            if across.abs() > 1e-12 {
                let t = (a[1] * c - a[0] * s) / across;
                let t = t.clamp(0.0, 1.0);
                let r = (a[0] + t * (b[0] - a[0])) * c + (a[1] + t * (b[1] - a[1])) * s;
                let slot = &mut far[k.rem_euclid(RAYS as i64) as usize];
                if r > 0.0 {
                    *slot = Some(slot.map_or(r, |old: f64| chosen(old, r)));
                }
            }
            k += 1;
        }
    }
    far
}

/// The unit vector of a ray.
pub fn ray(k: usize) -> [f64; 2] {
    let (s, c) = libm::sincos(TAU * k as f64 / RAYS as f64);
    [c, s]
}

/// A completed section.
#[derive(Debug, Clone, PartialEq)]
pub struct Carried {
    /// One point a ray. \[mm\]
    pub points: Vec<[f64; 2]>,
    /// Share of the rays that were carried over.
    pub share: f64,
}

/// How many seen rays beside a gap tell how much larger the section is than the clear one. By hand: not on record.
const BESIDE_RAYS: usize = 12;
/// Rays next to a gap that are left out: they show the fold. By hand: not on record.
const MARGIN_RAYS: usize = 3;

/// Completes a section. `here` and `clear` are [`reaches`] about the same axis; where `hidden`, the
/// clear one is carried over, larger by a factor: at the ends of the gap the section's own, in its middle
/// their mean, kept within `allowed`, straight in between. `None` if less than three tenths are seen,
/// or the two are of different size.
pub fn carried(
    here: &[Option<f64>],
    clear: &[Option<f64>],
    hidden: &[bool],
    allowed: &std::ops::RangeInclusive<f64>,
) -> Option<Carried> {
    let n = RAYS as i64;
    let at = |k: i64| k.rem_euclid(n) as usize;
    let ratio = |k: i64| -> Option<f64> {
        let k = at(k);
        (!hidden[k]).then_some(())?;
        Some(here[k]? / clear[k]?)
    };
    let seen = (0..n).filter(|k| ratio(*k).is_some()).count();
    if (seen as f64) < 0.3 * RAYS as f64 {
        return None;
    }
    let beside = |from: i64, way: i64| {
        let near: Vec<f64> = (MARGIN_RAYS as i64..n)
            .filter_map(|d| ratio(from + way * d))
            .take(BESIDE_RAYS)
            .collect();
        near.iter().sum::<f64>() / near.len() as f64
    };
    let mut points = Vec::with_capacity(RAYS);
    for k in 0..n {
        let r = if ratio(k).is_some() {
            here[at(k)]?
        } else {
            let back = (1..n).find(|d| ratio(k - d).is_some())?;
            let ahead = (1..n).find(|d| ratio(k + d).is_some())?;
            let (first, last) = (beside(k - back, -1), beside(k + ahead, 1));
            let share = back as f64 / (back + ahead) as f64;
            let middle = ((first + last) / 2.0).clamp(*allowed.start(), *allowed.end());
            let scale = match share < 0.5 {
                true => first + 2.0 * share * (middle - first),
                false => middle + (2.0 * share - 1.0) * (last - middle),
            };
            if !(0.85..=1.2).contains(&scale) {
                return None;
            }
            scale * clear[at(k)]?
        };
        let [c, s] = ray(at(k));
        points.push([r * c, r * s]);
    }
    Some(Carried {
        points,
        share: 1.0 - seen as f64 / RAYS as f64,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An ellipse about the origin with a disk of radius 40 fused to its side.
    fn fused(a: f64, b: f64) -> Vec<[f64; 2]> {
        (0..720)
            .map(|k| {
                let (s, c) = libm::sincos(TAU * f64::from(k) / 720.0);
                let trunk = a * b / libm::hypot(b * c, a * s);
                // Farthest crossing of a disk about (a + 20, 0).
                let m = (a + 20.0) * c;
                let under = 40f64.powi(2) - (a + 20.0).powi(2) * s * s;
                let arm = if c > 0.0 && under > 0.0 {
                    m + under.sqrt()
                } else {
                    0.0
                };
                let r = trunk.max(arm);
                [r * c, r * s]
            })
            .collect()
    }

    #[test]
    fn reaches_are_the_radii_of_a_circle() {
        let circle: Vec<[f64; 2]> = (0..1000)
            .map(|k| libm::sincos(TAU * f64::from(k) / 1000.0))
            .map(|(s, c)| [50.0 * c, 50.0 * s])
            .collect();
        for r in reaches(&circle) {
            proof::near(r.unwrap(), 50.0, 1e-3);
        }
    }

    #[test]
    fn an_arm_fused_to_an_ellipse_is_taken_off_by_a_clear_section_below() {
        let (here, clear) = (reaches(&fused(180.0, 120.0)), {
            let below: Vec<[f64; 2]> = (0..720)
                .map(|k| libm::sincos(TAU * f64::from(k) / 720.0))
                .map(|(s, c)| [0.95 * 180.0 * c, 0.95 * 120.0 * s])
                .collect();
            reaches(&below)
        });
        let hidden: Vec<bool> = (0..RAYS)
            .map(|k| here[k].is_none_or(|r| r * ray(k)[0] > 150.0))
            .collect();
        let whole = carried(&here, &clear, &hidden, &(0.9..=1.1)).unwrap();
        let truth: Vec<[f64; 2]> = (0..RAYS)
            .map(|k| {
                let [c, s] = ray(k);
                let r = 180.0 * 120.0 / libm::hypot(120.0 * c, 180.0 * s);
                [r * c, r * s]
            })
            .collect();
        let (got, want) = (crate::tape(&whole.points), crate::tape(&truth));
        assert!(crate::tape(&fused(180.0, 120.0)) > 1.05 * want);
        proof::near(got / want, 1.0, 2e-3);
        assert!(whole.share > 0.1 && whole.share < 0.4);
    }

    #[test]
    fn a_section_mostly_hidden_is_refused() {
        let all = vec![Some(100.0); RAYS];
        let hidden: Vec<bool> = (0..RAYS).map(|k| k > 90).collect();
        assert_eq!(carried(&all, &all, &hidden, &(0.9..=1.1)), None);
    }
}
