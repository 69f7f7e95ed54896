//! What goes smoothly from one place to the next, as in a film.

/// Where it is at a photo that is `pace` photos from place to place: it rests at each of them.
pub(crate) fn paced<const N: usize>(
    photo: f64,
    pace: u32,
    place: impl Fn(u32) -> [f64; N],
) -> [f64; N] {
    let step = (photo / f64::from(pace)).max(0.0);
    let (from, to) = (place(step as u32), place(step as u32 + 1));
    between(from, to, risen([0.0, 1.0], step.fract()))
}

/// Between two places.
pub(crate) fn between<const N: usize>(from: [f64; N], to: [f64; N], part: f64) -> [f64; N] {
    std::array::from_fn(|k| from[k] + part * (to[k] - from[k]))
}

/// Which of its places a foot has, and how far it is from there to the next, by time in steps: the left one (0) goes in
/// even steps, the right one (1) in odd ones.
pub(crate) fn placed(step: f64, foot: usize) -> (u32, f64) {
    let own = (step + foot as f64).max(0.0);
    let place = (own / 2.0) as u32;
    (place, risen([0.0, 1.0], own - 2.0 * f64::from(place)))
}

/// The middle of the step in which a foot rests at one of its places: there it is below the body.
pub(crate) fn rests(place: u32, foot: usize) -> f64 {
    2.0 * f64::from(place) - 0.5 - foot as f64
}

/// How far a number is between two, 0 to 1.
pub(crate) fn clamped([from, to]: [f64; 2], x: f64) -> f64 {
    ((x - from) / (to - from)).clamp(0.0, 1.0)
}

/// The same without corners.
pub(crate) fn risen(ends: [f64; 2], x: f64) -> f64 {
    let t = clamped(ends, x);
    t * t * (3.0 - 2.0 * t)
}
