//! Whether two finds are one person.

use shape::{Crop, Found};

/// From here on the network finds a person in its square: as likely as not (derived: a chance of a half).
pub(crate) const PRESENT: f32 = 0.5;
/// Squares of one person share at least so much of their union: one may be a third of its side beside the other
/// (derived: (1 − 1/3) / (1 + 1/3)).
const ONE_PERSON: f32 = 0.5;

/// Whether two squares are one person's.
pub(crate) fn alike(a: &Crop, b: &Crop) -> bool {
    overlap(a, b) >= ONE_PERSON
}

/// Whether a square is inside of another, however they are turned.
pub(crate) fn within(inner: &Crop, outer: &Crop) -> bool {
    let off = |k: usize| (inner.centre_px[k] - outer.centre_px[k]).abs();
    (0..2).all(|k| off(k) + inner.side_px / 2.0 <= outer.side_px / 2.0)
}

/// Whether the network that looked from near finds a person.
pub(crate) fn present(found: &Found) -> bool {
    found.presence >= PRESENT
}

/// The square in the middle of all, number by number; its turn is left out.
pub(crate) fn middle(squares: &[Crop]) -> Option<Crop> {
    let middle = |of: fn(&Crop) -> f32| {
        let mut all: Vec<f32> = squares.iter().map(of).collect();
        all.sort_by(f32::total_cmp);
        all.get(all.len() / 2).copied()
    };
    Some(Crop {
        centre_px: [middle(|c| c.centre_px[0])?, middle(|c| c.centre_px[1])?],
        side_px: middle(|c| c.side_px)?,
        angle: 0.0,
    })
}

/// What two squares share of their union, however they are turned.
pub(crate) fn overlap(a: &Crop, b: &Crop) -> f32 {
    let along = |k: usize| {
        let half = |c: &Crop| c.side_px / 2.0;
        let end = (a.centre_px[k] + half(a)).min(b.centre_px[k] + half(b));
        (end - (a.centre_px[k] - half(a)).max(b.centre_px[k] - half(b))).max(0.0)
    };
    let shared = along(0) * along(1);
    shared / (a.side_px * a.side_px + b.side_px * b.side_px - shared).max(f32::MIN_POSITIVE)
}
