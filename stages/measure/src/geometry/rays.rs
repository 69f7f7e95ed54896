//! How far a section reaches from within it in each direction.

use std::f64::consts::TAU;

/// Directions around the middle (structural: samples).
pub(crate) const RAYS: usize = 360;

/// How far it is from the origin to a closed curve in each of [`RAYS`] directions, of two crossings the one that is chosen.
/// `None` where the ray misses it. \[mm\]
pub(crate) fn reaches(curve: &[[f64; 2]], chosen: fn(f64, f64) -> f64) -> Vec<Option<f64>> {
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
pub(crate) fn ray(k: usize) -> [f64; 2] {
    let (s, c) = libm::sincos(TAU * k as f64 / RAYS as f64);
    [c, s]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reaches_are_the_radii_of_a_circle() {
        let circle: Vec<[f64; 2]> = (0..1000)
            .map(|k| libm::sincos(TAU * f64::from(k) / 1000.0))
            .map(|(s, c)| [50.0 * c, 50.0 * s])
            .collect();
        for r in reaches(&circle, f64::max) {
            proof::near(r.unwrap(), 50.0, 1e-3);
        }
    }
}
