//! A convex bridge over what is hidden between two folds, and how sure it is.

/// Standard deviation of a bridged tape, as a share of what the bridge adds to a tape straight from fold to fold, which
/// is the least that a convex part can have. By hand: looked at ovals, 0.22 (a test in `beside_trunk`), and at 22 arms
/// of two scans and five other bodies whose trunks were widened into them by 6, 15 and 28 mm, 0.3.
pub(super) const BRIDGED_SIGMA: f64 = 0.3;
/// The same by where a trunk's folds are, as a share of the way from one to the other: with it, 19 chests beside arms of every second of
/// the first hundred bodies of `models/made/strangers.py` are as far off as their deviations have it.
const PLACED: f64 = 0.03;

/// A convex bridge between two points that leaves and arrives along given ways: the conic that is
/// a circle's arc where both are alike. Returns its points and its doubt.
pub(crate) fn bridge(a: [f64; 2], u: [f64; 2], b: [f64; 2], v: [f64; 2]) -> (Vec<[f64; 2]>, f64) {
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    let chord = libm::hypot(dx, dy);
    let cross = u[0] * v[1] - u[1] * v[0];
    // a + s u = b + t v
    let s = (dx * v[1] - dy * v[0]) / cross;
    let t = (dx * u[1] - dy * u[0]) / cross;
    let within = |x: f64| x.is_finite() && x > 0.0 && x < 1.5 * chord;
    if chord < 1e-6 || !within(s) || !within(t) {
        return (vec![], PLACED * chord);
    }
    let x = [a[0] + s * u[0], a[1] + s * u[1]];
    // Half the turn from u to -v.
    let turn = -(u[0] * v[0] + u[1] * v[1]);
    let weight = ((1.0 + turn) / 2.0).clamp(0.0, 1.0).sqrt();
    let conic = |k: usize| {
        let t = k as f64 / 32.0;
        let (p, q, r) = ((1.0 - t).powi(2), 2.0 * t * (1.0 - t) * weight, t * t);
        let sum = p + q + r;
        [0, 1].map(|i| (p * a[i] + q * x[i] + r * b[i]) / sum)
    };
    let path: Vec<[f64; 2]> = (0..=32).map(conic).collect();
    let doubt = libm::hypot(BRIDGED_SIGMA * (walked(&path) - chord), PLACED * chord);
    (path[1..32].to_vec(), doubt)
}

/// Length of an open path. \[mm\]
pub(super) fn walked(path: &[[f64; 2]]) -> f64 {
    let step = |w: &[[f64; 2]]| libm::hypot(w[1][0] - w[0][0], w[1][1] - w[0][1]);
    path.windows(2).map(step).sum()
}
